// SPDX-License-Identifier: BSD-3-Clause
#include "ros/error_report.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace sks_detector {
namespace {

class ErrorReportTest : public ::testing::Test {
protected:
  std::string lastError() const { return board_.current().last_error; }

  ros::NodeHandle handle_{"~error_report"};
  DetectorSlot slot_{sks::Settings()};
  StatusBoard board_{handle_, slot_};
  ErrorReport report_{board_};
};

TEST_F(ErrorReportTest, LeavesErrorsInTheStatusButNotWarnings) {
  report_.error("cloud", "it is empty");
  EXPECT_EQ(lastError(), "it is empty");
  report_.warning("age", "it is old");
  EXPECT_EQ(lastError(), "it is empty");
}

TEST_F(ErrorReportTest, SaysOfEachKindWhatIsNewOnceASecond) {
  report_.error("cloud", "it is empty");
  report_.error("transform", "there is none");
  EXPECT_EQ(lastError(), "there is none") << "of another kind";
  report_.error("cloud", "it is empty");
  EXPECT_EQ(lastError(), "there is none") << "was said just now";
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  report_.error("cloud", "it is empty");
  EXPECT_EQ(lastError(), "there is none") << "the same is said twice a minute";
  report_.error("cloud", "it is malformed");
  EXPECT_EQ(lastError(), "it is malformed");
}

TEST_F(ErrorReportTest, AnErrorThatIsGoneLeavesTheLatestOfTheOthers) {
  report_.error("cloud", "it is empty");
  report_.error("transform", "there is none");
  report_.clear("transform");
  EXPECT_EQ(lastError(), "it is empty");
  report_.clear("cloud");
  EXPECT_EQ(lastError(), "");
  report_.error("cloud", "it is empty");
  EXPECT_EQ(lastError(), "it is empty") << "though the log said it just now";
}

}  // namespace
}  // namespace sks_detector
