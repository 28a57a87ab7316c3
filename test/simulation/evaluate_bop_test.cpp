// SPDX-License-Identifier: BSD-3-Clause
// The BOP errors that the command line gives for a rendered scene of an object that it trains from a mesh.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "run_sks.hpp"
#include "simulation/builtin_objects.hpp"
#include "simulation/renderer.hpp"
#include "tools/data_set_yaml.hpp"

namespace sks {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A drill before a camera.
class EvaluateBop : public ::testing::Test {
protected:
  void SetUp() override {
    const auto mesh = std::make_shared<const Mesh>(builtinObject("drill"));
    Renderer renderer;
    renderer.addInstance(renderer.addMesh(mesh), Eigen::Isometry3d::Identity());
    const Eigen::Vector3d center = mesh->box().center().cast<double>();
    const Eigen::Isometry3d T_drill_camera =
        lookAt(center + Eigen::Vector3d(0.5, 0.4, 0.3), center, Eigen::Vector3d::UnitZ());
    CameraModel camera;
    camera.noise = CameraNoise::none();
    writeCloud(folder_.path("scene.pcd"), renderer.render(camera, T_drill_camera, 0, 1).cloud);

    GroundTruth truth;
    truth.object = "drill";
    truth.reference = "builtin:drill";
    truth.T_scene_reference = T_drill_camera.inverse();
    truth.position = T_drill_camera.inverse() * center;
    scene_.name = "only";
    scene_.path = "scene.pcd";
    scene_.objects = {truth};
  }

  json evaluated(const std::string& training, const std::string& threads = "2") const {
    test::writeFile(folder_.path("set.yaml"), "name: set\nunits: m\nmax_distance: 0.05\ntraining:\n  - " + training +
                                                  "\nscenes:\n" + tools::sceneYaml(scene_));
    const test::CommandRun run = test::runSks({"evaluate", "--dataset", folder_.path("set.yaml"), "--views", "12",
                                               "--set", "threads=" + threads, "--json", "-"});
    EXPECT_EQ(run.status, 0) << run.errors;
    return json::parse(run.output);
  }

  const std::string training_ = "{object: drill, cloud: 'builtin:drill', kind: mesh}";
  Scene scene_;
  test::TemporaryFolder folder_;
};

TEST_F(EvaluateBop, GivesTheRecallsOfAMeshThatIsFound) {
  const json result = evaluated(training_), bop = result["bop"];
  EXPECT_EQ(bop["targets"], 1);
  EXPECT_TRUE(bop["not_available"].empty()) << bop;
  EXPECT_GE(bop["mssd"], 0.9);
  EXPECT_GE(bop["mspd"], 0.9);
  EXPECT_GE(bop["vsd"], 0.7);
  const double sum = double(bop["vsd"]) + double(bop["mssd"]) + double(bop["mspd"]);
  EXPECT_NEAR(bop["ar"], sum / 3, 1e-9);
  EXPECT_EQ(result["per_object"]["drill"]["bop"]["ar"], bop["ar"]);
  EXPECT_EQ(evaluated(training_, "1")["bop"], bop);
}

TEST_F(EvaluateBop, TakesTheDiameterOfTheDataSet) {
  // of a drill of 100 m diameter each pose is near enough
  const std::string large = "{object: drill, cloud: 'builtin:drill', kind: mesh, diameter: 100}";
  scene_.objects[0].T_scene_reference->translation().x() += 0.3;
  const json huge = evaluated(large)["bop"], usual = evaluated(training_)["bop"];
  EXPECT_EQ(huge["mssd"], 1.0);
  EXPECT_LT(usual["mssd"], 0.2);
}

TEST_F(EvaluateBop, PrintsATable) {
  evaluated(training_);
  const test::CommandRun run = test::runSks({"evaluate", "--dataset", folder_.path("set.yaml"), "--views", "12"});
  EXPECT_THAT(run.output, AllOf(HasSubstr("targets"), HasSubstr("AR_VSD"), HasSubstr("AR_MSPD")));
}

}  // namespace
}  // namespace sks

#endif
