// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_coverage.hpp"

#include <array>
#include <cmath>

namespace sks {
namespace {

constexpr int directions = 36;  // 10 degrees apart
constexpr double width = 30;    // [degrees] to both sides of a view: about as far as a surface is still well seen
constexpr double step = 360.0 / directions;

}  // namespace

ViewCoverage coverageOf(const RegisteredObject& object) {
  std::array<bool, directions> shown{};
  for (const RegisteredView& view : object.views) {
    if (!view.T_model_view) continue;
    const Eigen::Vector3d from = view.sensor - object.model.box.center().cast<double>();
    const double turn = std::atan2(from.y(), from.x()) * 180 / EIGEN_PI;
    for (int d = 0; d < directions; ++d) {
      const double apart = std::remainder(d * step - turn, 360.0);
      if (std::abs(apart) <= width) shown[std::size_t(d)] = true;
    }
  }
  ViewCoverage coverage;
  for (const bool is_shown : shown) coverage.share += is_shown ? 1.0 / directions : 0;
  const auto before = [&](int d) { return shown[std::size_t((d + directions - 1) % directions)]; };
  for (int d = 0; d < directions; ++d) {  // runs of missing directions, by their first one
    if (shown[std::size_t(d)] || !before(d)) continue;
    int end = d;
    while (!shown[std::size_t(end % directions)] && end < d + directions) ++end;
    coverage.missing += (coverage.missing.empty() ? "" : ", ") + std::to_string(int(d * step)) + " to " +
                        std::to_string(int(std::fmod((end - 1) * step, 360.0))) + " degrees";
  }
  if (coverage.missing.empty() && coverage.share == 0) coverage.missing = "all around";
  return coverage;
}

}  // namespace sks
