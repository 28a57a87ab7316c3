// SPDX-License-Identifier: BSD-3-Clause
// The display in rviz's own surroundings; needs a screen. What it draws is looked at in test/ros/rviz_display_test.py.
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rviz/display.h>
#include <rviz/properties/property.h>
#include <rviz/properties/property_tree_model.h>
#include <rviz/properties/status_list.h>
#include <rviz/properties/status_property.h>
#include <rviz/render_panel.h>
#include <rviz/selection/selection_manager.h>
#include <rviz/visualization_manager.h>
#include <sks_detector/DetectionArray.h>
#include <sks_detector/ObjectModels.h>
#include <sks_detector/Status.h>
#include <QtTest/QTest>

#include "ros/cloud_message.hpp"

namespace sks_detector {
namespace {

using ::testing::HasSubstr;

constexpr int display_patience = 20000;             // [ms]
constexpr int view_width = 400, view_height = 300;  // [px]

Detection detectionOf(const std::string& object, float score, double size = 3) {
  Detection detection;
  detection.object = object;
  detection.score = score;
  detection.pose.pose.orientation.w = detection.box_center.orientation.w = 1;
  detection.box_size.x = detection.box_size.y = detection.box_size.z = size;
  return detection;
}

class DetectionsDisplayTest : public ::testing::Test {
protected:
  static void SetUpTestSuite() {  // a process can have one
    panel_ = std::make_unique<rviz::RenderPanel>();
    manager_ = std::make_unique<rviz::VisualizationManager>(panel_.get());
    panel_->resize(view_width, view_height);
    panel_->initialize(manager_->getSceneManager(), manager_.get());
    manager_->initialize();
    manager_->setFixedFrame("map");
    panel_->show();
    manager_->startUpdate();
  }
  static void TearDownTestSuite() {
    manager_.reset();
    panel_.reset();
  }

  void SetUp() override {
    display_.reset(manager_->createDisplay("sks_detector/Detections", "Detections", true));
    ASSERT_EQ(display_->subProp("Topic")->getValue().toString().toStdString(), "/detector/detections");
    ASSERT_TRUE(until([&] { return publisher_.getNumSubscribers() > 0; }));
  }

  template <typename Condition>
  static bool until(Condition condition) {
    return QTest::qWaitFor([&] { return bool(condition()); }, display_patience);
  }

  void publish(const std::vector<Detection>& detections, const std::string& frame = "map") {
    DetectionArray array;
    array.header.frame_id = frame;
    array.header.stamp = ros::Time::now();
    array.detections = detections;
    publisher_.publish(array);
  }

  const rviz::StatusProperty* status(const QString& name) {
    for (int i = 0; i < display_->numChildren(); ++i) {
      const auto* list = qobject_cast<rviz::StatusList*>(display_->childAt(i));
      for (int j = 0; list && j < list->numChildren(); ++j) {
        if (list->childAt(j)->getName() == name) return qobject_cast<rviz::StatusProperty*>(list->childAt(j));
      }
    }
    return nullptr;
  }
  std::string statusText(const QString& name) {
    return status(name) ? status(name)->getValue().toString().toStdString() : "";
  }
  bool untilStatus(const QString& name, const std::string& part) {
    return until([&] { return statusText(name).find(part) != std::string::npos; });
  }
  /// Names of the objects that are drawn, as selecting everything finds them.
  std::vector<std::string> selected() {
    manager_->getSelectionManager()->select(panel_->getViewport(), 0, 0, view_width, view_height,
                                            rviz::SelectionManager::Replace);
    rviz::Property* root = manager_->getSelectionManager()->getPropertyModel()->getRoot();
    std::vector<std::string> objects;
    for (int i = 0; i < root->numChildren(); ++i) {
      objects.push_back(root->childAt(i)->getValue().toString().toStdString());
    }
    return objects;
  }

