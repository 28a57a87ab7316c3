// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sks_detector/cloud_io.hpp>

#include "bumps.hpp"
#include "io/file.hpp"
#include "recorded_data.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using nlohmann::json;
using test::bumps;
using test::CommandRun;
using test::runSks;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Eigen::Vector3f boxCenter(const Cloud& cloud) {
  Eigen::Vector3f low = cloud.points.front(), high = low;
  for (const Eigen::Vector3f& point : cloud.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return 0.5f * (low + high);
}

std::string listed(const Eigen::Vector3f& v) {
  return "[" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " + std::to_string(v.z()) + "]";
}

/// A trained surface, and a scene with a moved copy of it and the claim that an object is there that was never trained.
class EvaluateCommand : public ::testing::Test {
protected:
  void SetUp() override {
    Cloud cloud = bumps();
    writeCloud(folder_.path("bumps.pcd"), cloud);
    const Eigen::Vector3f shift(0.1f, -0.05f, 0.2f);
    const Eigen::Vector3f position = boxCenter(cloud) + shift;
    for (Eigen::Vector3f& point : cloud.points) point += shift;
    writeCloud(folder_.path("scene.pcd"), cloud);
    scene_ =
        "scenes:\n"
        "  - name: only\n"
        "    cloud: scene.pcd\n"
        "    objects:\n"
        "      - object: bumps\n"
        "        position: " +
        listed(position) +
        "\n"
        "        reference: bumps.pcd\n"
        "        pose: [1, 0, 0, 0.1, 0, 1, 0, -0.05, 0, 0, 1, 0.2, 0, 0, 0, 1]\n"
        "      - {object: ghost, position: [0, 0, 3]}\n";
    writeDataSet(head_ + training_ + scene_);
  }

  void writeDataSet(const std::string& text) { writeFileAtomically(dataSet(), text); }
  std::string dataSet() const { return folder_.path("toys.yaml"); }

  /// Runs `sks evaluate` on the data set, at a threshold that every hypothesis passes.
  CommandRun evaluate(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.begin(), {"evaluate", "--dataset", dataSet(), "--set", "detection.threshold=0"});
    return runSks(arguments);
  }
  json evaluated(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.end(), {"--json", "-"});
    const CommandRun run = evaluate(arguments);
    EXPECT_EQ(run.status, 0) << run.errors;
    return json::parse(run.output);  // throws if there is anything else on stdout
  }

  const std::string head_ = "name: toys\nunits: m\nmax_distance: 0.05\n";
  const std::string training_ = "training:\n  - {object: bumps, cloud: bumps.pcd, kind: view}\n";
  std::string scene_;
  test::TemporaryFolder folder_;
};

std::set<std::string> keysOf(const json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.items()) keys.insert(item.key());
  return keys;
}

json withoutTimes(json value) {
  if (value.is_object()) {
    value.erase("time_ms");
    value.erase("peak_memory_mb");
  }
  for (json& item : value) {
    if (item.is_structured()) item = withoutTimes(item);
  }
  return value;
}

/// What differs between two results apart from their times.
json difference(const json& a, const json& b) {
  return json::diff(withoutTimes(a), withoutTimes(b));
}

