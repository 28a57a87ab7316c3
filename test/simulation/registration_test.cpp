// SPDX-License-Identifier: BSD-3-Clause
// Views of objects on a table, before a virtual Kinect, are tied into one model: rightly or not at all.
#include <sks_detector/registration.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/simulation/camera_presets.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "evaluation/registered_truth.hpp"
#include "simulation/builtin_objects.hpp"
#include "table_view.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::TableView;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<double> degreesOf(const RegisteredObject& object) {
  std::vector<double> degrees;
  for (const RegisteredView& view : object.views) {
    degrees.push_back(std::stod(view.source.substr(view.source.find_first_of("0123456789"))));
  }
  return degrees;
}

constexpr double degree = EIGEN_PI / 180;

/// By how much the model frame of `after` differs from that of `before`, by each view that is tied in both.
std::vector<Eigen::Isometry3d> frameChanges(const RegisteredObject& before, const RegisteredObject& after) {
  std::vector<Eigen::Isometry3d> changes;
  for (std::size_t v = 0; v < before.views.size(); ++v) {
    const auto &old_pose = before.views[v].T_model_view, &new_pose = after.views[v].T_model_view;
    if (old_pose && new_pose) changes.push_back(*new_pose * old_pose->inverse());
  }
  return changes;
}

/// The frame may only follow the middle of the box, across the plane: all views alike.
void expectSameAxesAndHeight(const std::vector<Eigen::Isometry3d>& changes) {
  for (const Eigen::Isometry3d& change : changes) {
    EXPECT_LT(Eigen::AngleAxisd(change.linear()).angle(), 0.5 * degree);
    EXPECT_LT(std::abs(change.translation().z()), 0.001);
    EXPECT_LT((change.translation() - changes[0].translation()).norm(), 0.001);
  }
}

/// The first tied view; the frame refers to it where nothing before it was left out later.
const RegisteredView& firstOf(const RegisteredObject& object) {
  return *std::find_if(object.views.begin(), object.views.end(), [](const auto& view) { return view.T_model_view; });
}

class DuckModel : public ::testing::Test {
protected:
  static const TableView& table() {
    static const TableView duck("duck");
    return duck;
  }
  static const std::vector<TrainingSample>& samples() {
    static const std::vector<TrainingSample> views = table().captureAround(12);
    return views;
  }
  static const ViewRegistration& registered() {
    static const ViewRegistration registration = registerViews(samples(), Settings());
    return registration;
  }
};

TEST_F(DuckModel, TiesNearlyAllViewsAndAllOfThemRightly) {
  ASSERT_EQ(registered().objects.size(), 1u);
  const RegisteredObject& duck = registered().objects[0];
  EXPECT_EQ(duck.object, "duck");
  EXPECT_GE(duck.tied(), 9u);
  for (const RegisteredView& view : duck.views) EXPECT_EQ(bool(view.T_model_view), view.reason.empty());
  const auto [shift, turn] = table().spread(duck, degreesOf(duck));
  EXPECT_LT(shift, 0.003);
  EXPECT_LT(turn, 2 * degree);
  EXPECT_GT(duck.loops.loops, 10u);
  EXPECT_LT(duck.loops.largest_shift, 0.005);
  EXPECT_LT(duck.loops.largest_angle, 3 * degree);
}

TEST_F(DuckModel, StandsUprightOnTheMiddleOfItsBase) {
  const RegisteredObject& duck = registered().objects[0];
  EXPECT_TRUE(duck.on_plane);
  const Eigen::Isometry3d T_table_model =
      table().T_table_camera(degreesOf(duck)[firstOf(duck).sample]) * firstOf(duck).T_model_view->inverse();
  EXPECT_LT(std::acos(std::min(1.0, T_table_model.linear()(2, 2))), 1 * degree);
  EXPECT_NEAR(T_table_model.translation().z(), 0, 0.003);
  const Eigen::AlignedBox3f& box = duck.model.box;
  EXPECT_NEAR(box.min().z(), 0, 1e-6);
  EXPECT_NEAR(box.max().z(), table().size().z(), 0.005);
  EXPECT_NEAR(box.center().x(), 0, 1e-5);
  EXPECT_NEAR(box.center().y(), 0, 1e-5);
  // the first view was taken from where x points to
  EXPECT_GT(firstOf(duck).sensor.x(), 0.5);
  EXPECT_NEAR(firstOf(duck).sensor.y(), 0, 0.05);
}

