// SPDX-License-Identifier: BSD-3-Clause
// Objects captured from twelve directions by a virtual Kinect, registered, trained and found in fifty other pictures
// from all around. Counters: views that were tied, those that are wrong (more than 5 mm or 3 degrees from where most
// put the object) and the largest errors of the others [mm, degrees]; how far the worst side of the box is off [mm];
// detections in the model frame and in frames of single views; median and 90 % of the errors of the former [mm,
// degrees], and jumps: more than 10 mm or 6 degrees. Turns are those modulo the mesh's symmetry.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include <sks_detector/detector.hpp>
#include <sks_detector/registration.hpp>
#include <sks_detector/simulation/camera_presets.hpp>

#include "core/capture/tabletop.hpp"
#include "pair.hpp"
#include "recorded_data.hpp"
#include "simulation/builtin_objects.hpp"
#include "simulation/mesh_symmetry.hpp"
#include "simulation/renderer.hpp"
#include "table_scene.hpp"

namespace sks {
namespace {

constexpr double captured_from = 0.7, captured_elevation = 35;  // [m], [deg]
constexpr int captured_views = 12, pictures = 50;
constexpr double nearest = 0.55, farthest = 0.85, lowest = 20, highest = 50;  // of the pictures [m], [deg]
constexpr double degree = double(EIGEN_PI) / 180;

// Of the recorded data, and built-in ones. New ones at the end: runs name them by their numbers.
const std::vector<std::string> object_names{
    "banana",          "cracker_box",  "mug",           "mustard_bottle", "pitcher_base", "power_drill",
    "tomato_soup_can", "builtin:duck", "builtin:drill", "builtin:box",    "builtin:mug",  "bowl"};

// What training knows.
constexpr int pictures_alone = 0, moved_camera = 1, from_mesh = 2;

struct PoseError {
  double shift = 0, turn = 0;  // [mm], at the object's middle; [deg]
  bool within(double mm, double deg) const { return shift <= mm && turn <= deg; }
};

/// A mesh of the recorded data or a built-in one, in the middle of a table.
class CapturedObject {
public:
  CapturedObject(std::string name, std::shared_ptr<const Mesh> mesh, std::uint64_t seed)
      : name_(std::move(name)), mesh_(std::move(mesh)), symmetry_(estimateSymmetry(*mesh_)), seed_(seed) {
    center_ = Eigen::Vector3d(0, 0, 0.5 * double(mesh_->box().sizes().z()));
    test::addTable(renderer_);
    renderer_.addInstance(renderer_.addMesh(mesh_), test::standingPose(*mesh_));
  }

  /// As ~capture_view takes them, a little beside even steps.
  /// @param moved it is known how the camera was moved
  std::vector<TrainingSample> capture(bool moved) {
    std::vector<TrainingSample> samples;
    for (int i = 0; i < captured_views; ++i) {
      const double turn = 360.0 * i / captured_views + 11 + between(-6, 6);
      cameras_.push_back(test::cameraAt(center_, turn, (captured_elevation + between(-3, 3)) * degree,
                                        captured_from * between(0.95, 1.05)));
      const Cloud picture = renderer_.render(camera_, cameras_.back(), picture_++, bench::threads).cloud;
      const Tabletop top = findTabletop(picture);
      TrainingSample sample;
      sample.object = name_;
      sample.source = name_ + "/" + std::to_string(i);
      sample.load = [cloud = cutOut(picture, top.objects.at(0))] { return cloud; };
      sample.plane = top.plane.cast<double>();
      if (moved) sample.T_fixed_source = cameras_.back();
      samples.push_back(std::move(sample));
    }
    return samples;
  }

  /// A picture from anywhere around; T_table_camera.
  std::pair<Cloud, Eigen::Isometry3d> picture() {
    const Eigen::Isometry3d T_table_camera =
        test::cameraAt(center_, between(0, 360), between(lowest, highest) * degree, between(nearest, farthest));
    return {renderer_.render(camera_, T_table_camera, picture_++, bench::threads).cloud, T_table_camera};
  }

  /// T_table_model by a tied view.
  Eigen::Isometry3d byView(const RegisteredView& view) const {
    return cameras_[view.sample] * view.T_model_view->inverse();
  }

  PoseError errorOf(const Eigen::Isometry3d& T_table_found, const Eigen::Isometry3d& T_table_model) const {
    const Eigen::Isometry3d error = T_table_found * T_table_model.inverse();  // z of the table and of the mesh are one
    PoseError smallest{1000 * (error * center_ - center_).norm(), 180};
    const bool upright = symmetry_ && std::abs(symmetry_->axis.z()) > 0.99;
    if (upright && symmetry_->order == 0) {
      smallest.turn = std::acos(std::clamp(error.linear()(2, 2), -1.0, 1.0)) / degree;
      return smallest;
    }
    for (int k = 0, order = upright ? symmetry_->order : 1; k < order; ++k) {
      const Eigen::AngleAxisd same(2 * EIGEN_PI * k / order, Eigen::Vector3d::UnitZ());
      smallest.turn =
          std::min(smallest.turn, Eigen::AngleAxisd(error.linear() * same.toRotationMatrix()).angle() / degree);
    }
    return smallest;
  }

