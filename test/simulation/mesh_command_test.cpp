// SPDX-License-Identifier: BSD-3-Clause
// What the command line says of meshes.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run_sks.hpp"
#include "simulation/box_files.hpp"
#include "simulation/mesh_file.hpp"
#include "simulation/notched_box.hpp"

namespace sks {
namespace {

using test::runSks;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class MeshCommand : public test::MeshFileTest {};

TEST_F(MeshCommand, InfoPrintsSizeAndColours) {
  write("atlas.png", encodePng(test::boxAtlas()));
  write("a.mtl", "newmtl m\nmap_Kd atlas.png\n");
  const std::string path = write("a.obj", test::boxObj("mtllib a.mtl\nusemtl m\n", 100));
  const test::CommandRun run = runSks({"info", path, "--scale", "cm"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.errors, IsEmpty());
  EXPECT_EQ(run.output, path +
                            ": mesh of 12 triangles, 24 vertices\n"
                            "size: 140.0 x 90.0 x 60.0 mm, unit not stated by the file\n"
                            "triangles with a texture: 100.0 %, with another colour: 0.0 %, without colour: 0.0 %\n"
                            "used with colour\n"
                            "texture of 96 x 16 pixels\n");
}

TEST_F(MeshCommand, InfoAsJsonHoldsTheWarnings) {
  const std::string path = write("a.obj", test::boxObj("mtllib gone.mtl\nusemtl m\n"));
  const test::CommandRun run = runSks({"info", path, "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  const nlohmann::json json = nlohmann::json::parse(run.output);
  EXPECT_EQ(json["triangles"], 12);
  EXPECT_NEAR(json["size_mm"][0].get<double>(), 140, 0.01);
  EXPECT_EQ(json["color"], false);
  EXPECT_EQ(json["triangles_without_color"], 12);
  EXPECT_THAT(json["warnings"][0].get<std::string>(), HasSubstr("'gone.mtl'"));
  EXPECT_THAT(run.errors, HasSubstr("sks: warning: " + path + ": its materials 'gone.mtl' cannot be read"));
}

TEST_F(MeshCommand, InfoSaysThatTheUpAxisIsNotApplied) {
  const std::string unit = "<unit name=\"millimeter\" meter=\"0.001\"/>";
  const std::string path = write("a.dae", test::notchedDae(unit, 1000, "Y_UP"));
  const test::CommandRun run = runSks({"info", path});
  EXPECT_THAT(run.output, HasSubstr("size: 140.0 x 90.0 x 60.0 mm, unit stated by the file\n"
                                    "up axis Y_UP in the file is not applied: its axes are kept"));
  EXPECT_THAT(run.errors, IsEmpty());
  write("a.dae", test::notchedDae(unit, 1000));
  EXPECT_THAT(runSks({"info", path}).output, Not(HasSubstr("up axis")));
}

TEST_F(MeshCommand, InfoKnowsBuiltinObjects) {
  EXPECT_THAT(runSks({"info", "builtin:mug"}).output, HasSubstr("builtin:mug: mesh of"));
}

TEST_F(MeshCommand, ScalesThatAreNoneAreRefused) {
  const std::string path = write("a.obj", test::boxObj(""));
  for (const char* scale : {"0", "-1", "1e30", "nan", "feet", "1e-30"}) {
    const test::CommandRun run = runSks({"info", path, "--scale", scale});
    EXPECT_EQ(run.status, 2) << scale;
    EXPECT_THAT(run.errors, HasSubstr("--scale " + std::string(scale) + ": expected the unit of the meshes"));
  }
}

TEST_F(MeshCommand, ImpossibleDistancesAreRefused) {
  const std::string mesh = "box=" + write("a.obj", test::boxObj(""));
  for (const char* distance : {"0", "-1", "1e30", "nan", "inf", "101"}) {
    const test::CommandRun run =
        runSks({"train", "--mesh", mesh, "--view-distance", distance, "--output", folder_.path("a.sks")});
    EXPECT_EQ(run.status, 2) << distance;
    EXPECT_THAT(run.errors, HasSubstr("must be in (0, 100] m"));
  }
  for (const char* option : {"--max-distance", "--region"}) {
    const test::CommandRun run = runSks({"simulate", "--mesh", mesh, option, "1e30", "--output", folder_.path("set")});
    EXPECT_EQ(run.status, 2) << option;
  }
}

TEST_F(MeshCommand, TrainingSaysWhatIsTooSmallForIt) {
  const std::vector<std::string> train = {"train", "--views", "4", "--output", folder_.path("a.sks")};
  const auto errors = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = train;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::CommandRun run = runSks(arguments);
    EXPECT_EQ(run.status, 0) << run.errors;
    return run.errors;
  };
  const std::string mesh = "box=" + write("a.obj", test::boxObj("", 1000));
  EXPECT_THAT(errors({"--mesh", mesh, "--scale", "mm"}), IsEmpty());
  EXPECT_THAT(errors({"--mesh", mesh, "--scale", "0.0001"}),
              HasSubstr("object 'box' is 14 x 9 x 6 mm large, which is too small for these settings; set "
                        "keypoints.grid_size=0.00"));
}

}  // namespace
}  // namespace sks

#endif