TEST_F(DuckModel, HasNormalsOutwardsAndColours) {
  const FusedModel& model = registered().objects[0].model;
  ASSERT_GT(model.points.size(), 1000u);
  EXPECT_EQ(model.normals.size(), model.points.size());
  EXPECT_EQ(model.colors.size(), model.points.size());
  for (const Eigen::Vector3f& normal : model.normals) EXPECT_NEAR(normal.norm(), 1, 1e-4);
}

TEST_F(DuckModel, OriginAtTheCentreOfTheBox) {
  Settings settings;
  settings.training.origin = ModelOrigin::center;
  const ViewRegistration centered = registerViews(samples(), settings);
  EXPECT_LT(centered.objects[0].model.box.center().norm(), 1e-5);
}

TEST_F(DuckModel, IsTheSameForAnyNumberOfThreads) {
  Settings settings;
  settings.threads = 1;
  const ViewRegistration one = registerViews(samples(), settings);
  for (std::size_t v = 0; v < samples().size(); ++v) {
    const auto &single = one.objects[0].views[v].T_model_view, &several = registered().objects[0].views[v].T_model_view;
    ASSERT_EQ(bool(single), bool(several));
    if (single) {
      EXPECT_EQ(single->matrix(), several->matrix());
    }
  }
}

TEST_F(DuckModel, GivesDetectionsOneFrameAndBox) {
  const RegisteredTraining trained = trainRegistered(samples(), Settings(), "duck");
  const RegisteredObject& duck = trained.objects.at(0);
  for (std::size_t v = 0; v < duck.views.size(); ++v) {
    const TrainingView& view = trained.codebook.views[v];
    const bool tied = bool(duck.views[v].T_model_view);
    EXPECT_EQ(view.frameName(), tied ? "duck#model" : duck.views[v].source);
    if (tied) {
      EXPECT_LT((view.center() - duck.model.box.center()).norm(), 1e-5);
      EXPECT_LT((view.extent() - duck.model.box.sizes()).norm(), 1e-5);
    }
  }
  const test::TemporaryFolder folder;
  writeCodebook(folder.path("duck.sks"), trained.codebook);
  const auto codebook = readCodebook(folder.path("duck.sks"));
  const std::size_t first = firstOf(duck).sample;
  ASSERT_TRUE(codebook->views[first].T_model_source);
  EXPECT_TRUE(codebook->views[first].T_model_source->isApprox(*firstOf(duck).T_model_view, 1e-5));
  const RegisteredModel* model = codebook->modelOf(codebook->views[first]);
  ASSERT_NE(model, nullptr);
  EXPECT_GT(model->surface.points.size(), 1000u);
  EXPECT_LT(model->surface.points.size(), duck.model.points.size() / 2);
  EXPECT_EQ(model->surface.colors.size(), model->surface.points.size());
  EXPECT_TRUE(model->surface.box.isApprox(duck.model.box));

  const Eigen::Isometry3d T_table_model =
      table().T_table_camera(degreesOf(duck)[first]) * firstOf(duck).T_model_view->inverse();
  const Detector detector(codebook);
  int of_model = 0;
  for (const double degrees : {85.0, 145.0, 205.0, 265.0}) {
    const auto found = detector.detect(table().picture(degrees, 1000)).above(0.5);
    ASSERT_EQ(found.size(), 1u) << degrees;
    if (found[0].view != "duck#model") continue;
    ++of_model;
    const Eigen::Isometry3d T_scene_true = table().T_table_camera(degrees).inverse() * T_table_model;
    EXPECT_LT((found[0].T_scene_model.translation() - T_scene_true.translation()).norm(), 0.01) << degrees;
    EXPECT_LT(Eigen::AngleAxisd(found[0].T_scene_model.linear().transpose() * T_scene_true.linear()).angle(),
              6 * degree);
  }
  EXPECT_GE(of_model, 3);
}

