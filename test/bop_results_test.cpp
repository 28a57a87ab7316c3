// SPDX-License-Identifier: BSD-3-Clause
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include "tools/bop_results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"

namespace sks {
namespace {

using test::errorOf;
using ::testing::HasSubstr;
using tools::bopResults;
using tools::checkBopNames;

class BopResults : public ::testing::Test {
protected:
  void SetUp() override {
    TrainingEntry model;
    model.object = "obj_000012";
    model.source = "models/obj_000012.ply";
    model.mesh = true;
    data_set_.training.push_back(model);
    Scene scene;
    scene.name = "000048/000001";
    data_set_.scenes.push_back(scene);

    Detection found;
    found.object = model.object;
    found.view = model.source;
    found.score = 0.75;
    found.T_scene_model.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    found.T_scene_model.translation() << 0.1, -0.02, 0.9;
    SceneResult result;
    result.scene = scene;
    result.times.total = 0.25;
    result.detections.push_back({found, Outcome::false_positive, {}, {}});
    evaluation_.scenes.push_back(result);
  }

  DataSet data_set_;
  Evaluation evaluation_;
};

TEST_F(BopResults, AreRowsOfNumbersInMillimetres) {
  checkBopNames(data_set_);
  EXPECT_EQ(bopResults(data_set_, evaluation_),
            "scene_id,im_id,obj_id,score,R,t,time\n"
            "48,1,12,0.75,0 -1 0 1 0 0 0 0 1,100 -20 900,0.25\n");
}

TEST_F(BopResults, NeedPosesOfTheModels) {
  evaluation_.scenes[0].detections[0].detection.view = "views/12.pcd";
  EXPECT_THAT(
      errorOf(ErrorCode::bad_data, [&] { bopResults(data_set_, evaluation_); }),
      HasSubstr("the pose of 'obj_000012' is in the frame of 'views/12.pcd', which is no mesh of the data set"));
}

TEST_F(BopResults, NeedNumbersAsNames) {
  data_set_.training[0].object = "mug";
  EXPECT_THAT(errorOf(ErrorCode::bad_data, [&] { checkBopNames(data_set_); }),
              HasSubstr("object 'mug' must be called obj_<number>"));
  data_set_.scenes[0].name = "table";
  EXPECT_THAT(errorOf(ErrorCode::bad_data, [&] { checkBopNames(data_set_); }),
              HasSubstr("scene 'table' must be called <scene>/<image>"));
}

}  // namespace
}  // namespace sks

#endif
