// SPDX-License-Identifier: BSD-3-Clause
// What is read from the parameter server, without one.
#include "ros/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ros/parameter_trees.hpp"
#include "ros/reconfigure_messages.hpp"

namespace sks_detector {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using XmlRpc::XmlRpcValue;

const std::string ambiguity_moved =
    "'verification.ambiguity' is now called 'matching.ambiguity'; the old name still works";

ParameterReading read(const XmlRpcValue& tree) {
  return readParameters(tree, "/detector");
}

TEST(ParameterReading, TakesGroupsAndDottedNames) {
  XmlRpcValue tree;
  tree["keypoints"]["discard"] = 0.25;
  tree["detection.threshold"] = 0.75;
  tree["target_frame"] = "map";
  const ParameterReading reading = read(tree);
  EXPECT_THAT(reading.errors, IsEmpty());
  EXPECT_THAT(reading.warnings, IsEmpty());
  EXPECT_THAT(reading.given, UnorderedElementsAre("keypoints.discard", "detection.threshold", "target_frame"));
  EXPECT_EQ(reading.configuration.detector.keypoints.discard, 0.25);
  EXPECT_EQ(reading.configuration.detector.detection.threshold, 0.75);
  EXPECT_EQ(reading.configuration.node.target_frame, "map");
  EXPECT_THAT(read(XmlRpcValue()).given, IsEmpty());
}

TEST(ParameterReading, RefusesRepeatedKeys) {
  XmlRpcValue tree;
  tree["keypoints"]["discard"] = 0.25;
  tree["keypoints.discard"] = 0.25;
  EXPECT_THAT(read(tree).errors, ElementsAre("parameter /detector/keypoints/discard: 'keypoints.discard' is set twice; "
                                             "keep one; all settings of the detector stay at their defaults"));
  EXPECT_EQ(read(tree).configuration.detector.keypoints.discard, sks::Settings().keypoints.discard);
}

TEST(ParameterReading, IgnoresDeepNests) {
  const std::string too_deep = test::deepName("/detector");
  EXPECT_THAT(read(test::deepNest(100)).warnings,
              ElementsAre("parameter " + too_deep + " is ignored: it is nested too deeply"));
  EXPECT_THAT(read(test::deepNest(100)).errors, IsEmpty());
}

TEST(ParameterReading, RefusesWrongTypes) {
  XmlRpcValue tree;
  tree["tf_timeout"] = "soon";
  tree["target_frame"][0] = "map";
  tree["always_on"]["x"] = true;
  tree["max_points"] = 2.5;
  EXPECT_THAT(read(tree).errors,
              UnorderedElementsAre(
                  "parameter /detector/tf_timeout: tf_timeout = soon: expected a number in 0 to 60 [s]",
                  "parameter /detector/target_frame: target_frame = a list: expected text",
                  "parameter /detector/always_on: always_on = a map: expected true or false",
                  "parameter /detector/max_points: max_points = 2.5: expected a whole number in 1 to 100000000"));
  EXPECT_EQ(read(tree).configuration.node.target_frame, "");
}

TEST(ParameterReading, RefusesValuesOutOfRange) {
  XmlRpcValue tree;
  tree["tf_timeout"] = 61;
  tree["keypoints"]["grid_size"] = 0.0;
  tree["detection"]["threshold"] = 0.75;
  EXPECT_THAT(read(tree).errors,
              UnorderedElementsAre("parameter /detector/tf_timeout: tf_timeout = 61 is out of range: 0 to 60 [s]",
                                   "parameter /detector/keypoints/grid_size: keypoints.grid_size = 0 is out of range: "
                                   "0.001 to 0.5 [m]; all settings of the detector stay at their defaults"));
  EXPECT_EQ(read(tree).configuration.detector.detection.threshold, 0.5);
}

TEST(ParameterReading, WarnsAboutUnknownNames) {
  XmlRpcValue tree;
  tree["target_farme"] = "map";
  tree["descriptor"]["grid_size"] = 0.03;
  EXPECT_THAT(
      read(tree).warnings,
      UnorderedElementsAre(
          "unknown parameter /detector/target_farme is ignored: did you mean /detector/target_frame?",
          "unknown parameter /detector/descriptor/grid_size is ignored: did you mean /detector/keypoints/grid_size?"));
}

TEST(ParameterReading, UnderstandsOldNames) {
  XmlRpcValue tree;
  tree["verification"]["candidates"] = 0;
  tree["verification"]["ambiguity"] = 1.5;
  tree["verification"]["skip_planes"] = false;
  const ParameterReading reading = read(tree);
  EXPECT_THAT(reading.errors, IsEmpty());
  EXPECT_THAT(reading.given,
              UnorderedElementsAre("detection.hypotheses", "matching.ambiguity", "keypoints.skip_planes"));
  EXPECT_THAT(reading.warnings,
              UnorderedElementsAre("parameter /detector/verification/candidates: 'verification.candidates = 0' is now "
                                   "called 'detection.hypotheses = hough'; the old name still works",
                                   "parameter /detector/verification/ambiguity: " + ambiguity_moved,
                                   "parameter /detector/verification/skip_planes: 'verification.skip_planes' is now "
                                   "called 'keypoints.skip_planes'; the old name still works"));
  const sks::Settings& detector = reading.configuration.detector;
  EXPECT_EQ(detector.detection.hypotheses, sks::Hypotheses::hough);
  EXPECT_EQ(detector.verification.candidates, sks::Settings().verification.candidates);
  EXPECT_EQ(detector.matching.ambiguity, 1.5);
  EXPECT_FALSE(detector.keypoints.skip_planes);
}

TEST(ParameterReading, RefusesOldAndNewNameThatDiffer) {
  XmlRpcValue tree;
  tree["verification"]["ambiguity"] = 1.5;
  tree["matching"]["ambiguity"] = 1.25;
  EXPECT_THAT(read(tree).errors,
              ElementsAre("parameter /detector/verification/ambiguity: 'matching.ambiguity' is set twice, also as "
                          "'verification.ambiguity'; keep one; all settings of the detector stay at their defaults"));
  tree["matching"]["ambiguity"] = 1.5;  // as the node itself writes it
  const ParameterReading same = read(tree);
  EXPECT_THAT(same.errors, IsEmpty());
  EXPECT_THAT(same.warnings, ElementsAre("parameter /detector/verification/ambiguity: " + ambiguity_moved));
  EXPECT_THAT(same.given, ElementsAre("matching.ambiguity"));
  EXPECT_EQ(same.configuration.detector.matching.ambiguity, 1.5);
}

TEST(ParameterReading, DynamicReconfigureUnderstandsOldNames) {
  dynamic_reconfigure::Config message;
  message.ints.resize(1);
  message.ints[0].name = "verification.candidates";
  message.ints[0].value = 0;
  std::vector<std::string> warnings;
  EXPECT_EQ(overlaid({}, message, warnings).detector.detection.hypotheses, sks::Hypotheses::hough);
  EXPECT_THAT(warnings, ElementsAre("'verification.candidates = 0' is now called 'detection.hypotheses = hough'; the "
                                    "old name still works"));
}

}  // namespace
}  // namespace sks_detector