TEST_F(EvaluateCommand, FindsWhatWasTrainedAndCountsWhatWasNot) {
  const CommandRun run = evaluate({"--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("warning: object 'ghost' of the ground truth was never trained"));
  const json result = json::parse(run.output);
  EXPECT_EQ(result["dataset"], "toys");
  EXPECT_EQ(result["method"], "sks");
  EXPECT_EQ(result["scenes"], 1);
  EXPECT_EQ(result["threshold"], 0.0);
  EXPECT_EQ(result["ground_truth"], 2);
  EXPECT_EQ(result["true_positives"], 1);
  EXPECT_EQ(result["recall"], 0.5);
  EXPECT_EQ(result["average_precision"], 0.5);
  EXPECT_EQ(result["pose"]["count"], 1);
  EXPECT_LT(result["pose"]["translation_error_m"]["median"], 0.002);
  EXPECT_LT(result["pose"]["rotation_error_deg"]["p90"], 1.0);
  EXPECT_LT(result["pose"]["t_diff"]["median"], 0.05);
  EXPECT_EQ(result["per_object"]["bumps"]["recall"], 1.0);
  EXPECT_EQ(result["per_object"]["bumps"]["color"], "#f07800");
  EXPECT_EQ(result["per_object"]["ghost"]["ground_truth"], 1);
  EXPECT_EQ(result["per_object"]["ghost"]["f1"], 0.0);
  EXPECT_TRUE(result["per_object"]["ghost"]["precision"].is_null());
  EXPECT_EQ(result["threshold_sweep"].size(), 21u);
}

TEST_F(EvaluateCommand, WithoutMeshesThereAreNoBopErrors) {
  const json result = evaluated();
  EXPECT_EQ(result["bop"]["targets"], 2);
  for (const char* error : {"vsd", "mssd", "mspd", "ar"}) {
    EXPECT_TRUE(result["bop"].contains(error));
    EXPECT_TRUE(result["bop"][error].is_null()) << error;
    EXPECT_TRUE(result["per_object"]["bumps"]["bop"][error].is_null()) << error;
  }
  const std::string reason = "no mesh or full model is under 'training' in the data set";
  EXPECT_EQ(result["bop"]["not_available"], (json{{"bumps", reason}, {"ghost", reason}}));
  EXPECT_THAT(evaluate().output, HasSubstr("BOP errors not available for bumps, ghost: " + reason));
}

TEST_F(EvaluateCommand, GivesEverySceneAndTheTimesOfTheStages) {
  const json result = evaluated();
  const std::set<std::string> stages{"total",       "sanitize", "normals", "keypoints",
                                     "descriptors", "matching", "voting",  "verification"};
  EXPECT_EQ(keysOf(result["time_ms"]), stages);
  EXPECT_EQ(keysOf(result["time_ms"]["total"]), (std::set<std::string>{"mean", "p50", "p95"}));
  EXPECT_GT(result["time_ms"]["total"]["mean"], 0);
  EXPECT_GT(result["peak_memory_mb"], 1);
  ASSERT_EQ(result["per_scene"].size(), 1u);
  const json& scene = result["per_scene"][0];
  EXPECT_EQ(scene["name"], "only");
  EXPECT_EQ(scene["ground_truth"][0]["detected"], true);
  EXPECT_EQ(scene["ground_truth"][1]["detected"], false);
  const json& best = scene["detections"][0];
  EXPECT_EQ(best["object"], "bumps");
  EXPECT_EQ(best["true_positive"], true);
  ASSERT_EQ(best["position"].size(), 3u);
  EXPECT_NEAR(best["position"][0], scene["ground_truth"][0]["position"][0], 0.002);
  ASSERT_EQ(best["pose"].size(), 16u);
  EXPECT_NEAR(best["pose"][0], 1, 0.001);
}

TEST_F(EvaluateCommand, TheSameForAnyNumberOfThreads) {
  EXPECT_THAT(difference(evaluated({"--set", "threads=1"}), evaluated({"--set", "threads=2"})), IsEmpty());
}

TEST_F(EvaluateCommand, GridKeepsEveryKeypoint) {
  const json half =
      evaluated({"--set", "keypoints.discard=0.5", "--set", "keypoints.skip_planes=false"})["per_scene"][0]["counts"];
  const std::size_t grid_keypoints = half["grid_keypoints"];
  EXPECT_EQ(half["keypoints"], grid_keypoints - grid_keypoints / 2);
  const json all = evaluated({"--method", "grid", "--set", "keypoints.discard=0.5"});
  EXPECT_EQ(all["method"], "grid");
  EXPECT_EQ(all["per_scene"][0]["counts"]["keypoints"], grid_keypoints);
  EXPECT_EQ(all["settings"]["keypoints.discard"], 0.0);
}

TEST_F(EvaluateCommand, PaperStartsFromItsPreset) {
  const json result = evaluated({"--method", "sks-paper", "--set", "keypoints.discard=0.25"});
  EXPECT_EQ(result["method"], "sks-paper");
  EXPECT_EQ(result["settings"]["keypoints.discard"], 0.25);
  EXPECT_EQ(result["true_positives"], 1);
}

TEST_F(EvaluateCommand, ComparesWithOtherMethods) {
  const json result = evaluated({"--method", "tombari", "--set", "tombari.bin_size=0.04"});
  EXPECT_EQ(result["method"], "tombari");
  EXPECT_EQ(result["true_positives"], 1);
  EXPECT_EQ(result["settings"]["tombari.bin_size"], 0.04);
  EXPECT_EQ(result["settings"]["keypoints.discard"], 0.0);  // of its preset
  EXPECT_FALSE(result["settings"].contains("chen.resolution"));
  const json selected = evaluated({"--method", "chen", "--set", "keypoints.discard=0.25"});
  const json counts = selected["per_scene"][0]["counts"];
  const int all = counts["grid_keypoints"];
  EXPECT_EQ(counts["keypoints"], all - all / 4);
}

TEST_F(EvaluateCommand, RefusesMethodsAndSettingsThatDoNotFit) {
  for (const char* name : {"knopp", "seib"}) {
    const CommandRun run = evaluate({"--method", name});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.errors, HasSubstr("it says what an isolated object is, but has no pose: use sks classify"));
  }
  const CommandRun other = evaluate({"--method", "tombari", "--set", "chen.resolution=0.02"});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.errors, HasSubstr("setting 'chen.resolution' has no effect on --method tombari"));
  const CommandRun misspelt = evaluate({"--method", "tombari", "--set", "tombari.binsize=0.02"});
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_THAT(misspelt.errors, HasSubstr("did you mean 'tombari.bin_size'?"));
}

