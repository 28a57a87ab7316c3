// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>

#include <sks_detector/cloud_io.hpp>

#include "io/dataset.hpp"
#include "io/file.hpp"
#include "made_up_bag.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::CommandRun;
using ::testing::HasSubstr;

constexpr std::size_t any_size = std::size_t(1) << 30;

class SimulatedBag : public ::testing::Test {
protected:
  CommandRun simulate(const std::string& folder, std::vector<std::string> more) const {
    more.insert(more.begin(), {"simulate", "--output", folder_.path(folder), "--mesh", "mug=builtin:mug", "--mesh",
                               "duck=builtin:duck", "--scenes", "2", "--objects", "2", "--distractors", "1"});
    return test::runSks(more);
  }
  /// The messages of a topic.
  template <typename Message>
  std::vector<Message> messages(const std::string& path, const std::string& topic) const {
    const rosbag::Bag bag(path, rosbag::bagmode::Read);
    rosbag::View view(bag, [&](const rosbag::ConnectionInfo* connection) { return connection->topic == topic; });
    std::vector<Message> result;
    for (const rosbag::MessageInstance& instance : view) result.push_back(*instance.instantiate<Message>());
    return result;
  }
  test::TemporaryFolder folder_;
};

TEST_F(SimulatedBag, HoldsCloudsTruthCameraAndTransforms) {
  const CommandRun run = simulate("a", {"--bag", "--rate", "4", "--repeat", "2"});
  ASSERT_EQ(run.status, 0) << run.errors;
  const std::string path = folder_.path("a/scenes.bag");
  const auto clouds = messages<sensor_msgs::PointCloud2>(path, "/camera/depth_registered/points");
  const auto truth = messages<sks_detector::DetectionArray>(path, "/ground_truth");
  const auto cameras = messages<sensor_msgs::CameraInfo>(path, "/camera/rgb/camera_info");
  const auto transforms = messages<tf2_msgs::TFMessage>(path, "/tf");
  ASSERT_EQ(clouds.size(), 4u);
  ASSERT_EQ(truth.size(), 4u);
  ASSERT_EQ(cameras.size(), 4u);
  ASSERT_EQ(transforms.size(), 4u);
  const DataSet data_set = loadDataSet(folder_.path("a/dataset.yaml"));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(clouds[i].header.frame_id, "camera_rgb_optical_frame");
    EXPECT_NEAR((clouds[i].header.stamp - clouds[0].header.stamp).toSec(), 0.25 * double(i), 1e-9);
    EXPECT_EQ(truth[i].header.stamp, clouds[i].header.stamp);
    EXPECT_EQ(truth[i].header.frame_id, clouds[i].header.frame_id);
    EXPECT_EQ(cameras[i].header.stamp, clouds[i].header.stamp);
    EXPECT_EQ(cameras[i].K[0], 525);
    EXPECT_EQ(transforms[i].transforms[0].header.stamp, clouds[i].header.stamp);
    EXPECT_EQ(transforms[i].transforms[0].header.frame_id, "table");
    EXPECT_EQ(transforms[i].transforms[0].child_frame_id, "camera_rgb_optical_frame");

    const Scene& scene = data_set.scenes[i / 2];
    const Cloud cloud = sks_detector::toCloud(clouds[i]), file = readCloud(scene.path);
    EXPECT_EQ(cloud.width, 640u);
    ASSERT_EQ(cloud.size(), file.size());
    EXPECT_EQ(cloud.points[200000], file.points[200000]);
    ASSERT_EQ(truth[i].detections.size(), 2u);
    for (const GroundTruth& object : scene.objects) {
      const auto& first = truth[i].detections[0];
      const auto& same = first.object == object.object ? first : truth[i].detections[1];
      EXPECT_EQ(same.view, object.reference);
      EXPECT_NEAR(same.box_center.position.x, object.position.x(), 1e-6);
      EXPECT_NEAR(same.pose.pose.position.z, object.T_scene_reference->translation().z(), 1e-6);
      EXPECT_NEAR(same.score, *object.visibility, 1e-6);
      EXPECT_GT(same.box_size.x, 0.03);
    }
  }
}

TEST_F(SimulatedBag, SameSeedSameBytes) {
  ASSERT_EQ(simulate("a", {"--bag"}).status, 0);
  ASSERT_EQ(simulate("b", {"--bag", folder_.path("other.bag")}).status, 0);
  ASSERT_EQ(simulate("c", {"--bag", "--seed", "2"}).status, 0);
  const std::string bytes = readTextFile(folder_.path("a/scenes.bag"), any_size);
  EXPECT_TRUE(bytes == readTextFile(folder_.path("other.bag"), any_size));
  EXPECT_FALSE(bytes == readTextFile(folder_.path("c/scenes.bag"), any_size));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("b/scenes.bag")));
}

TEST_F(SimulatedBag, IsFoundGoodByInfo) {
  ASSERT_EQ(simulate("a", {"--bag"}).status, 0);
  const CommandRun run = test::runSks({"bag", "info", folder_.path("a/scenes.bag")});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.output, HasSubstr("no remarks"));
}

TEST_F(SimulatedBag, RefusesWithTheReason) {
  EXPECT_THAT(simulate("a", {"--bag", "--rate", "0"}).errors, HasSubstr("must be in [0.001, 1000] Hz"));
  EXPECT_THAT(simulate("a", {"--bag", "--repeat", "0"}).errors, HasSubstr("--repeat 0 must be in"));
  EXPECT_THAT(simulate("a", {"--rate", "2"}).errors, HasSubstr("--bag"));
  EXPECT_THAT(simulate("a", {"--bag", folder_.path("none/x.bag")}).errors,
              HasSubstr("cannot write '" + folder_.path("none/x.bag")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("a/scenes.bag.active")));
}

}  // namespace
}  // namespace sks

#endif
