// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <gmock/gmock.h>
#include <rviz/config.h>
#include <QElapsedTimer>
#include <QProgressBar>
#include <QSlider>

#include "rviz/panel_fixture.hpp"
#include "rviz/stub_node.hpp"

namespace sks_detector {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int panel_soon = 8000;  // [ms] within which a node that is away has to be said

class PanelTest : public PanelFixture {};

TEST_F(PanelTest, ShowsStateErrorCodebookAndObjects) {
  StubNode node;
  InfoResponse info;
  info.success = true;
  info.codebook = "toys (3f2a90c1)";
  info.codebook_file = "/books/toys.sks";
  info.descriptor = "cshot";
  info.objects = {"cup", "<b>box</b>"};
  info.views = {12, 7};
  node.setInfo(info);
  Status status;
  status.state = Status::FAILING;
  status.objects = info.objects;
  status.captured = {"mug"};
  status.last_error = "the cloud of /points is empty";
  node.publish(status);
  ASSERT_TRUE(untilText("state", "the last cloud could not be used")) << text("state");
  EXPECT_TRUE(untilText("codebook", "toys (3f2a90c1): 2 objects, cshot, /books/toys.sks")) << text("codebook");
  EXPECT_EQ(text("error"), "the cloud of /points is empty");
  EXPECT_TRUE(part<QLabel>("error")->isVisible());
  ASSERT_TRUE(until([&] { return part<QTableWidget>("objects")->rowCount() == 3; }));
  EXPECT_EQ(cell(0, 0) + " " + cell(0, 1), "cup 12");
  EXPECT_EQ(cell(1, 0) + " " + cell(1, 1), "<b>box</b> 7");
  EXPECT_EQ(cell(2, 0) + " " + cell(2, 2), "mug not trained yet");
  status.state = Status::DETECTING;
  status.last_error.clear();
  node.publish(status);
  EXPECT_TRUE(until([&] { return text("state") == "detecting" && !part<QLabel>("error")->isVisible(); }));
}

TEST_F(PanelTest, ShowsRateAndLatency) {
  StubNode node;
  ASSERT_TRUE(untilText("state", "no codebook")) << text("state");
  EXPECT_TRUE(until([&] {
    DetectionArray array;
    array.header.stamp = ros::Time::now() - ros::Duration(2.5);
    array.processing_time = 1.25;
    node.publish(array);
    QTest::qWait(100);
    return text("stream").find("results/s, 2.5 s from camera to result, 1.2 s of processing") != std::string::npos;
  })) << text("stream");
  EXPECT_TRUE(untilText("stream", "no result in the last 5 s"));
}

TEST_F(PanelTest, CapturesAndTakesBack) {
  StubNode node;
  CaptureViewResponse response;
  response.success = true;
  response.message = "view 5 of 'mug': 2000 points; a good view";
  response.views = 5;
  response.coverage = 0.62;
  response.missing = "from above";
  node.setCapture(response);
  click("capture");
  EXPECT_THAT(text("reply"), HasSubstr("name of an object"));
  part<QLineEdit>("object")->setText(" mug ");
  click("capture");
  EXPECT_FALSE(part<QPushButton>("capture")->isEnabled());
  EXPECT_THAT(text("reply"), HasSubstr("Waiting"));
  ASSERT_TRUE(untilText("reply", response.message)) << text("reply");
  EXPECT_TRUE(part<QPushButton>("capture")->isEnabled());
  EXPECT_EQ(cell(0, 0) + ": " + cell(0, 2), "mug: 5 views, 62 %");
  EXPECT_EQ(text("missing"), "Missing: from above");
  click("undo");
  ASSERT_TRUE(untilText("reply", "taken back")) << text("reply");
  EXPECT_EQ(part<QTableWidget>("objects")->rowCount(), 0);
  EXPECT_EQ(text("missing"), "");
  EXPECT_THAT(node.requests(), ElementsAre("capture_view mug", "undo_capture mug"));
}

TEST_F(PanelTest, SaysWhatANodeRefuses) {
  StubNode node;
  CaptureViewResponse response;
  response.message = "2 objects stand on the plane";
  node.setCapture(response);
  part<QLineEdit>("object")->setText("mug");
  click("capture");
  ASSERT_TRUE(untilText("reply", response.message)) << text("reply");
  EXPECT_THAT(part<QLabel>("reply")->styleSheet().toStdString(), HasSubstr("color"));
  EXPECT_EQ(part<QTableWidget>("objects")->rowCount(), 0);
}

TEST_F(PanelTest, TrainsWithProgressAndCancels) {
  StubNode node;
  Status status;
  status.state = Status::READY;
  node.publish(status);
  ASSERT_TRUE(untilText("state", "ready"));
  EXPECT_FALSE(part<QPushButton>("cancel")->isEnabled());
  node.setHanging(true);
  click("train");
  EXPECT_FALSE(part<QPushButton>("train")->isEnabled());
  status.state = Status::TRAINING;
  status.progress = "training 12 of 48: mug/000.pcd";
  status.progress_fraction = 0.25F;
  node.publish(status);
  ASSERT_TRUE(until([&] { return part<QProgressBar>("progress")->value() == 25; }));
  EXPECT_THAT(part<QProgressBar>("progress")->text().toStdString(), HasSubstr("training 12 of 48"));
  EXPECT_EQ(text("state"), "training");
  click("cancel");
  ASSERT_TRUE(untilText("reply", "the training ends")) << text("reply");
  node.setHanging(false);
  ASSERT_TRUE(untilText("reply", "trained")) << text("reply");
  EXPECT_THAT(node.requests(), ElementsAre("train captured", "cancel_training "));
}

TEST_F(PanelTest, LoadsSavesAndRemovesWhatADialogSays) {
  StubNode node;
  click("load");
  answer("toys.sks", false);
  ASSERT_TRUE(untilText("reply", "loaded"));
  click("save");
  answer("other.sks", true);
  ASSERT_TRUE(untilText("reply", "saved"));
  part<QLineEdit>("object")->setText("cup");
  click("remove");
  answer("cup", true);
  ASSERT_TRUE(untilText("reply", "removed"));
  click("remove");
  answer("cup", false, QDialogButtonBox::Cancel);
  click("load");
  answer("  ", false);
  QTest::qWait(500);
  EXPECT_THAT(node.requests(),
              ElementsAre("load_codebook toys.sks", "save_codebook other.sks overwrite", "remove_object cup views"));
}

TEST_F(PanelTest, ThresholdFollowsTheNodeAndIsSet) {
  StubNode node;
  node.publishThreshold(0.5);
  auto* slider = part<QSlider>("threshold");
  ASSERT_TRUE(until([&] { return slider->value() == 50 && slider->isEnabled(); }));
  EXPECT_EQ(text("threshold_value"), "0.50");
  for (int i = 0; i < 5; ++i) QTest::keyClick(slider, Qt::Key_Right);
  ASSERT_TRUE(untilText("reply", "from a score of 0.55")) << text("reply");
  EXPECT_THAT(node.requests(), ElementsAre("set_parameters detection.threshold 55"));
  node.setForcedThreshold(0.3);
  QTest::keyClick(slider, Qt::Key_Right);
  ASSERT_TRUE(untilText("reply", "refused")) << text("reply");
  EXPECT_EQ(slider->value(), 30);
}

TEST_F(PanelTest, SaysThatANodeIsAway) {
  EXPECT_TRUE(untilText("state", "there is no service /detector/info", panel_soon)) << text("state");
  part<QLineEdit>("object")->setText("mug");
  click("capture");
  EXPECT_TRUE(untilText("reply", "there is no service /detector/capture_view", panel_soon)) << text("reply");
  EXPECT_TRUE(part<QPushButton>("capture")->isEnabled());
  {
    const StubNode node;
    EXPECT_TRUE(untilText("state", "no codebook", panel_soon)) << text("state");
  }
  EXPECT_TRUE(untilText("state", "/detector/info", panel_soon)) << text("state");
}

TEST_F(PanelTest, SaysThatANodeHangs) {
  StubNode node;
  ASSERT_TRUE(untilText("state", "no codebook"));
  node.setHanging(true);
  EXPECT_TRUE(untilText("state", "did not answer within 5 s", 2 * panel_soon)) << text("state");
  node.setHanging(false);
  EXPECT_TRUE(untilText("state", "no codebook"));
}

TEST_F(PanelTest, TheWindowGoesOnWhileCallsWait) {
  StubNode node;
  ASSERT_TRUE(untilText("state", "no codebook"));
  node.setHanging(true);
  part<QLineEdit>("object")->setText("mug");
  for (const char* button : {"capture", "undo", "train"}) click(button);
  QElapsedTimer since_tick;
  qint64 longest = 0;
  QTimer ticks;
  QObject::connect(&ticks, &QTimer::timeout, &ticks, [&] { longest = std::max(longest, since_tick.restart()); });
  since_tick.start();
  ticks.start(20);
  ASSERT_TRUE(until([&] { return node.requests().size() == 3; }));
  QTest::qWait(1000);
  EXPECT_LT(longest, 500);
}

TEST_F(PanelTest, CanBeClosedWhileCallsWait) {
  StubNode node;
  node.setHanging(true);
  part<QLineEdit>("object")->setText("mug");
  click("capture");
  click("train");
  ASSERT_TRUE(until([&] { return node.requests().size() == 2; }));
  QElapsedTimer timer;
  timer.start();
  panel_.reset();
  EXPECT_LT(timer.elapsed(), 1500);
  node.setHanging(false);
  QTest::qWait(300);  // the answers find nobody
}

TEST_F(PanelTest, CanBeClosedWithADialogOpen) {
  click("load");
  ASSERT_NE(part<QDialog>("request"), nullptr);
  panel_.reset();
  QTest::qWait(100);
}

TEST_F(PanelTest, TheNodeIsSavedAndCanBeAnother) {
  const StubNode node, other("/other");
  auto* name = part<QLineEdit>("node");
  EXPECT_EQ(name->text(), "/detector");
  name->setText("/other");
  QTest::keyClick(name, Qt::Key_Return);
  part<QLineEdit>("object")->setText("mug");
  click("capture");
  ASSERT_TRUE(untilText("reply", "captured"));
  EXPECT_THAT(other.requests(), ElementsAre("capture_view mug"));
  EXPECT_THAT(node.requests(), IsEmpty());

  rviz::Config config;
  panel_->save(config);
  DetectorPanel second;
  second.load(config);
  EXPECT_EQ(second.findChild<QLineEdit*>("node")->text(), "/other");
}

TEST_F(PanelTest, ANodeThatComesLaterIsHeard) {
  rviz::Config config;
  panel_->save(config);
  for (int run = 1; run < 6; ++run) {
    panel_->load(config);  // while the subscriptions of the constructor, or of the last run, are made or ended
    QTest::qWait(10 * run);
    StubNode node;
    node.publishThreshold(0.1 * run);
    EXPECT_TRUE(untilText("threshold_value", std::to_string(0.1 * run).substr(0, 4))) << run;
  }
}

TEST_F(PanelTest, SaysThatANameIsNone) {
  auto* name = part<QLineEdit>("node");
  name->setText("no good name!");
  QTest::keyClick(name, Qt::Key_Return);
  EXPECT_THAT(text("state"), HasSubstr("no good name!"));
  EXPECT_FALSE(part<QPushButton>("capture")->isEnabled());
  name->setText("");
  QTest::keyClick(name, Qt::Key_Return);
  EXPECT_THAT(text("state"), HasSubstr("e.g. /detector"));
}

}  // namespace
}  // namespace sks_detector
