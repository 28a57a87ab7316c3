// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/ransac.hpp"

#include <array>
#include <random>

namespace sks {
namespace {

using Triple = std::array<std::size_t, 3>;

constexpr int refinements = 5;  // rounds of fit and inlier search after the best sample

/// Calls `f` for every triple of n, or for `limit` random ones if there are more.
template <typename Function>
void forEachSample(std::size_t n, std::size_t limit, unsigned seed, Function&& f) {
  if (n * (n - 1) * (n - 2) / 6 <= limit) {
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b) {
        for (std::size_t c = b + 1; c < n; ++c) f(Triple{a, b, c});
      }
    }
    return;
  }
  std::mt19937 random(seed);
  const auto draw = [&] { return std::size_t(random() % n); };  // std::uniform_int_distribution differs by library
  for (std::size_t i = 0; i < limit; ++i) {
    Triple t{draw(), draw(), draw()};
    while (t[1] == t[0]) t[1] = draw();
    while (t[2] == t[0] || t[2] == t[1]) t[2] = draw();
    f(t);
  }
}

}  // namespace

Eigen::Isometry3d fitRigid(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  const auto n = Eigen::Index(from.size());
  const Eigen::Map<const Eigen::Matrix3Xd> source(from.data()->data(), 3, n), target(to.data()->data(), 3, n);
  Eigen::Isometry3d transform;
  transform.matrix() = Eigen::umeyama(source, target, false);
  return transform;
}

RigidConsensus rigidRansac(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to,
                           const RansacSettings& settings) {
  RigidConsensus best;
  const std::size_t n = from.size();
  if (n < 3) return best;
  const double threshold = settings.inlier_threshold, limit = threshold * threshold;

  const auto inliersOf = [&](const Eigen::Isometry3d& transform) {
    std::vector<std::size_t> inliers;
    for (std::size_t i = 0; i < n; ++i) {
      if ((transform * from[i] - to[i]).squaredNorm() <= limit) inliers.push_back(i);
    }
    return inliers;
  };
  const auto fitTo = [&](const std::vector<std::size_t>& indices) {
    std::vector<Eigen::Vector3d> a, b;
    for (const std::size_t i : indices) {
      a.push_back(from[i]);
      b.push_back(to[i]);
    }
    return fitRigid(a, b);
  };

  forEachSample(n, std::size_t(settings.iterations), unsigned(settings.seed), [&](const Triple& t) {
    for (int k = 0; k < 3; ++k) {  // a rigid motion keeps lengths: most bad samples end here
      const std::size_t a = t[k], b = t[(k + 1) % 3];
      if (std::abs((from[a] - from[b]).norm() - (to[a] - to[b]).norm()) > 2 * threshold) return;
    }
    const auto inliers = inliersOf(fitTo({t[0], t[1], t[2]}));
    if (inliers.size() >= 3 && inliers.size() > best.inliers.size()) best.inliers = inliers;
  });
  if (best.inliers.empty()) return best;
  for (int i = 0; i < refinements; ++i) {
    const auto inliers = inliersOf(fitTo(best.inliers));
    if (inliers.size() <= best.inliers.size()) break;
    best.inliers = inliers;
  }
  best.T_to_from = fitTo(best.inliers);
  return best;
}

}  // namespace sks