  /// Of the mesh, along the axes of the model [m].
  Eigen::AlignedBox3f boxIn(const Eigen::Isometry3d& T_table_model) const {
    const Eigen::Isometry3f T_model_mesh = (T_table_model.inverse() * test::standingPose(*mesh_)).cast<float>();
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& v : mesh_->vertices) box.extend(T_model_mesh * v);
    return box;
  }

private:
  double between(double low, double high) {
    seed_ = seed_ * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * double(seed_ >> 11) / double(std::uint64_t(1) << 53);
  }

  std::string name_;
  std::shared_ptr<const Mesh> mesh_;
  std::optional<Symmetry> symmetry_;
  std::uint64_t seed_, picture_ = 1;
  CameraModel camera_ = cameraPreset("kinect");
  Renderer renderer_;
  Eigen::Vector3d center_;
  std::vector<Eigen::Isometry3d> cameras_;  // T_table_camera of the captured views
};

/// T_table_model that most views agree on.
std::optional<Eigen::Isometry3d> agreedFrame(const CapturedObject& object, const RegisteredObject& registered) {
  std::optional<Eigen::Isometry3d> agreed;
  long most = 0;
  for (const RegisteredView& view : registered.views) {
    if (!view.T_model_view) continue;
    const Eigen::Isometry3d frame = object.byView(view);
    const long alike =
        std::count_if(registered.views.begin(), registered.views.end(), [&](const RegisteredView& other) {
          return other.T_model_view && object.errorOf(object.byView(other), frame).within(5, 3);
        });
    if (alike <= most) continue;
    most = alike;
    agreed = frame;
  }
  return agreed;
}

void reportViews(const CapturedObject& object, const RegisteredObject& registered, const Eigen::Isometry3d& agreed,
                 benchmark::State& state) {
  double wrong = 0, shift = 0, turn = 0;
  for (const RegisteredView& view : registered.views) {
    if (!view.T_model_view) continue;
    const PoseError error = object.errorOf(object.byView(view), agreed);
    if (!error.within(5, 3)) {
      ++wrong;
      continue;
    }
    shift = std::max(shift, error.shift);
    turn = std::max(turn, error.turn);
  }
  state.counters["wrong"] = wrong;
  state.counters["view_mm"] = shift;
  state.counters["view_deg"] = turn;
  const Eigen::AlignedBox3f box = object.boxIn(agreed);
  const Eigen::Vector3f low = (registered.model.box.min() - box.min()).cwiseAbs();
  const Eigen::Vector3f high = (registered.model.box.max() - box.max()).cwiseAbs();
  state.counters["box_mm"] = 1000 * double(low.cwiseMax(high).maxCoeff());
}

double quantileOf(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::size_t(share * double(values.size() - 1))];
}

void capturedPoses(benchmark::State& state) {
  const std::string& name = object_names[std::size_t(state.range(0))];
  state.SetLabel(name);
  const bool builtin = name.rfind("builtin:", 0) == 0;
  const std::string path = builtin ? name : test::recordedData("meshes/" + name + "/textured.obj");
  if (path.empty()) return state.SkipWithError(("skipped: no meshes/" + name + " in SKS_DATA").c_str());
  const auto mesh = std::make_shared<const Mesh>(findMesh(path).mesh);
  for (auto _ : state) {
    CapturedObject object(name, mesh, std::uint64_t(state.range(1)));
    const std::vector<TrainingSample> captured = object.capture(state.range(2) == moved_camera);
    std::optional<Eigen::Isometry3d> agreed;
    std::string frame = name;
    auto codebook = std::make_shared<Codebook>();
    if (state.range(2) == from_mesh) {
      *codebook = train(meshSamples(name, frame, mesh, {}), {}, name);
      agreed = test::standingPose(*mesh);
    } else {
      RegisteredTraining trained = trainRegistered(captured, {}, name);
      const RegisteredObject& registered = trained.objects.at(0);
      frame = registered.frame;
      agreed = agreedFrame(object, registered);
      state.counters["tied"] = double(registered.tied());
      if (agreed) reportViews(object, registered, *agreed, state);
      *codebook = std::move(trained.codebook);
    }
    state.counters["words"] = double(codebook->words.size());

    const Detector detector(codebook);
    double found = 0, own = 0, jumps = 0;
    std::vector<double> shifts, turns;
    for (int i = 0; i < pictures; ++i) {
      const auto [cloud, T_table_camera] = object.picture();
      const std::vector<Detection> detections = detector.detect(cloud).above(Settings().detection.threshold);
      if (detections.empty()) continue;
      ++found;
      const Detection& best = detections[0];
      if (!agreed || best.view != frame) {
        ++own;
        continue;
      }
      const PoseError error = object.errorOf(T_table_camera * best.T_scene_model, *agreed);
      shifts.push_back(error.shift);
      turns.push_back(error.turn);
      jumps += error.within(10, 6) ? 0 : 1;
    }
    state.counters["found"] = found;
    state.counters["own_frame"] = own;
    state.counters["jumps"] = jumps;
    state.counters["mm"] = quantileOf(shifts, 0.5);
    state.counters["mm_p90"] = quantileOf(shifts, 0.9);
    state.counters["deg"] = quantileOf(turns, 0.5);
    state.counters["deg_p90"] = quantileOf(turns, 0.9);
  }
}

// Number of the object; seed of the directions; what training knows: pictures alone, with how the camera was moved, or
// the mesh.
BENCHMARK(capturedPoses)
    ->Apply([](benchmark::internal::Benchmark* all) {
      for (std::size_t i = 0; i < object_names.size(); ++i) {
        for (const int known : {pictures_alone, moved_camera, from_mesh}) all->Args({long(i), 1, known});
      }
    })
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace sks
