// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sks_detector/cloud_io.hpp>

#include "bumps.hpp"
#include "io/file.hpp"
#include "run_sks.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using nlohmann::json;
using test::CommandRun;
using test::runSks;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A surface and a scene with a copy of it that is moved along x.
class KeypointsCommand : public ::testing::Test {
protected:
  void SetUp() override {
    Cloud cloud = test::bumps();
    writeCloud(folder_.path("bumps.pcd"), cloud);
    for (Eigen::Vector3f& point : cloud.points) point.x() += 0.1f;
    writeCloud(folder_.path("scene.pcd"), cloud);
    writeFileAtomically(dataSet(),
                        "name: toys\nunits: m\nmax_distance: 0.05\n"
                        "training:\n  - {object: bumps, cloud: bumps.pcd, kind: view}\n"
                        "scenes:\n  - name: only\n    cloud: scene.pcd\n    objects:\n"
                        "      - object: bumps\n        position: [0.1, 0, 1]\n        reference: bumps.pcd\n"
                        "        pose: [1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"
                        "      - {object: ghost, position: [0, 0, 3]}\n");
  }
  std::string dataSet() const { return folder_.path("toys.yaml"); }
  CommandRun run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"keypoints", "--dataset", dataSet()});
    return runSks(arguments);
  }

  test::TemporaryFolder folder_;
};

TEST_F(KeypointsCommand, WritesSharesDifferencesCountsAndTimes) {
  const CommandRun found = run({"--json", "-"});
  ASSERT_EQ(found.status, 0) << found.errors;
  EXPECT_THAT(found.errors, HasSubstr("warning: 1 objects of the ground truth have no pose"));
  const json result = json::parse(found.output);
  EXPECT_EQ(result["dataset"], "toys");
  EXPECT_EQ(result["pairs"], 1);
  const json& grid = result["keypoints"]["grid"];
  EXPECT_EQ(result["keypoints"]["iss"]["relative_time"], 1.0);
  EXPECT_EQ(grid["pairs"][0]["object"], "bumps");
  EXPECT_EQ(grid["c_rk"]["ranked"].size(), 1u);
  EXPECT_GT(grid["c_rk"]["mean"], 0.5);
  EXPECT_LT(grid["t_diff"]["median"], 0.05);
  EXPECT_GT(grid["scene_keypoints"]["mean"], result["keypoints"]["sks-35"]["scene_keypoints"]["mean"]);
  EXPECT_GT(grid["time_ms"]["mean"], 0.0);
}

TEST_F(KeypointsCommand, DrawsRankedCurves) {
  const CommandRun found = run({"--plot", folder_.path("plots")});
  ASSERT_EQ(found.status, 0) << found.errors;
  EXPECT_THAT(found.output, AllOf(HasSubstr("toys: 1 pairs of object and scene in 1 scenes"), HasSubstr("sks-35")));
  EXPECT_THAT(readTextFile(folder_.path("plots/keypoints.csv")),
              AllOf(StartsWith("keypoints,rank,c_rk,t_diff\ngrid,1,"), HasSubstr("\niss,1,")));
  EXPECT_GT(std::filesystem::file_size(folder_.path("plots/keypoints.png")), 10000u);
}

TEST_F(KeypointsCommand, SaysWhatIsWrong) {
  EXPECT_EQ(runSks({"keypoints"}).status, 2);
  writeFileAtomically(dataSet(), "name: none\nunits: m\ntraining:\n  - {object: a, cloud: bumps.pcd, kind: view}\n");
  const CommandRun found = run({});
  EXPECT_EQ(found.status, 1);
  EXPECT_THAT(found.errors, HasSubstr("has no pair to compare"));
}

}  // namespace
}  // namespace sks

#endif
