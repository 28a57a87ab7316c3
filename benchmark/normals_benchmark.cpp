// SPDX-License-Identifier: BSD-3-Clause
// Normals from the cloud in memory: the neighbour search is built anew on both sides.
#include <cmath>

#include <pcl/features/normal_3d_omp.h>

#include <sks_detector/sanitize.hpp>
#include <sks_detector/surface.hpp>

#include "pair.hpp"
#include "pcl_clouds.hpp"
#include "recorded_scenes.hpp"

namespace sks::bench {
namespace {

constexpr float max_angle = 3.0f / 180 * 3.14159265f;

pcl::PointCloud<pcl::Normal> pclNormals(const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud, double radius) {
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(threads);
  estimation.setInputCloud(cloud);  // PCL chooses the search: in the image where the cloud is organised, else a kd-tree
  estimation.setRadiusSearch(radius);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  return normals;
}

/// Share of our points at which both normals deviate by no more than max_angle, whatever their sign.
double shareOfEqual(const Surface& ours, const std::vector<std::uint32_t>& input_index,
                    const pcl::PointCloud<pcl::Normal>& theirs) {
  std::size_t compared = 0, equal = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Eigen::Vector3f normal = theirs[input_index[ours.source[i]]].getNormalVector3fMap();
    if (!normal.allFinite() || !ours.normal(i).allFinite()) continue;
    ++compared;
    equal += std::abs(normal.dot(ours.normal(i))) >= std::cos(max_angle);
  }
  return double(equal) / double(compared);
}

/// For each point that sanitize() keeps its index in the input; both are in the same order.
std::vector<std::uint32_t> keptIndices(const Cloud& input, const Cloud& kept) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < input.size() && indices.size() < kept.size(); ++i) {
    if (input.points[i] == kept.points[indices.size()]) indices.push_back(i);
  }
  return indices;
}

void normals(benchmark::State& state, const char* scene, double wanted_ratio) {
  const auto cloud = recordedScene(state, scene);
  if (!cloud) return;
  const SurfaceSettings settings;
  const auto pcl_cloud = test::pclPoints(cloud->points);
  pcl_cloud->width = cloud->width;
  pcl_cloud->height = cloud->height;
  pcl_cloud->is_dense = !cloud->organized();
  pcl::PointCloud<pcl::Normal> theirs;
  Surface ours;
  Cloud kept;
  compare(
      state, [&] { theirs = pclNormals(pcl_cloud, settings.normal_radius); },
      [&] {
        kept = sanitize(*cloud, {});
        ours = prepareSurface(kept, settings, Orientation::sensor, threads);
      },
      wanted_ratio);
  reportAccuracy(state, "share of points with normals within 3 deg",
                 shareOfEqual(ours, keptIndices(*cloud, kept), theirs), 0.95);
}

BENCHMARK_CAPTURE(normals, organized, organized_scene, 25)->Apply(asPair);
BENCHMARK_CAPTURE(normals, unorganized, unorganized_scene, 5)->Apply(asPair);

}  // namespace
}  // namespace sks::bench