TEST_F(DuckModel, EvaluatesTruthInTheFramesOfViews) {
  const RegisteredTraining trained = trainRegistered(samples(), Settings(), "duck");
  DataSet data_set;
  Scene scene;
  GroundTruth truth;
  truth.object = "duck";
  const RegisteredView& view = firstOf(trained.objects.at(0));
  truth.reference = view.source;
  truth.T_scene_reference = Eigen::Isometry3d::Identity();
  scene.objects = {truth};
  data_set.scenes = {scene};
  const GroundTruth in_model = registeredTruth(data_set, trained.codebook).scenes[0].objects[0];
  EXPECT_EQ(in_model.model_frame, "duck#model");
  ASSERT_TRUE(in_model.T_scene_model);
  EXPECT_TRUE(in_model.T_scene_model->isApprox(view.T_model_view->inverse(), 1e-5));
}

TEST(ViewRegistrationTest, TwoViewsAloneAreNotBelieved) {
  const TableView duck("duck");
  const ViewRegistration registration = registerViews({duck.capture(0), duck.capture(30)}, Settings());
  ASSERT_EQ(registration.objects.size(), 1u);
  EXPECT_EQ(registration.objects[0].tied(), 0u);
  EXPECT_TRUE(registration.samples[0].frame.empty());
  ASSERT_EQ(registrationWarnings(registration.objects).size(), 1u);
  EXPECT_THAT(registrationWarnings(registration.objects)[0], HasSubstr("two views alone cannot confirm each other"));
}

TEST(ViewRegistrationTest, KeepsViewsOfAnotherObjectApart) {
  const TableView duck("duck"), mug("mug");
  std::vector<TrainingSample> samples = duck.captureAround(6, 0, 180);
  for (TrainingSample sample : mug.captureAround(2, 0, 60)) {
    sample.object = "duck";
    samples.push_back(sample);
  }
  const RegisteredObject registered = registerViews(samples, Settings()).objects.at(0);
  EXPECT_GE(registered.tied(), 4u);
  for (const RegisteredView& view : registered.views) {
    if (view.source.rfind("mug", 0) != 0) continue;
    EXPECT_FALSE(view.T_model_view) << view.source;
    EXPECT_FALSE(view.reason.empty()) << view.source;
  }
}

TEST(ViewRegistrationTest, SaysWhichViewShowsAnArmToo) {
  const TableView duck("duck");
  std::vector<TrainingSample> samples = duck.captureAround(7, 0, 175);
  samples[3] = duck.captureWithArm(75);
  const RegisteredObject registered = registerViews(samples, Settings()).objects.at(0);
  EXPECT_GE(registered.tied(), 4u);
  EXPECT_FALSE(registered.views[3].T_model_view);
  EXPECT_THAT(registered.views[3].reason, HasSubstr("it contradicts what 'duck"));
  EXPECT_THAT(registrationWarnings({registered}), ElementsAre(HasSubstr("; duck75: it contradicts what")));
  const auto [shift, turn] = duck.spread(registered, degreesOf(registered));
  EXPECT_LT(shift, 0.003);
  EXPECT_LT(turn, 2 * degree);
  EXPECT_NEAR(registered.model.box.max().z(), duck.size().z(), 0.005);  // without the arm
}

TEST(ViewRegistrationTest, LeavesTheFrameWhereItIsWhenViewsAreAdded) {
  const TableView duck("duck");
  ObjectRegistrar registrar("duck", Settings());
  // With more views the first three are given up again.
  for (const double degrees : {100.0, 125.0, 150.0, 175.0}) registrar.add(duck.capture(degrees));
  const RegisteredObject few = registrar.result();
  ASSERT_EQ(few.tied(), 4u);
  for (const double degrees : {200.0, 225.0, 250.0, 275.0, 300.0, 325.0}) registrar.add(duck.capture(degrees));
  const RegisteredObject most = registrar.result();
  ASSERT_GT(most.tied(), few.tied());
  ASSERT_FALSE(frameChanges(few, most).empty());
  expectSameAxesAndHeight(frameChanges(few, most));
  // Nearly all of the object is known by now, and the middle of its box with it.
  for (const double degrees : {350.0, 15.0}) registrar.add(duck.capture(degrees));
  const std::vector<Eigen::Isometry3d> last = frameChanges(most, registrar.result());
  ASSERT_GE(last.size(), 3u);
  expectSameAxesAndHeight(last);
  EXPECT_LT(last[0].translation().norm(), 0.002);
}

