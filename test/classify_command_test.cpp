// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sks_detector/cloud_io.hpp>

#include "io/file.hpp"
#include "recorded_data.hpp"
#include "run_sks.hpp"
#include "synthetic.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using nlohmann::json;
using test::CommandRun;
using test::runSks;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Two trained shapes of half a metre, and tests of them and of one that was never trained.
class ClassifyCommand : public ::testing::Test {
protected:
  void SetUp() override {
    write("blocks.pcd", test::asymmetricShape(), 0);
    write("potato.pcd", test::roundedShape(), 0);
    write("turned.pcd", test::asymmetricShape(), 50);
    writeFileAtomically(dataSet(),
                        "name: shapes\nunits: m\n"
                        "training:\n"
                        "  - {object: blocks, cloud: blocks.pcd, kind: model}\n"
                        "  - {object: potato, cloud: potato.pcd, kind: model}\n"
                        "tests:\n"
                        "  - {object: blocks, cloud: turned.pcd}\n"
                        "  - {object: potato, cloud: potato.pcd}\n"
                        "  - {object: ghost, cloud: potato.pcd}\n");
  }
  void write(const std::string& name, const test::Shape& shape, float degrees) const {
    Cloud cloud = test::transformed(test::model(shape, 0.006f), test::poseOf(degrees, {1, 1, 0}, {0, 0, 0}));
    for (Eigen::Vector3f& point : cloud.points) point *= 2;
    writeCloud(folder_.path(name), cloud);
  }
  std::string dataSet() const { return folder_.path("shapes.yaml"); }
  CommandRun classify(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.begin(), {"classify", "--dataset", dataSet()});
    return runSks(arguments);
  }

  test::TemporaryFolder folder_;
};

TEST_F(ClassifyCommand, WritesAccuracyConfusionAndAnswers) {
  const CommandRun run = classify({"--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("warning: object 'ghost' of the tests was never trained"));
  const json result = json::parse(run.output);
  EXPECT_EQ(result["dataset"], "shapes");
  EXPECT_EQ(result["method"], "sks");
  EXPECT_EQ(result["tests"], 3);
  EXPECT_EQ(result["correct"], 2);
  EXPECT_NEAR(result["accuracy"].get<double>(), 2.0 / 3, 1e-9);
  EXPECT_EQ(result["objects"], json({"blocks", "ghost", "potato"}));
  EXPECT_EQ(result["confusion"], json({{1, 0, 0}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_EQ(result["per_object"]["ghost"]["accuracy"], 0.0);
  EXPECT_EQ(result["per_test"][0]["answer"], "blocks");
  EXPECT_EQ(result["per_test"][0]["correct"], true);
  EXPECT_EQ(result["per_test"][2]["candidates"][0]["object"], "potato");
  EXPECT_EQ(result["settings"]["keypoints.discard"], 0.0);
  EXPECT_GT(result["time_ms"]["total"]["mean"], 0.0);
}

TEST_F(ClassifyCommand, PrintsTablesForPeople) {
  const CommandRun run = classify({"--method", "grid"});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, AllOf(HasSubstr("shapes, grid: accuracy 0.667 (2 of 3)"), HasSubstr("true \\ answer"),
                                HasSubstr("mean times [ms]: total")));
}

TEST_F(ClassifyCommand, PublishedMethodDropsHalfOfTheKeypoints) {
  const CommandRun run = classify({"--method", "sks-paper", "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  const json result = json::parse(run.output), counts = result["per_test"][0]["counts"];
  EXPECT_EQ(result["settings"]["keypoints.discard"], 0.5);
  EXPECT_EQ(result["settings"]["matching.ambiguity"], 1.0);  // only the nearest codeword votes
  const int all = counts["grid_keypoints"];
  EXPECT_EQ(counts["keypoints"], all - all / 2);
}

TEST_F(ClassifyCommand, ComparesWithOtherMethods) {
  for (const char* name : {"knopp", "seib"}) {
    const CommandRun run = classify({"--method", name, "--json", "-"});
    ASSERT_EQ(run.status, 0) << run.errors;
    const json result = json::parse(run.output);
    EXPECT_EQ(result["method"], name);
    EXPECT_EQ(result["correct"], 2) << name;
  }
  const CommandRun run = classify({"--method", "aldoma"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.errors, HasSubstr("use --method chen"));
}

TEST_F(ClassifyCommand, TakesACodebookAndItsSettings) {
  const std::string codebook = folder_.path("shapes.sks");
  ASSERT_EQ(classify({"--save-codebook", codebook, "--set", "descriptor.radius=0.12"}).status, 0);
  const CommandRun run = classify({"--codebook", codebook, "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(json::parse(run.output)["settings"]["descriptor.radius"], 0.12);
  const CommandRun other = classify({"--codebook", codebook, "--set", "descriptor.radius=0.1"});
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.errors, HasSubstr("descriptor.radius = 0.12 (not 0.1)"));
}

TEST_F(ClassifyCommand, SaysWhatIsWrong) {
  writeFileAtomically(dataSet(), "name: none\nunits: m\ntraining:\n  - {object: a, cloud: blocks.pcd, kind: model}\n");
  const CommandRun none = classify();
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.errors, HasSubstr("has nothing to classify; list isolated objects under 'tests'"));
  const CommandRun method = classify({"--method", "magic"});
  EXPECT_EQ(method.status, 2);
  EXPECT_THAT(method.errors, HasSubstr("magic"));
  EXPECT_EQ(runSks({"classify"}).status, 2);
}

TEST(AccuracyOfRecordedShapes, ReachesTheAimedAccuracy) {
  const std::string shapes = test::recordedData("shapes/dataset.yaml");
  if (shapes.empty()) GTEST_SKIP() << "the recorded shapes are not here";
  const CommandRun run = runSks({"classify", "--dataset", shapes, "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_GE(json::parse(run.output)["accuracy"], 0.96);
}

}  // namespace
}  // namespace sks

#endif
