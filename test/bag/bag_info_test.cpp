// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.hpp"
#include "made_up_bag.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using nlohmann::json;
using test::at;
using test::CommandRun;
using test::runSks;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class BagInfo : public ::testing::Test {
protected:
  std::string path() const { return folder_.path("test.bag"); }
  CommandRun info(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"bag", "info", path()});
    return runSks(more);
  }
  /// The result for a bag into which `write(bag)` writes.
  template <typename Write>
  json infoOf(Write write, int status = 0) const {
    {
      rosbag::Bag bag(path(), rosbag::bagmode::Write);
      write(bag);
    }
    const CommandRun run = info({"--json", "-"});
    EXPECT_EQ(run.status, status) << run.errors;
    return json::parse(run.output);
  }
  /// The remarks, as "severity: topic: message".
  template <typename Write>
  std::vector<std::string> remarksOn(Write write, int status = 0) const {
    std::vector<std::string> remarks;
    const json result = infoOf(write, status);
    for (const json& remark : result["remarks"]) {
      remarks.push_back(remark["severity"].get<std::string>() + ": " + remark["topic"].get<std::string>() + ": " +
                        remark["message"].get<std::string>());
    }
    return remarks;
  }
  /// The refusal of the bag that is there.
  std::string refusal() const {
    const CommandRun run = info();
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.output, "");
    return run.errors;
  }
  static void writeClouds(rosbag::Bag& bag, const std::vector<double>& seconds) {
    for (const double s : seconds) bag.write("/points", at(s), test::wallMessage(s));
  }
  test::TemporaryFolder folder_;
};

sensor_msgs::CameraInfo cameraInfo(std::uint32_t width, double fx) {
  sensor_msgs::CameraInfo info;
  info.header = test::header(0);
  info.width = width;
  info.height = 12;
  info.K[0] = fx;
  return info;
}

TEST_F(BagInfo, SaysWhatIsInAGoodBag) {
  const json result = infoOf([](rosbag::Bag& bag) {
    for (const double s : {0.0, 0.5, 1.0}) {
      bag.write("/tf", at(s), test::transform(s, "map", "camera"));
      bag.write("/points", at(s), test::wallMessage(s));
      bag.write("/camera_info", at(s), cameraInfo(16, 20));
      bag.write("/found", at(s), test::detections(s, {test::detection("mug", 0, 0.9)}));
    }
  });
  EXPECT_THAT(result["remarks"], IsEmpty()) << result["remarks"];
  EXPECT_EQ(result["usable_topics"], json::array({"/points"}));
  EXPECT_EQ(result["messages"], 12);
  const json& cloud = result["clouds"][0];
  EXPECT_EQ(cloud["messages"], 3);
  EXPECT_EQ(cloud["usable"], 3);
  EXPECT_EQ(cloud["width"], 16);
  EXPECT_EQ(cloud["height"], 12);
  EXPECT_EQ(cloud["organized"], true);
  EXPECT_EQ(cloud["color"], true);
  EXPECT_EQ(cloud["point_step"], 16);
  EXPECT_EQ(cloud["fields"], "x y z rgb");
  EXPECT_NEAR(cloud["invalid_share"], 1.0 / 192, 1e-6);
  EXPECT_NEAR(cloud["rate"], 2, 1e-6);
  EXPECT_EQ(cloud["frames"], json::array({"camera"}));
  EXPECT_EQ(result["frames"], (json{{"camera", "map"}, {"map", nullptr}}));
  EXPECT_EQ(result["camera_info"][0]["width"], 16);
  EXPECT_EQ(result["detections"][0]["with_cloud"], 3);

  const CommandRun text = info();
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.output, AllOf(HasSubstr("12 messages in 1.0 s from 1600000000.000000000"), HasSubstr("16 x 12"),
                                 HasSubstr("camera < map"), HasSubstr("no remarks")));
}