TEST(ViewRegistrationTest, LeavesTheOriginAtTheFirstView) {
  const TableView duck("duck");
  Settings settings;
  settings.training.origin = ModelOrigin::first;
  ObjectRegistrar registrar("duck", settings);
  // With more views the first three are given up again.
  for (const double degrees : {100.0, 125.0, 150.0, 175.0}) registrar.add(duck.capture(degrees));
  const RegisteredObject few = registrar.result();
  ASSERT_EQ(few.tied(), 4u);
  EXPECT_NEAR(few.model.box.min().z(), 0, 1e-6);
  const Eigen::Vector3f from_middle = few.model.box.center() - Eigen::Vector3f(0, 0, few.model.box.center().z());
  EXPECT_LT(from_middle.norm(), 0.03f);  // one view shows about a half of it
  for (const double degrees : {200.0, 225.0, 250.0, 275.0, 300.0, 325.0}) registrar.add(duck.capture(degrees));
  const std::vector<Eigen::Isometry3d> changes = frameChanges(few, registrar.result());
  ASSERT_FALSE(changes.empty());
  expectSameAxesAndHeight(changes);
  EXPECT_LT(changes[0].translation().norm(), 0.001);
}

TEST(ViewRegistrationTest, LeavesTheFrameWhereItIsWhenAnEarlierViewIsTied) {
  const TableView duck("duck");
  ObjectRegistrar registrar("duck", Settings());
  for (const double degrees : {15.0, 200.0, 225.0, 250.0}) registrar.add(duck.capture(degrees));
  const RegisteredObject before = registrar.result();
  ASSERT_FALSE(before.views[0].T_model_view);
  ASSERT_EQ(before.tied(), 3u);
  for (const double degrees : {275.0, 300.0, 325.0, 350.0}) registrar.add(duck.capture(degrees));
  const RegisteredObject after = registrar.result();
  ASSERT_TRUE(after.views[0].T_model_view);
  expectSameAxesAndHeight(frameChanges(before, after));
}

TEST(ViewRegistrationTest, TiesABodyOfRevolutionByItsAxis) {
  const TableView bowl("bowl");
  const std::vector<TrainingSample> samples = bowl.captureAround(7);
  const RegisteredObject registered = registerViews(samples, Settings()).objects.at(0);
  EXPECT_EQ(registered.tied(), 7u);
  ASSERT_TRUE(registered.symmetry);
  EXPECT_EQ(registered.symmetry->order, 0);
  EXPECT_EQ(registered.symmetry->axis, Eigen::Vector3d::UnitZ());
  const std::vector<double> degrees = degreesOf(registered);
  for (std::size_t v = 0; v < registered.views.size(); ++v) {
    const Eigen::Isometry3d T_table_model =
        bowl.T_table_camera(degrees[v]) * registered.views[v].T_model_view->inverse();
    EXPECT_LT(T_table_model.translation().norm(), 0.003);  // the foot of the axis, whatever the turn
    EXPECT_LT(std::acos(std::min(1.0, T_table_model.linear()(2, 2))), 1 * degree);
  }
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(registered.model.box.sizes()[axis], bowl.size()[axis], 0.01);
}

TEST(ViewRegistrationTest, DoesNotTakeFewViewsForABodyOfRevolution) {
  const TableView bowl("bowl");
  const RegisteredObject registered = registerViews(bowl.captureAround(4), Settings()).objects.at(0);
  EXPECT_FALSE(registered.symmetry);
  const auto [shift, turn] = bowl.spread(registered, degreesOf(registered));
  EXPECT_LT(turn, 3 * degree);  // of those that were tied, if any
  for (const RegisteredView& view : registered.views) EXPECT_EQ(bool(view.T_model_view), view.reason.empty());
}

