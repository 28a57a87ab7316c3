// SPDX-License-Identifier: BSD-3-Clause
// Normals from the usable points of a cloud.
#include <cmath>

#include <pcl/features/normal_3d_omp.h>

#include <sks_detector/stages/surface.hpp>

#include "core/surface/image_normals.hpp"
#include "core/surface/sanitize.hpp"
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

/// Share of the points at which both normals deviate by no more than max_angle, whatever their sign.
class Agreement {
public:
  void add(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    if (!a.allFinite() || !b.allFinite()) return;
    ++compared_;
    equal_ += std::abs(a.dot(b)) >= std::cos(max_angle);
  }
  void report(benchmark::State& state) const {
    reportAccuracy(state, "share of points with normals within 3 deg", double(equal_) / double(compared_), 0.95);
  }

private:
  std::size_t compared_ = 0, equal_ = 0;
};

pcl::PointCloud<pcl::PointXYZ>::Ptr toPcl(const Cloud& cloud) {
  const auto points = test::pclPoints(cloud.points);
  points->width = cloud.width;
  points->height = cloud.height;
  points->is_dense = !cloud.organized();
  return points;
}

/// Both sides look for neighbours in the image.
void organizedNormals(benchmark::State& state) {
  const auto cloud = recordedScene(state, organized_scene);
  if (!cloud) return;
  const SurfaceSettings settings;
  const auto pcl_cloud = toPcl(*cloud);
  const Cloud usable = sanitize(*cloud, {});
  pcl::PointCloud<pcl::Normal> theirs;
  std::vector<Eigen::Vector3f> ours;
  compare(
      state, [&] { theirs = pclNormals(pcl_cloud, settings.normal_radius); },
      [&] { imageNormals(usable, *fitPinhole(usable, threads), 1, settings, threads, ours); }, 25);
  Agreement agreement;
  for (std::size_t i = 0; i < ours.size(); ++i) agreement.add(ours[i], theirs[usable.pixels[i]].getNormalVector3fMap());
  agreement.report(state);
}

/// Both sides build their search structure: PCL's a kd-tree; ours, the sorted surface, serves the later stages too.
void unorganizedNormals(benchmark::State& state) {
  const auto cloud = recordedScene(state, unorganized_scene);
  if (!cloud) return;
  const SurfaceSettings settings;
  const Cloud usable = sanitize(*cloud, {});
  const auto pcl_cloud = toPcl(usable);
  pcl::PointCloud<pcl::Normal> theirs;
  Surface ours;
  compare(
      state, [&] { theirs = pclNormals(pcl_cloud, settings.normal_radius); },
      [&] { ours = prepareSurface(usable, settings, Orientation::sensor, threads); }, 5);
  Agreement agreement;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    agreement.add(ours.normal(i), theirs[ours.source[i]].getNormalVector3fMap());
  }
  agreement.report(state);
}

BENCHMARK(organizedNormals)->Apply(asPair);
BENCHMARK(unorganizedNormals)->Apply(asPair);

}  // namespace
}  // namespace sks::bench
