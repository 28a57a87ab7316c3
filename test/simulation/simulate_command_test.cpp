// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <cstdio>
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/dataset.hpp"
#include "io/file.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::runSks;
using ::testing::HasSubstr;

class SimulateCommand : public ::testing::Test {
protected:
  test::CommandRun simulate(const std::string& folder) const {
    return runSks({"simulate", "--output", folder_.path(folder), "--mesh", "mug=builtin:mug", "--mesh",
                   "duck=builtin:duck", "--scenes", "2", "--objects", "2", "--distractors", "1", "--seed", "4"});
  }
  test::TemporaryFolder folder_;
};

TEST_F(SimulateCommand, SameSeedSameFiles) {
  ASSERT_EQ(simulate("a").status, 0);
  ASSERT_EQ(simulate("b").status, 0);
  for (const char* file : {"dataset.yaml", "scenes/scene000.pcd", "scenes/scene001.pcd", "scenes/scene001_color.png",
                           "scenes/scene001_depth.png"}) {
    EXPECT_EQ(readTextFile(folder_.path(std::string("a/") + file)),
              readTextFile(folder_.path(std::string("b/") + file)))
        << file;
  }
  const DataSet data_set = loadDataSet(folder_.path("a/dataset.yaml"));
  EXPECT_TRUE(data_set.warnings.empty());
  EXPECT_EQ(data_set.scenes.size(), 2u);
  EXPECT_EQ(data_set.training.size(), 2u);
  for (const Scene& scene : data_set.scenes) {
    for (const GroundTruth& truth : scene.objects) {
      EXPECT_TRUE(truth.T_scene_reference);
      EXPECT_GE(truth.visibility.value_or(0), 0.05);
    }
  }
}

TEST_F(SimulateCommand, ASequenceTellsWhereTheCameraWas) {
  ASSERT_EQ(runSks({"simulate", "--output", folder_.path("a"), "--mesh", "mug=builtin:mug", "--objects", "1",
                    "--distractors", "0", "--sequence", "0.4", "--frame-rate", "10"})
                .status,
            0);
  const DataSet data_set = loadDataSet(folder_.path("a/dataset.yaml"));
  ASSERT_EQ(data_set.scenes.size(), 4u);
  std::istringstream lines(readTextFile(folder_.path("a/camera.txt")));
  std::string line;
  std::size_t scene = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  while (std::getline(lines, line)) {
    if (line[0] == '#') continue;
    std::istringstream numbers(line);
    double stamp = 0;
    Eigen::Isometry3d T_table_camera = Eigen::Isometry3d::Identity();
    Eigen::Quaterniond q;
    Eigen::Vector3d p;
    numbers >> stamp >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w();
    T_table_camera = Eigen::Translation3d(p) * q;
    EXPECT_NEAR(stamp, 0.1 * double(scene), 1e-6);
    EXPECT_NEAR(q.norm(), 1, 1e-6);
    const auto& objects = data_set.scenes.at(scene).objects;
    if (scene < 2) {  // before the push
      const Eigen::Vector3d mug = T_table_camera * objects.at(0).T_scene_reference.value().translation();
      if (scene == 0) first = mug;
      EXPECT_LT((mug - first).norm(), 1e-4);
    }
    ++scene;
  }
  EXPECT_EQ(scene, 4u);
}

TEST_F(SimulateCommand, MixesNoTwoDataSets) {
  ASSERT_EQ(simulate("a").status, 0);
  const std::string before = readTextFile(folder_.path("a/dataset.yaml"));
  const std::vector<std::string> other{"simulate", "--output", folder_.path("a"), "--mesh", "pot=builtin:bowl",
                                       "--scenes", "1",        "--objects",       "1"};
  const test::CommandRun refused = runSks(other);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("a' holds a data set already (dataset.yaml): give another one, or --force"));
  EXPECT_EQ(readTextFile(folder_.path("a/dataset.yaml")), before);
  std::vector<std::string> forced = other;
  forced.push_back("--force");
  EXPECT_EQ(runSks(forced).status, 0);
  EXPECT_EQ(loadDataSet(folder_.path("a/dataset.yaml")).training.at(0).object, "pot");
  std::filesystem::remove(folder_.path("a/dataset.yaml"));
  EXPECT_THAT(runSks(other).errors, HasSubstr("holds clouds already (scenes/)"));
}

