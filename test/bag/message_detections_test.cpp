// SPDX-License-Identifier: BSD-3-Clause
// Clouds whose rows are described in other ways, as drivers publish them: what is detected is the same.
#include <gtest/gtest.h>

#include "ros/cloud_message.hpp"
#include "simulation/notched_scene.hpp"

namespace sks {

TEST(MessageDetections, DoNotDependOnHowRowsAreDescribed) {
  const Codebook codebook =
      train(meshSamples("thing", "thing", std::make_shared<Mesh>(test::notchedMesh()), test::closeViews()), {}, "a");
  const sensor_msgs::PointCloud2 plain = sks_detector::toMessage(test::notchedScene().view.cloud, std_msgs::Header());
  ASSERT_GT(plain.height, 1u);
  const std::vector<Detection> expected = test::detectionsInScene(codebook, sks_detector::toCloud(plain));
  ASSERT_EQ(expected.size(), 1u);
  test::expectNear(expected[0].T_scene_model, test::notchedScene().objects.at(0).T_camera_model, 0.005, 3);

  sensor_msgs::PointCloud2 whole = plain, none = plain, padded = plain;
  whole.row_step = std::uint32_t(plain.data.size());  // of all rows
  none.row_step = 0;
  padded.data.clear();
  padded.row_step = plain.row_step + 24;
  for (std::size_t row = 0; row < plain.height; ++row) {
    const auto begin = plain.data.begin() + std::ptrdiff_t(row * plain.row_step);
    padded.data.insert(padded.data.end(), begin, begin + std::ptrdiff_t(plain.row_step));
    padded.data.insert(padded.data.end(), 24, 0xff);
  }
  for (const sensor_msgs::PointCloud2& message : {whole, none, padded}) {
    SCOPED_TRACE(message.row_step);
    const std::vector<Detection> found = test::detectionsInScene(codebook, sks_detector::toCloud(message));
    test::expectSameDetections(found, expected);
    EXPECT_EQ(found.at(0).score, expected[0].score);
  }
}

}  // namespace sks