  ros::NodeHandle handle_;
  ros::Publisher publisher_ = handle_.advertise<DetectionArray>("/detector/detections", 10);
  std::unique_ptr<rviz::Display> display_;
  static std::unique_ptr<rviz::RenderPanel> panel_;
  static std::unique_ptr<rviz::VisualizationManager> manager_;
};

std::unique_ptr<rviz::RenderPanel> DetectionsDisplayTest::panel_;
std::unique_ptr<rviz::VisualizationManager> DetectionsDisplayTest::manager_;

TEST_F(DetectionsDisplayTest, TellsWhatIsShownAndWhatIsNot) {
  display_->subProp("Threshold")->setValue(0.5);
  display_->subProp("Most Shown")->setValue(2);
  publish({detectionOf("a", 0.9F), detectionOf("b", 0.8F), detectionOf("c", 0.7F), detectionOf("d", 0.4F)});
  EXPECT_TRUE(untilStatus("Detections", "2 of 4 shown; 1 below the threshold; 1 more than \"Most Shown\""))
      << statusText("Detections");
  EXPECT_EQ(status("Detections")->getLevel(), rviz::StatusProperty::Warn);
  display_->subProp("Threshold")->setValue(0.85);
  EXPECT_TRUE(untilStatus("Detections", "1 of 4 shown; 3 below the threshold")) << statusText("Detections");
  EXPECT_EQ(status("Detections")->getLevel(), rviz::StatusProperty::Ok);
  EXPECT_THAT(selected(), ::testing::ElementsAre("a"));
}

TEST_F(DetectionsDisplayTest, TellsOfPosesThatAreNone) {
  Detection nan = detectionOf("mug", 0.9F), stretched = detectionOf("cup", 0.9F);
  nan.box_center.position.y = std::numeric_limits<double>::quiet_NaN();
  stretched.box_center.orientation.w = 2;
  publish({nan, stretched});
  EXPECT_TRUE(untilStatus("Detections", "1 of 2 shown; 1 cannot be drawn; 1 with quaternions"))
      << statusText("Detections");
  EXPECT_THAT(statusText("Detections"), HasSubstr("detection 0 ('mug')"));
  EXPECT_THAT(statusText("Detections"), HasSubstr("not finite"));
  EXPECT_THAT(selected(), ::testing::ElementsAre("cup"));
}

TEST_F(DetectionsDisplayTest, TellsThatATransformIsMissing) {
  publish({detectionOf("mug", 0.9F)}, "nowhere");
  EXPECT_TRUE(
      until([&] { return status("Transform") && status("Transform")->getLevel() == rviz::StatusProperty::Error; }));
  EXPECT_THAT(statusText("Transform"), HasSubstr("nowhere"));
  publish({detectionOf("mug", 0.9F)});
  EXPECT_TRUE(until([&] { return statusText("Transform") == "OK"; }));
}

TEST_F(DetectionsDisplayTest, ASelectedBoxShowsItsFieldsAndFollows) {
  Detection mug = detectionOf("mug", 0.75F);
  mug.votes = 42;
  mug.view = "mug/003.pcd";
  publish({mug});
  ASSERT_TRUE(untilStatus("Detections", "1 of 1 shown"));
  ASSERT_THAT(selected(), ::testing::ElementsAre("mug"));
  rviz::Property* group = manager_->getSelectionManager()->getPropertyModel()->getRoot()->childAt(0);
  EXPECT_NEAR(group->subProp("score")->getValue().toDouble(), 0.75, 1e-6);
  EXPECT_EQ(group->subProp("votes")->getValue().toInt(), 42);
  EXPECT_EQ(group->subProp("view")->getValue().toString().toStdString(), "mug/003.pcd");
  EXPECT_EQ(group->subProp("box_size")->subProp("X")->getValue().toDouble(), 3);
  mug.votes = 43;
  publish({detectionOf("cup", 0.9F, 0.1), mug});
  EXPECT_TRUE(until([&] { return group->subProp("votes")->getValue().toInt() == 43; }));
  publish({});
  EXPECT_TRUE(
      until([&] { return manager_->getSelectionManager()->getPropertyModel()->getRoot()->numChildren() == 0; }));
}

TEST_F(DetectionsDisplayTest, ResetAndDisablingTakeBoxesAway) {
  publish({detectionOf("mug", 0.9F)});
  ASSERT_TRUE(untilStatus("Detections", "1 of 1 shown"));
  ASSERT_EQ(selected().size(), 1U);
  display_->reset();
  EXPECT_EQ(selected().size(), 0U);
  publish({detectionOf("mug", 0.9F)});
  ASSERT_TRUE(untilStatus("Detections", "1 of 1 shown"));
  display_->setEnabled(false);
  EXPECT_EQ(selected().size(), 0U);
  EXPECT_TRUE(until([&] { return publisher_.getNumSubscribers() == 0; }));
  display_->setEnabled(true);
  EXPECT_TRUE(until([&] {
    publish({detectionOf("mug", 0.9F)});
    QTest::qWait(100);
    return selected().size() == 1;
  }));
}

TEST_F(DetectionsDisplayTest, BoxesGoWhereNothingMoreComes) {
  display_->subProp("Timeout")->setValue(0.5);
  publish({detectionOf("mug", 0.9F)});
  EXPECT_TRUE(untilStatus("Detections", "None came for 0.5 s")) << statusText("Detections");
  EXPECT_EQ(selected().size(), 0U);
}

/// The model of an object in the frame "view" of its model: a thick line beside the origin.
ObjectModel modelOf(const std::string& object) {
  sks::Cloud cloud;
  for (float x = -1; x <= 1; x += 0.1F) cloud.points.emplace_back(x, -2, 0.5F * x);
  ObjectModel model;
  model.object = object;
  model.view = "view";
  model.spacing = 0.3F;
  model.points = toMessage(cloud, std_msgs::Header());
  return model;
}

TEST_F(DetectionsDisplayTest, ModelsAreListenedToWhereTheyAreWanted) {
  ros::Publisher publisher = handle_.advertise<ObjectModels>("/detector/models", 1, true);
  ObjectModels models;
  models.codebook = "toys (1234)";
  models.models = {modelOf("cup"), modelOf("empty")};
  models.models[1].points.width = 0;
  publisher.publish(models);
  Detection cup = detectionOf("cup", 0.9F), mug = detectionOf("mug", 0.8F);
  cup.view = mug.view = "view";
  mug.box_center.position.y = -5;  // beside the cup
  publish({cup, mug});
  ASSERT_TRUE(untilStatus("Detections", "2 of 2 shown"));
  EXPECT_EQ(publisher.getNumSubscribers(), 0U);
  EXPECT_EQ(status("Models"), nullptr);
  display_->subProp("Shape")->setValue("Model");
  EXPECT_TRUE(untilStatus("Models", "1 of toys (1234); none of 'mug' in the frame 'view': its box is drawn"))
      << statusText("Models");
  EXPECT_THAT(statusText("Models"), HasSubstr("the model of 'empty' is not used"));
  EXPECT_THAT(selected(), ::testing::Contains("cup")) << "by its box, which is not seen";
  models.models = {modelOf("cup"), modelOf("mug")};
  publisher.publish(models);
  EXPECT_TRUE(until([&] { return statusText("Models") == "2 of toys (1234)"; })) << statusText("Models");
  EXPECT_EQ(status("Models")->getLevel(), rviz::StatusProperty::Ok);
  display_->subProp("Shape")->setValue("Box");
  EXPECT_TRUE(until([&] { return publisher.getNumSubscribers() == 0 && status("Models") == nullptr; }));
}

TEST_F(DetectionsDisplayTest, TellsThatThereAreNoModels) {
  display_->subProp("Shape")->setValue("Model");
  EXPECT_TRUE(untilStatus("Models", "nothing came on /detector/models")) << statusText("Models");
  EXPECT_EQ(status("Models")->getLevel(), rviz::StatusProperty::Warn);
  publish({detectionOf("mug", 0.9F)});
  ASSERT_TRUE(untilStatus("Detections", "1 of 1 shown"));
  EXPECT_THAT(selected(), ::testing::ElementsAre("mug"));
}

TEST_F(DetectionsDisplayTest, ColorsFollowTheCodebookOnceItIsKnown) {
  EXPECT_TRUE(untilStatus("Colors", "nothing came on /detector/status")) << statusText("Colors");
  ros::Publisher publisher = handle_.advertise<Status>("/detector/status", 1, true);
  publisher.publish(Status());
  EXPECT_TRUE(untilStatus("Colors", "in the order of the codebook")) << statusText("Colors");
}

}  // namespace
}  // namespace sks_detector
