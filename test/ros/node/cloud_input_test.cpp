// SPDX-License-Identifier: BSD-3-Clause
#include "ros/cloud_input.hpp"

#include <future>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/publisher.h>
#include <ros/spinner.h>
#include <sensor_msgs/Image.h>

#include <sks_detector/error.hpp>

#include "error_of.hpp"
#include "ros/topic_advice.hpp"

namespace sks_detector {
namespace {

using sks::ErrorCode;
using sks::test::errorOf;
using ::testing::HasSubstr;

class CloudInputTest : public ::testing::Test {
protected:
  CloudInputTest() : handle_("~cloud_input"), input_((handle_.setCallbackQueue(&queue_), handle_)) {
    publisher_ = handle_.advertise<sensor_msgs::PointCloud2>("points", 10);
    spinner_.start();
  }
  ~CloudInputTest() override {
    input_.stop();
    spinner_.stop();
  }

  template <typename Condition>
  static bool eventually(Condition condition) {
    for (int i = 0; i < 6000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return condition();
  }
  bool connects() {
    return eventually([&] { return publisher_.getNumSubscribers() == 1; });
  }
  bool disconnects() {
    return eventually([&] { return publisher_.getNumSubscribers() == 0; });
  }

  /// Publishes a cloud of a width by which it is known again.
  void publish(std::uint32_t width) {
    const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
    cloud->width = width;
    publisher_.publish(cloud);
  }

  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  CloudInput input_;
  ros::Publisher publisher_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

TEST_F(CloudInputTest, SubscribesOnlyWhileCloudsAreWanted) {
  EXPECT_THAT(input_.topic(), HasSubstr("cloud_input/points"));
  EXPECT_FALSE(input_.subscribed());
  EXPECT_EQ(input_.silence(), 0);
  input_.setWanted(true);
  EXPECT_TRUE(input_.subscribed());
  ASSERT_TRUE(connects());
  EXPECT_TRUE(eventually([&] { return input_.publishers() == 1; }));
  input_.setWanted(false);
  EXPECT_FALSE(input_.subscribed());
  EXPECT_TRUE(disconnects());
}

TEST_F(CloudInputTest, TheNewestWinsAndWhatItOvertookIsCounted) {
  input_.setWanted(true);
  ASSERT_TRUE(connects());
  for (std::uint32_t i = 1; i <= 5; ++i) {
    publish(i);
    ASSERT_TRUE(eventually([&] { return input_.counts().received == i; }));
  }
  EXPECT_EQ(input_.take()->cloud->width, 5U);
  EXPECT_EQ(input_.counts().dropped, 4U);
  publish(6);
  EXPECT_EQ(input_.take()->cloud->width, 6U);
  EXPECT_EQ(input_.counts().received, 6U);
  EXPECT_EQ(input_.counts().dropped, 4U);
}

TEST_F(CloudInputTest, KeepsNoCloudThatIsNotWantedAnyMore) {
  input_.setWanted(true);
  ASSERT_TRUE(connects());
  publish(1);
  ASSERT_TRUE(eventually([&] { return input_.counts().received == 1; }));
  input_.setWanted(false);
  ASSERT_TRUE(disconnects());
  input_.setWanted(true);
  ASSERT_TRUE(connects());
  publish(2);
  EXPECT_EQ(input_.take()->cloud->width, 2U);
}

TEST_F(CloudInputTest, TheNextCloudComesWhileNoneAreWanted) {
  auto next = std::async(std::launch::async, [&] { return input_.next(30); });
  ASSERT_TRUE(connects());
  publish(7);
  EXPECT_EQ(next.get()->width, 7U);
  EXPECT_TRUE(disconnects());
  EXPECT_EQ(input_.counts().received, 0U) << "it was not for take()";
}

TEST_F(CloudInputTest, TheNextCloudIsNotTakenFromTheOthers) {
  input_.setWanted(true);
  ASSERT_TRUE(connects());
  auto next = std::async(std::launch::async, [&] { return input_.next(30); });
  std::uint32_t sent = 0;  // until the service waits
  while (next.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) publish(++sent);
  EXPECT_GE(next.get()->width, 1U);
  EXPECT_GE(input_.take()->cloud->width, 1U);
}

TEST_F(CloudInputTest, SaysWhereNoCloudCame) {
  const std::string failure = errorOf(ErrorCode::bad_data, [&] { input_.next(0.05); });
  EXPECT_THAT(failure, HasSubstr("no cloud came on " + input_.topic() + " within 0.05 s"));
  EXPECT_THAT(failure, HasSubstr("publisher"));
}

TEST_F(CloudInputTest, SilenceGrowsUntilTheNextCloud) {
  input_.setWanted(true);
  ASSERT_TRUE(connects());
  EXPECT_TRUE(eventually([&] { return input_.silence() > 0.2; }));
  const auto before = CloudInput::Clock::now();
  publish(1);
  ASSERT_TRUE(input_.take());
  const double silence = input_.silence();
  EXPECT_LE(silence, std::chrono::duration<double>(CloudInput::Clock::now() - before).count());
}

TEST_F(CloudInputTest, StopLetsAllGoForGood) {
  auto frame = std::async(std::launch::async, [&] { return input_.take().has_value(); });
  auto next = std::async(std::launch::async, [&] { return errorOf(ErrorCode::bad_data, [&] { input_.next(1000); }); });
  ASSERT_TRUE(connects());
  input_.stop();
  EXPECT_FALSE(frame.get());
  EXPECT_THAT(next.get(), HasSubstr("shuts down"));
  input_.setWanted(true);
  EXPECT_FALSE(input_.subscribed());
  EXPECT_FALSE(input_.take());
}

TEST_F(CloudInputTest, SaysThatATopicIsNotOneOfClouds) {
  ros::Publisher images = handle_.advertise<sensor_msgs::Image>("images", 1);
  const std::string description = describeInput(images.getTopic(), 0, "/other");
  EXPECT_EQ(description,
            "it is a topic of sensor_msgs/Image, not of sensor_msgs/PointCloud2; depth_images.launch makes clouds of "
            "depth and colour images");
}

TEST_F(CloudInputTest, NamesTheTopicsOfCloudsWhereThereIsNoPublisher) {
  EXPECT_EQ(describeInput("/nothing", 0, "/other"),
            "it has no publisher; topics of clouds are " + publisher_.getTopic());
  EXPECT_EQ(describeInput("/nothing", 0, handle_.getNamespace()), "it has no publisher; no topic of clouds has one");
  EXPECT_EQ(describeInput(publisher_.getTopic(), 1, "/other"), "it has 1 publisher");
}

}  // namespace
}  // namespace sks_detector