TEST_F(BagInfo, SaysWhyCloudsAreRefused) {
  const auto with = [&](auto change) {
    return remarksOn(
        [&](rosbag::Bag& bag) {
          sensor_msgs::PointCloud2 message = test::wallMessage(0);
          change(message);
          bag.write("/points", at(0), message);
        },
        1);
  };
  const auto refused = [](const std::string& reason) {
    return Contains(AllOf(HasSubstr("error: /points: 1 of 1 clouds would be refused: "), HasSubstr(reason)));
  };
  EXPECT_THAT(with([](auto& message) { message.fields[2].name = "depth"; }), refused("there is no field 'z'"));
  EXPECT_THAT(with([](auto& message) { message.is_bigendian = true; }), refused("the cloud is big-endian"));
  EXPECT_THAT(with([](auto& message) { message.data.resize(100); }), refused("but holds 100 bytes"));
  EXPECT_THAT(with([](auto& message) {
                Cloud cloud = test::wall();
                for (Eigen::Vector3f& point : cloud.points) point *= 0.001f;
                message = sks_detector::toMessage(cloud, message.header);
              }),
              refused("the cloud is too small: it is 0.15 x 0.11 x "));
  EXPECT_THAT(with([](auto& message) { message.fields[2].name = "a\nb" + std::string(1000, 'x'); }),
              refused("a\\nbxxx"));
  EXPECT_THAT(with([](auto& message) { message.data.assign(message.data.size(), 0xff); }), refused("192 are NaN"));
  EXPECT_THAT(with([](auto& message) {
                Cloud cloud = test::wall();
                for (Eigen::Vector3f& point : cloud.points) point *= 1000;
                message = sks_detector::toMessage(cloud, message.header);
              }),
              refused("looks like millimetres"));
  EXPECT_THAT(with([](auto& message) {
                message.width = message.height = message.row_step = 0;
                message.data.clear();
              }),
              refused("the cloud is empty"));
  EXPECT_THAT(info().errors, HasSubstr("has no cloud that the node could use; see the remarks"));
}

TEST_F(BagInfo, SaysWhatIsOddAboutClouds) {
  const std::vector<std::string> remarks = remarksOn([](rosbag::Bag& bag) {
    Cloud plain = test::wall(false);
    plain.width *= plain.height;
    plain.height = 1;
    sensor_msgs::PointCloud2 message = sks_detector::toMessage(plain, test::header(0, "/camera"));
    message.is_dense = true;
    bag.write("/plain", at(0), message);
    message.header = test::header(1, "");
    bag.write("/plain", at(1), message);
  });
  EXPECT_THAT(remarks, Contains(HasSubstr("warning: /plain: there is no colour: a codebook with CSHOT")));
  EXPECT_THAT(remarks, Contains(HasSubstr("note: /plain: the clouds are not organised")));
  EXPECT_THAT(remarks, Contains(HasSubstr("note: /plain: 2 of 2 clouds say is_dense and hold NaN")));
  EXPECT_THAT(remarks, Contains(HasSubstr("note: /plain: the frame '/camera' begins with a slash")));
  EXPECT_THAT(remarks, Contains(HasSubstr("error: /plain: the header has no frame_id")));
  EXPECT_THAT(remarks, Contains(HasSubstr("warning: /plain: the clouds are in different frames: '', '/camera'")));
}

TEST_F(BagInfo, SaysWhatIsOddAboutStamps) {
  const auto clouds = [](const std::vector<double>& seconds) {
    return [seconds](rosbag::Bag& bag) { writeClouds(bag, seconds); };
  };
  EXPECT_THAT(remarksOn([](rosbag::Bag& bag) {
                for (const double stamp : {0.1, 0.2, 0.0})
                  bag.write("/points", at(0.3 - stamp), test::wallMessage(stamp));
              }),
              Contains(HasSubstr("2 stamps are earlier than the one before")));
  EXPECT_THAT(remarksOn(clouds({0, 0.1, 0.1, 0.2})), Contains(HasSubstr("1 stamps repeat the one before")));
  EXPECT_THAT(remarksOn(clouds({0, 0.1, 0.2, 3.2, 3.3})),
              Contains(HasSubstr("1 gaps, the longest of 3.0 s at 10.0 Hz")));
  EXPECT_THAT(remarksOn([](rosbag::Bag& bag) { bag.write("/points", at(9), test::wallMessage(2)); }),
              Contains(HasSubstr("stamps are up to 7.0 s off the time of recording")));
  EXPECT_THAT(remarksOn([](rosbag::Bag& bag) {
                sensor_msgs::PointCloud2 message = test::wallMessage(0);
                message.header.stamp = ros::Time();
                bag.write("/points", at(0), message);
              }),
              Contains(HasSubstr("1 of 1 stamps are zero")));
}