TEST_F(EvaluateCommand, PrintsTables) {
  const CommandRun run = evaluate();
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, AllOf(HasSubstr("toys, sks: 1 scenes"), HasSubstr("ghost"), HasSubstr("all")));
  EXPECT_THAT(run.output, AllOf(HasSubstr("highest F1"), HasSubstr("descriptors"), HasSubstr("peak memory")));
}

TEST_F(EvaluateCommand, WritesJsonToAFileBesidesTheTables) {
  const CommandRun run = evaluate({"--json", folder_.path("out.json")});
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("highest F1"));
  EXPECT_EQ(json::parse(readTextFile(folder_.path("out.json")))["ground_truth"], 2);
}

TEST_F(EvaluateCommand, ACodebookThatWasKeptGivesTheSame) {
  const std::string codebook = folder_.path("toys.sks");
  const json trained = evaluated({"--save-codebook", codebook});
  EXPECT_THAT(difference(evaluated({"--codebook", codebook}), trained), IsEmpty());
  writeDataSet(head_ + scene_);  // needs no training clouds then
  EXPECT_THAT(difference(evaluated({"--codebook", codebook}), trained), IsEmpty());
}

TEST_F(EvaluateCommand, WhatIsNotThereIsNull) {
  writeDataSet(head_ + training_ + "scenes:\n  - {name: empty, cloud: scene.pcd, objects: []}\n");
  const json result = evaluated({"--set", "detection.threshold=1"});
  EXPECT_EQ(result["ground_truth"], 0);
  for (const std::string key : {"precision", "recall", "f1", "average_precision", "best"}) {
    EXPECT_TRUE(result[key].is_null()) << key;
  }
  EXPECT_TRUE(result["pose"]["t_diff"]["median"].is_null());
}

TEST_F(EvaluateCommand, ThresholdsOfSingleObjectsReplaceTheGeneralOne) {
  const json all = evaluated(), none = evaluated({"--set", "detection.threshold=1"});
  const json own = evaluated({"--set", "detection.threshold=1", "--set", "detection.thresholds=bumps=0"});
  EXPECT_GT(all["true_positives"].get<int>(), none["true_positives"].get<int>());
  for (const std::string key : {"true_positives", "false_positives", "average_precision"}) {
    EXPECT_EQ(own["per_object"]["bumps"][key], all["per_object"]["bumps"][key]) << key;
  }
  EXPECT_EQ(own["thresholds"], json({{"bumps", 0.0}}));
}

