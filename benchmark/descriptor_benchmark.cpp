// SPDX-License-Identifier: BSD-3-Clause
// SHOT and CSHOT with their local reference frames at the keypoints of a scene. Both sides are given the same points,
// normals and keypoints, and their search structure ready-made.
#include <cmath>

#include <pcl/features/shot_omp.h>
#include <pcl/search/kdtree.h>

#include <sks_detector/stages/descriptors.hpp>

#include "core/keypoints/sparse_selection.hpp"
#include "core/surface/sanitize.hpp"
#include "pair.hpp"
#include "pcl_clouds.hpp"
#include "peak.hpp"
#include "recorded_scenes.hpp"

namespace sks::bench {
namespace {

/// A sanitized scene, and what the default settings (SKS-50) make of it.
struct PreparedScene {
  Settings settings;
  Cloud cloud;
  Surface surface;
  Keypoints keypoints;

  explicit PreparedScene(const Cloud& input) : cloud(sanitize(input, settings.sanitize)) {
    surface = prepareSurface(cloud, settings.surface, Orientation::sensor, threads);
    Keypoints all = detectKeypoints(surface, settings.keypoints, threads);
    measureCurvature(surface, all, settings.keypoints, settings.surface, threads);
    keypoints = selectKeypoints(all, settings.keypoints);
  }
};

pcl::PointCloud<pcl::PointXYZ>::Ptr pclSurface(const PreparedScene& scene, pcl::PointXYZ) {
  return test::pclPoints(scene.surface.positions());
}

pcl::PointCloud<pcl::PointXYZ>::Ptr pclKeypoints(const PreparedScene& scene, pcl::PointXYZ) {
  return test::pclPoints(scene.keypoints.positions);
}

pcl::PointXYZRGBA colored(const Eigen::Vector3f& position, const Eigen::Vector3f& color) {
  pcl::PointXYZRGBA point;
  point.getVector3fMap() = position;
  point.r = std::uint8_t(std::lround(color.x()));
  point.g = std::uint8_t(std::lround(color.y()));
  point.b = std::uint8_t(std::lround(color.z()));
  return point;
}

Eigen::Vector3f colorOf(const PreparedScene& scene, std::size_t i) {
  const Rgb color = scene.cloud.colors[scene.surface.source[i]];
  return {float(color.r), float(color.g), float(color.b)};
}

pcl::PointCloud<pcl::PointXYZRGBA>::Ptr pclSurface(const PreparedScene& scene, pcl::PointXYZRGBA) {
  pcl::PointCloud<pcl::PointXYZRGBA>::Ptr points(new pcl::PointCloud<pcl::PointXYZRGBA>);
  for (std::size_t i = 0; i < scene.surface.size(); ++i) {
    points->push_back(colored(scene.surface.point(i), colorOf(scene, i)));
  }
  return points;
}

/// A keypoint has the mean colour of the fifth of its support that stands for it.
pcl::PointCloud<pcl::PointXYZRGBA>::Ptr pclKeypoints(const PreparedScene& scene, pcl::PointXYZRGBA) {
  pcl::PointCloud<pcl::PointXYZRGBA>::Ptr points(new pcl::PointCloud<pcl::PointXYZRGBA>);
  std::vector<PointGrid::Run> runs;
  for (const Eigen::Vector3f& keypoint : scene.keypoints.positions) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    std::size_t count = 0;
    scene.surface.forEachNeighbor(keypoint, 0.2f * float(scene.settings.descriptor.radius), runs,
                                  [&](std::uint32_t i, float) {
                                    sum += colorOf(scene, i);
                                    ++count;
                                  });
    points->push_back(colored(keypoint, count > 0 ? Eigen::Vector3f(sum / float(count)) : sum));
  }
  return points;
}

double cosine(const float* a, const float* b, std::size_t size) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < size; ++i) {
    ab += double(a[i]) * b[i];
    aa += double(a[i]) * a[i];
    bb += double(b[i]) * b[i];
  }
  return ab / std::sqrt(aa * bb);
}

template <typename Theirs>
double shareOfEqual(const Descriptors& ours, const pcl::PointCloud<Theirs>& theirs) {
  std::size_t compared = 0, equal = 0;
  for (std::size_t row = 0; row < ours.keypoints.size(); ++row) {
    const auto& their = theirs[ours.keypoints[row]].descriptor;
    if (!std::isfinite(their[0])) continue;
    ++compared;
    equal += cosine(ours.values.row(row), their, ours.values.cols()) >= 0.999;
  }
  return double(equal) / double(compared);
}

