// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sks_detector/cloud_io.hpp>

#include "made_up_bag.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using nlohmann::json;
using test::at;
using test::CommandRun;
using test::detection;
using test::detections;
using ::testing::HasSubstr;

/// Three clouds with ground truth, of which the last was not answered: a mug and a duck stand in the first, a mug in
/// the second, a mug in the third.
class BagEvaluate : public ::testing::Test {
protected:
  void SetUp() override {
    write([](rosbag::Bag& bag) {
      writeTruth(bag);
      bag.write("/found", at(0.1),
                detections(0, {detection("mug", 0.01, 0.9), detection("mug", 0.4, 0.8), detection("duck", 0.2, 0.3)}));
      bag.write("/found", at(1.1), detections(1, {detection("mug", 0.02, 0.7)}));
    });
  }

  static void writeTruth(rosbag::Bag& bag) {
    for (const double second : {0.0, 1.0, 2.0}) bag.write("/points", at(second), test::wallMessage(second));
    bag.write("/ground_truth", at(0), detections(0, {detection("mug", 0, 1), detection("duck", 0.2, 0.8)}));
    bag.write("/ground_truth", at(1), detections(1, {detection("mug", 0, 0), detection("bowl", 0.5, 0.01)}));
    bag.write("/ground_truth", at(2), detections(2, {detection("mug", 0, 1)}));
  }
  template <typename Write>
  void write(Write fill) const {
    rosbag::Bag bag(folder_.path("test.bag"), rosbag::bagmode::Write);
    fill(bag);
  }
  CommandRun evaluate(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"bag", "evaluate", folder_.path("test.bag")});
    return test::runSks(more);
  }
  json result(std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const CommandRun run = evaluate(more);
    EXPECT_EQ(run.status, 0) << run.errors;
    return json::parse(run.output);
  }
  std::string refusal(const std::vector<std::string>& more = {}) const {
    const CommandRun run = evaluate(more);
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.output, "");
    return run.errors;
  }
  void writeDataSet(const std::vector<std::string>& names) const {
    std::string text = "name: toys\nunits: m\nmax_distance: 0.05\nscenes:\n";
    writeCloud(folder_.path("wall.pcd"), test::wall());
    for (const std::string& name : names) {
      text += "  - name: \"" + name + "\"\n    cloud: wall.pcd\n    objects: [{object: mug, position: [0, 0, 0]}]\n";
    }
    test::writeFile(folder_.path("toys.yaml"), text);
  }

  test::TemporaryFolder folder_;
};

TEST_F(BagEvaluate, ScoresLikeEvaluate) {
  const json all = result();
  EXPECT_EQ(all["dataset"], "test.bag");
  EXPECT_EQ(all["method"], "/found");
  EXPECT_EQ(all["scenes"], 2);
  EXPECT_EQ(all["unanswered"], 1);
  EXPECT_EQ(all["ground_truth"], 3);
  EXPECT_EQ(all["true_positives"], 2);
  EXPECT_EQ(all["false_positives"], 1);
  EXPECT_NEAR(all["precision"], 2.0 / 3, 1e-9);
  EXPECT_NEAR(all["recall"], 2.0 / 3, 1e-9);
  EXPECT_NEAR(all["f1"], 2.0 / 3, 1e-9);
  EXPECT_NEAR(all["pose"]["translation_error_m"]["median"], 0.015, 1e-6);
  EXPECT_NEAR(all["time_ms"]["total"]["mean"], 250, 1e-6);
  EXPECT_EQ(all["per_object"]["duck"]["recall"], 0);
  EXPECT_FALSE(all["per_object"].contains("bowl")) << "hidden objects are not asked for";
  EXPECT_EQ(all["per_scene"][0]["name"], "1600000000.000000000");
  EXPECT_EQ(all["per_scene"][0]["ground_truth"][1]["visibility"], 0.8f);
  EXPECT_EQ(all["per_scene"][1]["ground_truth"][0]["visibility"], nullptr) << "0: not known";
  EXPECT_EQ(all["per_scene"][0]["detections"][0]["true_positive"], true);

  EXPECT_EQ(result({"--threshold", "0.2"})["true_positives"], 3);
  EXPECT_EQ(result({"--max-distance", "0.015"})["true_positives"], 1);
  EXPECT_NEAR(result({"--count-unanswered"})["recall"], 2.0 / 4, 1e-9);
}

