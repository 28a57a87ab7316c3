// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>

#include <sks_detector/trainer.hpp>

#include "core/settings/value_text.hpp"

namespace sks {
namespace {

// Largest and second extent of an object in edges of a cell of keypoints.grid_size: below the first it is hardly found,
// at the second it is (measured with coloured objects of 30 and 50 mm).
constexpr double fewest_cells[] = {3, 1}, wanted_cells[] = {5, 1.5};
constexpr double flattest = 0.012;  // [m] what rises less above a plane counts as a part of it

/// Extents of an object in all its views, the largest first [m].
Eigen::Vector3d extentsOf(const Codebook& codebook, std::uint32_t object) {
  Eigen::Vector3d extents = Eigen::Vector3d::Zero();
  for (const TrainingView& view : codebook.views) {
    if (view.object == object) extents = extents.cwiseMax(view.extent().cast<double>());
  }
  std::sort(extents.data(), extents.data() + 3, std::greater<>());
  return extents;
}

/// Whether its boxes are those of the whole object; a view of its front alone looks flat.
bool isWhole(const Codebook& codebook, std::uint32_t object) {
  return std::all_of(codebook.views.begin(), codebook.views.end(), [&](const TrainingView& view) {
    return view.object != object || view.kind == ViewKind::model || !view.frame.empty();
  });
}

std::string inMillimetres(const Eigen::Vector3d& extents) {
  std::string text;
  for (const double extent : {extents[0], extents[1], extents[2]}) {
    text += (text.empty() ? "" : " x ") + toText(std::round(10000 * extent) / 10);
  }
  return text + " mm";
}

/// A length in whole millimetres.
std::string setting(double metres) {
  return toText(std::max(0.001, std::floor(1000 * metres) / 1000));
}

}  // namespace

std::vector<std::string> trainingWarnings(const Codebook& codebook) {
  const Settings& settings = codebook.settings;
  std::vector<std::string> warnings;
  for (std::uint32_t i = 0; i < codebook.objects.size(); ++i) {
    const Eigen::Vector3d extents = extentsOf(codebook, i);
    const double grid = settings.keypoints.grid_size;
    if (std::min(extents[0] / fewest_cells[0], extents[1] / fewest_cells[1]) < grid) {
      const double finer = std::min(extents[0] / wanted_cells[0], extents[1] / wanted_cells[1]), factor = finer / grid;
      warnings.push_back("object '" + codebook.objects[i] + "' is " + inMillimetres(extents) +
                         " large, which is too small for these settings; set keypoints.grid_size=" + setting(finer) +
                         ", descriptor.radius=" + setting(factor * settings.descriptor.radius) +
                         " and surface.normal_radius=" + setting(factor * settings.surface.normal_radius) +
                         ", or check its unit");
    } else if (extents[2] < flattest && settings.keypoints.skip_planes && isWhole(codebook, i)) {
      warnings.push_back(
          "object '" + codebook.objects[i] + "' is " + inMillimetres(extents) +
          " large, so flat that it counts as a part of what it lies on; set keypoints.skip_planes=false");
    }
  }
  return warnings;
}

}  // namespace sks