template <typename Point, typename Estimation, typename Descriptor>
void describe(benchmark::State& state, const char* name, DescriptorType type) {
  const auto cloud = recordedScene(state, name);
  if (!cloud) return;
  const PreparedScene scene(*cloud);
  const auto points = pclSurface(scene, Point());
  const auto tree = typename pcl::search::KdTree<Point>::Ptr(new pcl::search::KdTree<Point>);
  tree->setInputCloud(points);
  Estimation estimation(scene.settings.descriptor.radius);
  estimation.setNumberOfThreads(threads);
  estimation.setInputCloud(pclKeypoints(scene, Point()));
  estimation.setSearchSurface(points);
  estimation.setInputNormals(test::pclNormals(scene.surface));
  estimation.setSearchMethod(tree);
  estimation.setRadiusSearch(scene.settings.descriptor.radius);
  estimation.setLRFRadius(float(scene.settings.descriptor.radius));
  pcl::PointCloud<Descriptor> theirs;
  Descriptors ours;
  compare(
      state, [&] { estimation.compute(theirs); },
      [&] { ours = computeDescriptors(scene.surface, scene.keypoints, type, scene.settings.descriptor, threads); }, 8);
  reportAccuracy(state, "share of descriptors with cosine similarity >= 0.999", shareOfEqual(ours, theirs), 0.95);
}

using PclShot = pcl::SHOTEstimationOMP<pcl::PointXYZ, pcl::Normal, pcl::SHOT352>;
using PclCshot = pcl::SHOTColorEstimationOMP<pcl::PointXYZRGBA, pcl::Normal, pcl::SHOT1344>;

void shot(benchmark::State& state) {
  describe<pcl::PointXYZ, PclShot, pcl::SHOT352>(state, unorganized_scene, DescriptorType::shot);
}
void cshot(benchmark::State& state) {
  describe<pcl::PointXYZRGBA, PclCshot, pcl::SHOT1344>(state, organized_scene, DescriptorType::cshot);
}
/// How far SHOT is from what one core can compute at most.
void shotLimit(benchmark::State& state) {
  // Counted in the kernels, for one neighbour: gathering 9 (and the candidates around the sphere as many), the frame's
  // two passes 27, places in the support 75 (two inverse functions of 20 to 25 among them), the weights of five bins
  // 40, their sums 6.
  constexpr double operations_per_neighbor = 170;
  // Written once and read one to three times, from the first or second level of cache: 8 numbers of a neighbour, 5 of
  // its place, 8 of its contributions.
  constexpr double bytes_per_neighbor = 4.0 * (8 * 3 + 5 * 2 + 8 * 2);
  const auto cloud = recordedScene(state, unorganized_scene);
  if (!cloud) return;
  const PreparedScene scene(*cloud);
  std::vector<PointGrid::Run> runs;
  double neighbors = 0;
  for (const Eigen::Vector3f& keypoint : scene.keypoints.positions) {
    scene.surface.forEachNeighbor(keypoint, float(scene.settings.descriptor.radius), runs,
                                  [&](std::uint32_t, float) { ++neighbors; });
  }
  const double peak = peakOperationsPerSecond();
  for (auto _ : state) {
    std::vector<double> times;
    for (int round = 0; round < 15; ++round) {
      times.push_back(milliseconds([&] {
        benchmark::DoNotOptimize(
            computeDescriptors(scene.surface, scene.keypoints, DescriptorType::shot, scene.settings.descriptor, 1));
      }));
    }
    const double seconds = *std::min_element(times.begin(), times.end()) / 1000;
    const double count = double(scene.keypoints.size());
    state.counters["us_per_descriptor"] = 1e6 * seconds / count;
    state.counters["neighbors_per_descriptor"] = neighbors / count;
    state.counters["ns_per_neighbor"] = 1e9 * seconds / neighbors;
    state.counters["Gflops"] = 1e-9 * operations_per_neighbor * neighbors / seconds;
    state.counters["peak_Gflops"] = 1e-9 * peak;
    state.counters["share_of_peak"] = operations_per_neighbor * neighbors / seconds / peak;
    state.counters["GB_per_s_in_cache"] = 1e-9 * bytes_per_neighbor * neighbors / seconds;
    state.SetIterationTime(seconds);
  }
}

BENCHMARK(shotLimit)->Apply(asPair);
BENCHMARK(shot)->Apply(asPair);
BENCHMARK(cshot)->Apply(asPair);

}  // namespace
}  // namespace sks::bench
