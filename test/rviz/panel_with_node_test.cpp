// SPDX-License-Identifier: BSD-3-Clause
// The panel and a detector that runs: started by test/ros/rviz_panel_with_node_test.py, which lets things stand before
// the camera.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <ros/param.h>
#include <ros/service.h>
#include <sks_detector/Info.h>
#include <QProgressBar>
#include <QSlider>

#include "rviz/panel_fixture.hpp"

namespace sks_detector {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Names = std::vector<std::string>;

class PanelWithNodeTest : public PanelFixture {
protected:
  /// What the node itself says.
  static InfoResponse nodeInfo() {
    Info info;
    EXPECT_TRUE(ros::service::call("/detector/info", info));
    return info.response;
  }
  static std::string folder(const std::string& parameter) { return ros::param::param<std::string>(parameter, ""); }
  static double thresholdOfNode() { return ros::param::param<double>("/detector/detection/threshold", -1); }
  /// Names of the files of captured views of an object.
  static std::size_t viewFiles(const std::string& object) {
    const std::filesystem::path views =
        std::filesystem::path(folder("/detector/dataset_directory")) / "captured" / object;
    if (!std::filesystem::exists(views)) return 0;
    return std::size_t(std::distance(std::filesystem::directory_iterator(views), {}));
  }
  void use(const char* button, const QString& answered, bool option) {
    click(button);
    answer(answered, option);
  }
};

TEST_F(PanelWithNodeTest, EachButtonDoesWhatItSays) {
  ASSERT_TRUE(untilText("state", "no codebook")) << text("state");
  use("load", "none.sks", false);
  ASSERT_TRUE(untilText("reply", "none.sks")) << text("reply");
  EXPECT_THAT(part<QLabel>("reply")->styleSheet().toStdString(), HasSubstr("color")) << "refused";
  EXPECT_THAT(nodeInfo().objects, IsEmpty());
  use("load", "synthetic.sks", false);
  ASSERT_TRUE(untilText("codebook", "2 objects")) << text("reply");
  EXPECT_THAT(nodeInfo().objects, ElementsAre("thing", "round"));
  EXPECT_EQ(cell(0, 0) + " " + cell(1, 0), "thing round");
  ASSERT_TRUE(untilText("stream", "results/s")) << text("stream");

  auto* slider = part<QSlider>("threshold");
  ASSERT_TRUE(until([&] { return slider->value() == int(std::lround(100 * thresholdOfNode())); }));
  for (int i = 0; i < 5; ++i) QTest::keyClick(slider, Qt::Key_Right);
  ASSERT_TRUE(until([&] { return std::abs(thresholdOfNode() - 0.55) < 1e-6; })) << thresholdOfNode();

  use("save", "saved.sks", false);
  ASSERT_TRUE(untilText("reply", "saved")) << text("reply");
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(folder("/detector/codebook_directory")) / "saved.sks"));
  use("remove", "round", false);
  ASSERT_TRUE(until([&] { return nodeInfo().objects == Names{"thing"}; })) << text("reply");
  ASSERT_TRUE(untilText("codebook", "1 object"));

  part<QLineEdit>("object")->setText("mug");
  for (std::size_t views : {1U, 2U}) {
    click("capture");
    ASSERT_TRUE(until([&] { return viewFiles("mug") == views && part<QPushButton>("capture")->isEnabled(); }))
        << text("reply");
    EXPECT_THAT(cell(1, 0) + ": " + cell(1, 2), HasSubstr("mug: " + std::to_string(views) + " view"));
  }
  click("undo");
  ASSERT_TRUE(until([&] { return viewFiles("mug") == 1 && part<QPushButton>("undo")->isEnabled(); })) << text("reply");
  EXPECT_THAT(nodeInfo().objects, ElementsAre("thing")) << "not trained yet";

  click("train");
  ASSERT_TRUE(until([&] { return nodeInfo().objects == Names{"mug"}; }, 6 * panel_patience)) << text("reply");
  ASSERT_TRUE(until([&] { return cell(0, 0) == "mug" && cell(0, 1) == "1"; })) << cell(0, 0) << " " << cell(0, 1);
  use("remove", "mug", true);
  ASSERT_TRUE(until([&] { return viewFiles("mug") == 0 && nodeInfo().objects.empty(); })) << text("reply");
  use("load", "saved.sks", false);
  ASSERT_TRUE(until([&] { return nodeInfo().objects == Names({"thing", "round"}); })) << text("reply");
}

TEST_F(PanelWithNodeTest, CancelsATraining) {
  ASSERT_TRUE(untilText("codebook", "2 objects")) << text("codebook");
  click("train");
  ASSERT_TRUE(until([&] { return part<QProgressBar>("progress")->value() > 0; })) << text("reply");
  EXPECT_THAT(part<QProgressBar>("progress")->text().toStdString(), HasSubstr("of 3000"));
  EXPECT_EQ(text("state"), "training");
  EXPECT_FALSE(part<QPushButton>("train")->isEnabled());
  click("cancel");
  ASSERT_TRUE(untilText("reply", "cancelled")) << text("reply");
  ASSERT_TRUE(until([&] { return part<QPushButton>("train")->isEnabled(); }));
  EXPECT_FALSE(part<QPushButton>("cancel")->isEnabled());
  EXPECT_THAT(nodeInfo().objects, ElementsAre("thing", "round")) << "the old codebook stays";
}

}  // namespace
}  // namespace sks_detector