/// Its narrow sides are alike in shape and print; the front and the back are not.
TEST(ViewRegistrationTest, TiesNoViewOfACartonByHalfATurn) {
  const TableView box("box");
  const RegisteredObject registered = registerViews(box.captureAround(12), Settings()).objects.at(0);
  EXPECT_FALSE(registered.symmetry);
  const auto [shift, turn] = box.spread(registered, degreesOf(registered));
  EXPECT_LT(shift, 0.005);
  EXPECT_LT(turn, 3 * degree);
}

/// Its handle is out of sight in a half of them, and its print alone is not believed.
TEST(ViewRegistrationTest, TiesNoViewOfAMugWrongly) {
  const TableView mug("mug");
  const RegisteredObject registered = registerViews(mug.captureAround(12), Settings()).objects.at(0);
  const auto [shift, turn] = mug.spread(registered, degreesOf(registered));
  EXPECT_LT(shift, 0.003);
  EXPECT_LT(turn, 3 * degree);
}

TEST(ViewRegistrationTest, TiesARepeatedView) {
  const TableView duck("duck");
  ObjectRegistrar registrar("duck", Settings());
  for (const double degrees : {90.0, 115.0, 140.0}) registrar.add(duck.capture(degrees));
  registrar.add(duck.capture(115, 77));
  const RegisteredObject registered = registrar.result();
  ASSERT_TRUE(registered.views[1].T_model_view && registered.views[3].T_model_view);
  const Eigen::Isometry3d between = registered.views[1].T_model_view->inverse() * *registered.views[3].T_model_view;
  EXPECT_LT(Eigen::AngleAxisd(between.linear()).angle(), 2 * degree);
  EXPECT_FALSE(registrar.sameAs(1));
  EXPECT_EQ(registrar.sameAs(3), std::optional<std::size_t>(1));
  registrar.resize(3);
  EXPECT_EQ(registrar.sources().size(), 3u);
  EXPECT_EQ(registrar.result().tied(), 3u);
}

TEST(ViewRegistrationTest, LeavesMeshesAndModelsAlone) {
  TrainingSample rendered;
  rendered.object = "thing";
  rendered.rendered = true;
  TrainingSample model;
  model.object = "thing";
  model.kind = ViewKind::model;
  EXPECT_TRUE(registerViews({rendered, model, rendered}, Settings()).objects.empty());
}

TEST(ViewRegistrationTest, RegistersWithoutPlanesOnlyWhereAsked) {
  const TableView duck("duck");
  std::vector<TrainingSample> samples = duck.captureAround(5, 0, 125);
  for (TrainingSample& sample : samples) sample.plane.reset();
  EXPECT_TRUE(registerViews(samples, Settings()).objects.empty());
  Settings settings;
  settings.training.register_views = RegisterViews::on;
  const RegisteredObject registered = registerViews(samples, settings).objects.at(0);
  EXPECT_GE(registered.tied(), 3u);
  EXPECT_FALSE(registered.on_plane);
  const auto [shift, turn] = duck.spread(registered, degreesOf(registered));
  EXPECT_LT(turn, 2 * degree);
}

TEST(ViewRegistrationTest, LeavesAViewWithoutItsPlaneAlone) {
  const TableView duck("duck");
  std::vector<TrainingSample> samples = duck.captureAround(5, 0, 125);
  samples[2].plane.reset();
  const ViewRegistration registration = registerViews(samples, Settings());
  const RegisteredObject& registered = registration.objects.at(0);
  EXPECT_GE(registered.tied(), 3u);
  EXPECT_FALSE(registered.views[2].T_model_view);
  EXPECT_EQ(registered.views[2].reason, "the plane that it stood on is not known");
  EXPECT_TRUE(registration.samples[2].frame.empty());
  EXPECT_THAT(registrationWarnings({registered}), ElementsAre(HasSubstr("duck50: the plane that it stood on is not")));
}

}  // namespace
}  // namespace sks