TEST_F(EvaluateCommand, DrawsPlotsAndAPictureOfEachScene) {
  const std::string plots = folder_.path("plots");
  const CommandRun run = evaluate({"--plot", plots});
  if (run.status == 1 && run.errors.find("python3-matplotlib") != std::string::npos) {
    GTEST_SKIP() << "python3-matplotlib is not installed";
  }
  ASSERT_EQ(run.status, 0) << run.errors;
  for (const std::string name : {"precision_recall.png", "threshold_sweep.png", "times.png", "scenes/only.png"}) {
    EXPECT_EQ(readTextFile(plots + "/" + name).substr(1, 3), "PNG") << name;
  }
  EXPECT_EQ(json::parse(readTextFile(plots + "/evaluation.json"))["ground_truth"], 2);
}

TEST_F(EvaluateCommand, RefusesDataSetsThatAreWrong) {
  const auto refusal = [&](const std::string& text) {
    writeDataSet(text);
    const CommandRun run = evaluate();
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.output, IsEmpty());
    return run.errors;
  };
  EXPECT_THAT(refusal(head_ + training_ + "scene: []\n"),
              HasSubstr("toys.yaml:6: unknown key 'scene' in the data set; did you mean 'scenes'?"));
  EXPECT_THAT(refusal(head_ + "training:\n  - {object: bumps, cloud: gone.pcd, kind: view}\n" + scene_),
              AllOf(HasSubstr("toys.yaml:5: cloud '"), HasSubstr("gone.pcd' does not exist")));
  EXPECT_THAT(refusal("name: toys\nunits: ell\nmax_distance: 2\n" + training_ + scene_),
              HasSubstr("toys.yaml:2: 'units' of the data set is 'ell': use m, cm, mm, inch or"));
  EXPECT_THAT(refusal(head_ + training_), HasSubstr("has no scenes to evaluate"));
}

TEST_F(EvaluateCommand, ErrorsOfASceneNameIt) {
  writeFileAtomically(folder_.path("scene.pcd"), "no cloud\n");
  const CommandRun run = evaluate();
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.errors, AllOf(HasSubstr("scene 'only' ("), HasSubstr("scene.pcd")));
}

TEST_F(EvaluateCommand, AMissingCodebookIsNamed) {
  const CommandRun run = evaluate({"--codebook", folder_.path("gone.sks")});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.errors, HasSubstr("gone.sks"));
  EXPECT_THAT(run.output, IsEmpty());
}

TEST_F(EvaluateCommand, BadUsageHasItsOwnStatus) {
  const CommandRun method = evaluate({"--method", "magic"});
  EXPECT_EQ(method.status, 2);
  EXPECT_THAT(method.errors, AllOf(HasSubstr("magic"), HasSubstr("there are: sks, sks-paper, grid, tombari")));
  EXPECT_EQ(evaluate({"--set", "keypoints.discrad=0.5"}).status, 2);
  EXPECT_EQ(evaluate({"--codebook", "a.sks", "--save-codebook", "b.sks"}).status, 2);
  EXPECT_EQ(runSks({"evaluate"}).status, 2);
  writeDataSet(head_ + scene_);
  const CommandRun untrained = evaluate();
  EXPECT_EQ(untrained.status, 2);
  EXPECT_THAT(untrained.errors, AllOf(HasSubstr("has no training clouds"), HasSubstr("--codebook FILE")));
}

TEST(AccuracyOfRecordedScenes, ScoresMeanTheSameForEverySelection) {
  const std::string file = test::recordedData("kinect/dataset.yaml");
  if (file.empty()) GTEST_SKIP() << "no recorded data: set SKS_DATA";
  const test::TemporaryFolder folder;
  const std::string codebook = folder.path("kinect.sks");
  ASSERT_EQ(runSks({"train", "--dataset", file, "--output", codebook}).status, 0);
  for (const char* discard : {"0", "0.75"}) {
    const CommandRun run = runSks({"evaluate", "--dataset", file, "--codebook", codebook, "--set",
                                   std::string("keypoints.discard=") + discard, "--json", "-"});
    ASSERT_EQ(run.status, 0) << run.errors;
    EXPECT_GT(json::parse(run.output)["f1"].get<double>(), 0.9) << discard;  // at the same fixed threshold
  }
}

}  // namespace
}  // namespace sks

#endif  // SKS_EXECUTABLE
