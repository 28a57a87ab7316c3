// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/param.h>

namespace sks_detector {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

class ParametersTest : public ::testing::Test {
protected:
  ~ParametersTest() override { ros::param::del(handle_.getNamespace()); }

  const ros::NodeHandle handle_{"~parameters"};
};

TEST_F(ParametersTest, AreDefaultsWhereNothingIsGiven) {
  const ParameterReading reading = readParameters(handle_);
  EXPECT_THAT(reading.given, IsEmpty());
  EXPECT_THAT(reading.errors, IsEmpty());
  EXPECT_THAT(reading.warnings, IsEmpty());
  EXPECT_EQ(reading.configuration.node.tf_timeout, NodeSettings().tf_timeout);
}

TEST_F(ParametersTest, AreReadFromGroups) {
  handle_.setParam("keypoints/discard", 0.25);
  handle_.setParam("voting/min_votes", 4);
  handle_.setParam("tf_timeout", 1);  // a whole number stands for any number
  handle_.setParam("target_frame", "map");
  handle_.setParam("always_on", true);
  const ParameterReading reading = readParameters(handle_);
  EXPECT_THAT(reading.errors, IsEmpty());
  EXPECT_THAT(reading.given,
              UnorderedElementsAre("always_on", "keypoints.discard", "target_frame", "tf_timeout", "voting.min_votes"));
  EXPECT_EQ(reading.configuration.detector.keypoints.discard, 0.25);
  EXPECT_EQ(reading.configuration.detector.voting.min_votes, 4);
  EXPECT_EQ(reading.configuration.node.tf_timeout, 1);
  EXPECT_EQ(reading.configuration.node.target_frame, "map");
  EXPECT_TRUE(reading.configuration.node.always_on);
}

TEST_F(ParametersTest, OfTheDetectorAreOneSet) {
  handle_.setParam("keypoints/discard", 2.0);
  handle_.setParam("keypoints/grid_size", 0.03);
  handle_.setParam("tf_timeout", 3.0);
  const ParameterReading reading = readParameters(handle_);
  EXPECT_THAT(reading.errors, ElementsAre(AllOf(HasSubstr("/keypoints/discard"), HasSubstr("stay at their defaults"))));
  EXPECT_EQ(reading.configuration.detector.keypoints.grid_size, sks::Settings().keypoints.grid_size);
  EXPECT_EQ(reading.configuration.node.tf_timeout, 3);
}

TEST_F(ParametersTest, OfTheNodeStandEachForItself) {
  handle_.setParam("tf_timeout", -1.0);
  handle_.setParam("target_frame", "map");
  handle_.setParam("keypoints/grid_size", 0.03);
  const ParameterReading reading = readParameters(handle_);
  EXPECT_THAT(reading.errors, ElementsAre(AllOf(HasSubstr("/tf_timeout"), HasSubstr("0 to 60 [s]"))));
  EXPECT_EQ(reading.configuration.node.tf_timeout, NodeSettings().tf_timeout);
  EXPECT_EQ(reading.configuration.node.target_frame, "map");
  EXPECT_EQ(reading.configuration.detector.keypoints.grid_size, 0.03);
}

TEST_F(ParametersTest, UnknownOnesAreWarnedAbout) {
  handle_.setParam("keypoints/discrad", 0.1);
  const std::string name = handle_.getNamespace() + "/keypoints/";
  EXPECT_THAT(readParameters(handle_).warnings,
              ElementsAre("unknown parameter " + name + "discrad is ignored: did you mean " + name + "discard?"));
}

TEST_F(ParametersTest, OldNamesAreReplacedByTheMirror) {
  handle_.setParam("verification/ambiguity", 1.5);
  handle_.setParam("verification/candidates", 0);
  const ParameterReading reading = readParameters(handle_);
  EXPECT_THAT(reading.given, UnorderedElementsAre("detection.hypotheses", "matching.ambiguity"));
  EXPECT_EQ(reading.warnings.size(), 2U);
  ParameterMirror(handle_).write(reading.configuration);
  EXPECT_FALSE(handle_.hasParam("verification/ambiguity"));
  const ParameterReading again = readParameters(handle_);  // as when the node starts once more
  EXPECT_THAT(again.errors, IsEmpty());
  EXPECT_THAT(again.warnings, IsEmpty());
  EXPECT_EQ(again.configuration.detector.matching.ambiguity, 1.5);
  EXPECT_EQ(again.configuration.detector.detection.hypotheses, sks::Hypotheses::hough);
}

TEST_F(ParametersTest, MirrorWritesWhatIsInForceAndThenWhatChanges) {
  ParameterMirror mirror(handle_);
  Configuration configuration;
  configuration.node.target_frame = "map";
  mirror.write(configuration);
  const ParameterReading reading = readParameters(handle_);
  EXPECT_EQ(reading.given.size(), parameterInfos().size());
  EXPECT_EQ(reading.configuration.node.target_frame, "map");

  handle_.setParam("tf_timeout", 9.0);  // by somebody else: not in force, but nothing changed here
  configuration.detector.keypoints.discard = 0.75;
  mirror.write(configuration);
  double discard = 0, tf_timeout = 0;
  handle_.getParam("keypoints/discard", discard);
  handle_.getParam("tf_timeout", tf_timeout);
  EXPECT_EQ(discard, 0.75);
  EXPECT_EQ(tf_timeout, 9);
}

}  // namespace
}  // namespace sks_detector
