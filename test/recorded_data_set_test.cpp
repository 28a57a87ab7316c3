// SPDX-License-Identifier: BSD-3-Clause
// Data set files as they are used: the recorded ones, where they are at hand.
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>

#include "io/dataset.hpp"
#include "recorded_data.hpp"

namespace sks {
namespace {

Eigen::Vector3d recordedBoxCenter(const Cloud& cloud) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(INFINITY), high = -low;
  for (const Eigen::Vector3f& point : cloud.points) {
    if (!point.allFinite()) continue;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return 0.5 * (low + high).cast<double>();
}

class RecordedDataSet : public ::testing::TestWithParam<const char*> {};

TEST_P(RecordedDataSet, GroundTruthIsTheBoxCentreOfTheReferenceMappedByThePose) {
  const std::string file = test::recordedData(GetParam() + std::string("/dataset.yaml"));
  if (file.empty()) GTEST_SKIP() << "no recorded data: set SKS_DATA";
  const DataSet data_set = loadDataSet(file);
  EXPECT_THAT(data_set.warnings, ::testing::IsEmpty());
  std::map<std::string, std::string> paths;  // of the training clouds by their names
  for (const TrainingEntry& entry : data_set.training) paths[entry.source] = entry.path;
  std::map<std::string, Eigen::Vector3d> centers;
  std::size_t compared = 0;
  for (const Scene& scene : data_set.scenes) {
    for (const GroundTruth& truth : scene.objects) {
      ASSERT_EQ(paths.count(truth.reference), 1u) << truth.reference;
      if (!truth.T_scene_reference) continue;
      if (centers.count(truth.reference) == 0) {
        centers[truth.reference] = recordedBoxCenter(readCloud(paths[truth.reference], data_set.scale));
      }
      EXPECT_LT((*truth.T_scene_reference * centers[truth.reference] - truth.position).norm(), 1e-4)
          << scene.name << ", " << truth.object;
      ++compared;
    }
  }
  EXPECT_GT(compared, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, RecordedDataSet, ::testing::Values("kinect", "random_views_noise_0.1"),
                         [](const auto& set) { return std::string(set.param).substr(0, 6); });

}  // namespace
}  // namespace sks