/// Objects of 30 to 40 mm and flat ones have too few keypoints for votes: they are found as what stands there alone.
TEST_F(SimulateCommand, SmallAndFlatThingsAreFoundWhereTheyStandAlone) {
  const std::vector<std::string> meshes{"--mesh", "dice=builtin:dice", "--mesh", "card=builtin:card"};
  std::vector<std::string> simulate{"simulate", "--output", folder_.path("a"), "--scenes", "4", "--objects", "1"};
  for (const char* argument : {"--distractors", "0", "--min-distance", "0.6", "--max-distance", "0.8"}) {
    simulate.push_back(argument);
  }
  std::vector<std::string> train{"train", "--views", "20", "--output", folder_.path("a.sks")};
  for (auto* arguments : {&simulate, &train}) arguments->insert(arguments->end(), meshes.begin(), meshes.end());
  ASSERT_EQ(runSks(simulate).status, 0);
  ASSERT_EQ(runSks(train).status, 0);
  const test::CommandRun run = runSks(
      {"evaluate", "--dataset", folder_.path("a/dataset.yaml"), "--codebook", folder_.path("a.sks"), "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  const nlohmann::json result = nlohmann::json::parse(run.output);
  EXPECT_EQ(result["ground_truth"].get<int>(), 4);
  EXPECT_GE(result["true_positives"].get<int>(), 3);
  EXPECT_EQ(result["false_positives"].get<int>(), 0);
}

TEST_F(SimulateCommand, WhatIsTrainedFromMeshesIsFoundWithItsPose) {
  ASSERT_EQ(simulate("a").status, 0);
  ASSERT_EQ(runSks({"train", "--mesh", "mug=builtin:mug", "--mesh", "duck=builtin:duck", "--views", "20", "--output",
                    folder_.path("a.sks")})
                .status,
            0);
  const test::CommandRun run = runSks(
      {"evaluate", "--dataset", folder_.path("a/dataset.yaml"), "--codebook", folder_.path("a.sks"), "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  const nlohmann::json result = nlohmann::json::parse(run.output);
  EXPECT_GE(result["true_positives"].get<int>(), 2);
  EXPECT_LT(result["pose"]["translation_error_m"]["median"].get<double>(), 0.005);
  EXPECT_LT(result["pose"]["rotation_error_deg"]["median"].get<double>(), 5);
}

TEST_F(SimulateCommand, GroupsOfBuiltInObjectsWithTheirNumberOfPoints) {
  const auto simulated = [&](const std::string& folder, const std::string& least) {
    const test::CommandRun run =
        runSks({"simulate", "--output", folder_.path(folder), "--builtin", "small", "flat", "--scenes", "2",
                "--objects", "10", "--distractors", "0", "--min-points", least});
    EXPECT_EQ(run.status, 0) << run.errors;
    return loadDataSet(folder_.path(folder + "/dataset.yaml"));
  };
  const DataSet all = simulated("all", "0"), many = simulated("many", "400");
  ASSERT_EQ(all.training.size(), 10u);
  EXPECT_EQ(all.training.front().source, "builtin:dice");
  EXPECT_EQ(all.training.back().source, "builtin:tablet");
  std::size_t ignored = 0;
  for (std::size_t i = 0; i < all.scenes.size(); ++i) {
    std::vector<std::string> names;
    for (const GroundTruth& truth : all.scenes[i].objects) {
      ASSERT_TRUE(truth.points);
      if (*truth.points >= 400) names.push_back(truth.object);
    }
    std::vector<std::string> left;
    for (const GroundTruth& truth : many.scenes[i].objects) left.push_back(truth.object);
    EXPECT_EQ(left, names);
    EXPECT_EQ(left.size() + many.scenes[i].ignore.size(), 10u);
    ignored += many.scenes[i].ignore.size();
  }
  EXPECT_GT(ignored, 0u);
}

TEST_F(SimulateCommand, TwinsOfADataSetHaveItsObjectsAndPoses) {
  ASSERT_EQ(simulate("a").status, 0);
  const test::CommandRun run = runSks(
      {"simulate", "--output", folder_.path("b"), "--twin", folder_.path("a/dataset.yaml"), "--camera", "kinect"});
  ASSERT_EQ(run.status, 0) << run.errors;
  const DataSet recorded = loadDataSet(folder_.path("a/dataset.yaml")),
                twins = loadDataSet(folder_.path("b/dataset.yaml"));
  EXPECT_EQ(twins.name, "simulated_twins");
  ASSERT_EQ(twins.scenes.size(), recorded.scenes.size());
  ASSERT_EQ(twins.training.size(), 2u);
  for (std::size_t i = 0; i < twins.scenes.size(); ++i) {
    ASSERT_EQ(twins.scenes[i].objects.size(), recorded.scenes[i].objects.size());
    for (std::size_t k = 0; k < twins.scenes[i].objects.size(); ++k) {
      const GroundTruth &twin = twins.scenes[i].objects[k], &truth = recorded.scenes[i].objects[k];
      EXPECT_EQ(twin.object, truth.object);
      EXPECT_LT((twin.position - truth.position).norm(), 1e-6);
      EXPECT_GT(double(twin.points.value_or(0)), 0.6 * double(*truth.points));
    }
  }
  EXPECT_THAT(
      runSks({"simulate", "--output", folder_.path("c"), "--builtin", "--twin", folder_.path("a/dataset.yaml")}).errors,
      HasSubstr("--twin takes objects and scenes from its data set"));
}

TEST_F(SimulateCommand, DetectionsBecomeABopResultFile) {
  const std::vector<std::string> meshes{"--mesh", "obj_000001=builtin:mug", "--mesh", "obj_000002=builtin:duck"};
  std::vector<std::string> arguments{"simulate", "--output", folder_.path("a"), "--scenes", "1", "--objects", "2"};
  arguments.insert(arguments.end(), meshes.begin(), meshes.end());
  ASSERT_EQ(runSks(arguments).status, 0);
  const std::string file = folder_.path("a/dataset.yaml"), results = folder_.path("results.csv");
  std::string text = readTextFile(file);
  const std::size_t name = text.find("scene000\"");
  ASSERT_NE(name, std::string::npos);
  test::writeFile(file, text.replace(name, 8, "000003/000007"));
  const test::CommandRun run =
      runSks({"evaluate", "--dataset", file, "--views", "20", "--bop-results", results, "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;

  std::istringstream rows(readTextFile(results));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "scene_id,im_id,obj_id,score,R,t,time");
  std::size_t count = 0, near = 0;
  const Scene scene = loadDataSet(file).scenes.at(0);
  for (; std::getline(rows, row); ++count) {
    int object = 0;
    double score = 0, R[9], t[3], seconds = 0;
    ASSERT_EQ(std::sscanf(row.c_str(), "3,7,%d,%lf,%lf %lf %lf %lf %lf %lf %lf %lf %lf,%lf %lf %lf,%lf", &object,
                          &score, R, R + 1, R + 2, R + 3, R + 4, R + 5, R + 6, R + 7, R + 8, t, t + 1, t + 2, &seconds),
              15)
        << row;
    EXPECT_GT(seconds, 0);
    for (const GroundTruth& truth : scene.objects) {
      const bool same = truth.object == "obj_00000" + std::to_string(object) && score >= 0.5;
      const Eigen::Vector3d off = 1000 * truth.T_scene_reference->translation() - Eigen::Vector3d(t[0], t[1], t[2]);
      near += same && off.norm() < 10 ? 1 : 0;  // [mm]
    }
  }
  EXPECT_GE(count, near);
  EXPECT_EQ(near, scene.objects.size());
}

TEST_F(SimulateCommand, RefusesWithTheReason) {
  const auto refusal = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"simulate", "--output", folder_.path("x")});
    const test::CommandRun run = runSks(arguments);
    EXPECT_NE(run.status, 0);
    return run.errors;
  };
  EXPECT_THAT(refusal({}), HasSubstr("nothing to simulate: give --builtin or --mesh NAME=FILE"));
  EXPECT_THAT(refusal({"--mesh", "mug"}), HasSubstr("expected NAME=FILE"));
  EXPECT_THAT(refusal({"--mesh", "mug=none.obj"}), HasSubstr("'none.obj': it does not exist"));
  EXPECT_THAT(refusal({"--builtin", "--mesh", "mug=builtin:mug"}), HasSubstr("two meshes are called 'mug'"));
  EXPECT_THAT(refusal({"--builtin", "--scenes", "0"}), HasSubstr("--scenes 0 must be in"));
  EXPECT_THAT(refusal({"--builtin", "--min-points", "-1"}), HasSubstr("--min-points -1 must be 0 or more"));
  EXPECT_THAT(refusal({"--builtin", "tiny"}), HasSubstr("no group 'tiny' of built-in objects"));
  EXPECT_THAT(refusal({"--builtin", "--camera", "kinekt"}), HasSubstr("there is no camera 'kinekt'"));
  EXPECT_THAT(refusal({"--builtin", "--room", "kitchen"}), HasSubstr("there is no room 'kitchen'"));
}

}  // namespace
}  // namespace sks

#endif
