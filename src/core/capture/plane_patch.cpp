// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/plane_patch.hpp"

#include <algorithm>
#include <cmath>

#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>
#include <Eigen/Eigenvalues>

namespace sks {
namespace {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;
using PlaneModel = pcl::SampleConsensusModelPlane<pcl::PointXYZ>;

constexpr int iterations = 1000;
constexpr double probability = 0.999;  // that a sample without outliers was among them

Indices planeInliers(const std::vector<Eigen::Vector3f>& points, double tolerance) {
  const PclCloud::Ptr cloud(new PclCloud);
  for (const Eigen::Vector3f& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  const PlaneModel::Ptr model(new PlaneModel(cloud));  // its seed is fixed
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, tolerance);
  ransac.setMaxIterations(iterations);
  ransac.setProbability(probability);
  std::vector<int> inliers;
  if (ransac.computeModel()) ransac.getInliers(inliers);
  return {inliers.begin(), inliers.end()};
}

void fit(PlanePatch& patch, const Eigen::Vector3f& sensor) {
  const double count = double(patch.points.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : patch.points) mean += p.cast<double>() / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : patch.points) {
    const Eigen::Vector3d d = p.cast<double>() - mean;
    covariance += d * d.transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  patch.deviation = std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (normal.dot(sensor.cast<double>() - mean) < 0) normal = -normal;
  patch.plane = Eigen::Hyperplane<float, 3>(normal.cast<float>(), mean.cast<float>());
}

}  // namespace

PlanePatch largestPatch(const std::vector<Eigen::Vector3f>& points, double tolerance, double gap,
                        const Eigen::Vector3f& sensor) {
  PlanePatch patch;
  if (points.size() < 3) return patch;
  patch.inliers = planeInliers(points, tolerance);
  const std::vector<Eigen::Vector3f> on_plane = at(points, patch.inliers);
  const std::vector<Indices> parts = findClusters(on_plane, gap);
  if (parts.empty() || parts[0].size() < 3) return patch;
  patch.points = at(on_plane, parts[0]);
  fit(patch, sensor);
  return patch;
}

}  // namespace sks