TEST_F(BagInfo, SaysWhatIsOddAboutTransforms) {
  const auto with = [&](const std::vector<tf2_msgs::TFMessage>& transforms) {
    return remarksOn([&](rosbag::Bag& bag) {
      writeClouds(bag, {0, 1, 2});
      for (const auto& message : transforms) bag.write("/tf", at(0), message);
    });
  };
  EXPECT_THAT(with({}), Contains(HasSubstr("note: /tf: there are no transforms")));
  EXPECT_THAT(with({test::transform(0, "map", "base")}), Contains(HasSubstr("its frame 'camera' is not in /tf")));
  EXPECT_THAT(with({test::transform(0, "map", "camera")}),
              Contains(AllOf(HasSubstr("2 of 3 clouds lie outside of the time in which /tf has 'map' -> 'camera'"),
                             HasSubstr("belongs on /tf_static"))));
  EXPECT_THAT(with({test::transform(0, "map", "camera"), test::transform(2, "/map", "/camera")}),
              AllOf(Contains(HasSubstr("frames begin with a slash, which tf2 refuses: '/camera', '/map'")),
                    Not(Contains(HasSubstr("lie outside")))));
  EXPECT_THAT(with({test::transform(0, "a", "b"), test::transform(0, "b", "a")}),
              Contains(HasSubstr("error: /tf: frames are each other's parents: 'a', 'b'")));
  EXPECT_THAT(with({test::transform(0, "a", "camera"), test::transform(0, "b", "camera")}),
              Contains(HasSubstr("'camera' has several parents")));
  EXPECT_THAT(with({test::transform(0, "a", "camera"), test::transform(0, "b", "c")}),
              Contains(HasSubstr("several trees, with the roots 'a', 'b'")));
  EXPECT_THAT(remarksOn([](rosbag::Bag& bag) {
                writeClouds(bag, {0, 1, 2});
                bag.write("/tf_static", at(0), test::transform(0, "map", "camera"));
              }),
              IsEmpty());
}

TEST_F(BagInfo, ComparesCameraAndDetectionsWithTheClouds) {
  const std::vector<std::string> remarks = remarksOn([](rosbag::Bag& bag) {
    writeClouds(bag, {0});
    bag.write("/info", at(0), cameraInfo(640, 0));
    bag.write("/found", at(0), test::detections(5, {}));
  });
  EXPECT_THAT(remarks, Contains(HasSubstr("warning: /info: the camera is not calibrated")));
  EXPECT_THAT(remarks, Contains(HasSubstr("it says 640 x 12 pixels, the clouds of /points are 16 x 12")));
  EXPECT_THAT(remarks, Contains(HasSubstr("note: /found: 1 of 1 arrays have the stamp of no cloud")));
}

TEST_F(BagInfo, SaysWhereThereAreNoClouds) {
  EXPECT_THAT(remarksOn([](rosbag::Bag& bag) { bag.write("/tf", at(0), test::transform(0, "a", "b")); }, 1),
              Contains(HasSubstr("error: clouds: there is no sensor_msgs/PointCloud2")));
}

TEST_F(BagInfo, RefusesWhatIsNoBag) {
  EXPECT_THAT(refusal(), HasSubstr("test.bag': No such file or directory"));
  test::writeFile(path(), "");
  EXPECT_THAT(refusal(), HasSubstr("is an empty file"));
  test::writeFile(path(), "just some text\n");
  EXPECT_THAT(refusal(), HasSubstr("is no ROS bag"));
  { rosbag::Bag bag(path(), rosbag::bagmode::Write); }
  EXPECT_THAT(refusal(), HasSubstr("holds no messages"));
  {
    rosbag::Bag bag(path(), rosbag::bagmode::Write);
    writeClouds(bag, {0, 1, 2});
  }
  const std::string whole = readTextFile(path());
  test::writeFile(path(), whole.substr(0, whole.size() / 2));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("is damaged"), HasSubstr("rosbag reindex")));
  rosbag::Bag unfinished(path(), rosbag::bagmode::Write);
  writeClouds(unfinished, {0});
  EXPECT_THAT(refusal(), AllOf(HasSubstr("has no index"), HasSubstr("rosbag reindex")));
}

}  // namespace
}  // namespace sks

#endif
