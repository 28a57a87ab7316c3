// SPDX-License-Identifier: BSD-3-Clause
#include "core/keypoints/iss_keypoints.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace sks {
namespace {

/// The smallest eigenvalue of the scatter of a point's neighbours; 0 where two eigenvalues are too much alike, as the
/// axes of the shape are then not distinct, or where there are too few neighbours.
double saliencyAt(const Surface& surface, std::size_t point, const KeypointSettings& settings,
                  std::vector<PointGrid::Run>& runs) {
  const Eigen::Vector3f center = surface.point(point);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  int neighbors = 0;
  surface.forEachNeighbor(center, float(settings.iss_salient_radius), runs, [&](std::uint32_t i, float) {
    const Eigen::Vector3d offset = surface.point(i).cast<double>() - center.cast<double>();
    scatter += offset * offset.transpose();
    ++neighbors;
  });
  if (neighbors < settings.iss_min_neighbors) return 0;
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  const bool distinct = values[1] < settings.iss_gamma_21 * values[2] && values[0] < settings.iss_gamma_32 * values[1];
  return distinct ? std::max(values[0], 0.0) : 0.0;
}

bool isLargest(const std::vector<double>& saliency, const Surface& surface, std::size_t point,
               const KeypointSettings& settings, std::vector<PointGrid::Run>& runs) {
  if (!(saliency[point] > 0)) return false;
  int neighbors = 0;
  bool largest = true;
  surface.forEachNeighbor(surface.point(point), float(settings.iss_suppression_radius), runs,
                          [&](std::uint32_t i, float) {
                            ++neighbors;
                            if (saliency[i] > saliency[point]) largest = false;
                          });
  return largest && neighbors >= settings.iss_min_neighbors;
}

}  // namespace

Keypoints issKeypoints(const Surface& surface, const KeypointSettings& settings, int threads) {
  std::vector<double> saliency(surface.size());
  std::vector<char> chosen(surface.size());
#pragma omp parallel num_threads(threads)
  {
    std::vector<PointGrid::Run> runs;
#pragma omp for schedule(dynamic, 256)
    for (std::size_t i = 0; i < surface.size(); ++i) saliency[i] = saliencyAt(surface, i, settings, runs);
#pragma omp for schedule(dynamic, 256)
    for (std::size_t i = 0; i < surface.size(); ++i) chosen[i] = isLargest(saliency, surface, i, settings, runs);
  }
  Keypoints keypoints;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (chosen[i]) keypoints.positions.push_back(surface.point(i));
  }
  return keypoints;
}

}  // namespace sks