TEST_F(BagEvaluate, SaysWhatIsOdd) {
  const CommandRun run = evaluate();
  EXPECT_THAT(run.output, HasSubstr("test.bag, /found: 2 scenes, threshold 0.500, within 50 mm"));
  EXPECT_THAT(run.errors, HasSubstr("1 clouds with ground truth have no detections"));
  EXPECT_THAT(run.errors, HasSubstr("object 'bowl' of the ground truth is never detected: was it trained?"));
  write([](rosbag::Bag& bag) {
    writeTruth(bag);
    for (int i = 0; i < 2; ++i) bag.write("/found", at(i), detections(0, {detection("hat", 0, 0.9)}));
  });
  EXPECT_THAT(evaluate().errors, HasSubstr("object 'hat' is detected but is nowhere in the ground truth"));
  EXPECT_THAT(evaluate().errors, HasSubstr("1 arrays of /found repeat a stamp"));
}

TEST_F(BagEvaluate, TakesTheTruthFromADataSet) {
  writeDataSet({"1600000001.000000000"});
  const json by_stamp = result({"--dataset", folder_.path("toys.yaml")});
  EXPECT_EQ(by_stamp["dataset"], "toys");
  EXPECT_EQ(by_stamp["scenes"], 1);
  EXPECT_EQ(by_stamp["true_positives"], 1);
  EXPECT_EQ(by_stamp["pose"]["count"], 0);
  writeDataSet({"a", "b", "c"});
  const json by_order = result({"--dataset", folder_.path("toys.yaml")});
  EXPECT_EQ(by_order["scenes"], 2);
  EXPECT_EQ(by_order["true_positives"], 2);
  EXPECT_EQ(by_order["false_positives"], 1);
  writeDataSet({"a", "b"});
  EXPECT_THAT(refusal({"--dataset", folder_.path("toys.yaml")}),
              HasSubstr("has 2 scenes, the bag 3 stamps: call each scene by the stamp of its cloud"));
}

TEST_F(BagEvaluate, KnowsSymmetriesFromADataSet) {
  write([](rosbag::Bag& bag) {
    writeTruth(bag);
    sks_detector::Detection turned = detection("mug", 0, 0.9);
    turned.view = "elsewhere/mug.obj";
    turned.pose.pose.orientation.z = 1;  // half a turn
    turned.pose.pose.orientation.w = 0;
    bag.write("/found", at(0.1), detections(0, {turned}));
  });
  EXPECT_NEAR(result()["pose"]["rotation_error_deg"]["median"], 180, 1e-6);
  writeCloud(folder_.path("mug.obj"), test::wall());
  test::writeFile(folder_.path("models.yaml"),
                  "name: models\nunits: m\ntraining:\n  - {object: mug, cloud: mug.obj, kind: mesh, symmetry: {axis: "
                  "[0, 0, 1], order: 2}}\n");
  EXPECT_NEAR(result({"--symmetries", folder_.path("models.yaml")})["pose"]["rotation_error_deg"]["median"], 0, 1e-6);
}

TEST_F(BagEvaluate, DrawsTheScenes) {
  const CommandRun run = evaluate({"--plot", folder_.path("plots")});
  ASSERT_EQ(run.status, 0) << run.errors;
  for (const char* name : {"precision_recall.png", "times.png", "scenes/1600000000.000000000.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_.path(std::string("plots/") + name))) << name;
  }
}

TEST_F(BagEvaluate, RefusesWithTheReason) {
  EXPECT_THAT(refusal({"--detections", "/none"}), HasSubstr("no topic '/none' of type sks_detector/DetectionArray"));
  EXPECT_THAT(refusal({"--ground-truth", "points"}), HasSubstr("it has /found, /ground_truth"));
  write(writeTruth);
  EXPECT_THAT(refusal(), HasSubstr("has no recorded detections"));
  write([](rosbag::Bag& bag) { bag.write("/found", at(0), detections(0, {})); });
  EXPECT_THAT(refusal(), HasSubstr("has no topic of ground truth"));
  const auto with = [&](const sks_detector::DetectionArray& found) {
    write([&](rosbag::Bag& bag) {
      writeTruth(bag);
      bag.write("/found", at(0), found);
    });
    return refusal();
  };
  EXPECT_THAT(with(detections(7, {})),
              HasSubstr("none of the 1 arrays of /found has the stamp of one of the 3 clouds"));
  EXPECT_THAT(with(detections(0, {}, "map")), HasSubstr("/found is in frame 'map', /ground_truth in 'camera'"));
  EXPECT_THAT(with(detections(0, {sks_detector::Detection()})),
              HasSubstr("neither its pose nor its box_center is set"));
  EXPECT_THAT(with(detections(0, {detection("mug", NAN, 1)})), HasSubstr("detection of 'mug': a number of its pose"));
  write([](rosbag::Bag& bag) {
    writeTruth(bag);
    for (const char* topic : {"/a", "/b"}) bag.write(topic, at(0), detections(0, {}));
  });
  EXPECT_THAT(refusal(), HasSubstr("several topics that could be meant: /a, /b; choose one with --detections"));
}

}  // namespace
}  // namespace sks

#endif
