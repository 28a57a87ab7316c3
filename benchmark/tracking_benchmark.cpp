// SPDX-License-Identifier: BSD-3-Clause
// Five objects followed through a simulated sequence at 30 Hz, with the searches that the tracker asks for in a second
// thread. Counters: time of a cloud and CPU time of its thread [ms], median errors against the truth [mm, degrees], in
// all clouds and, beside those of a search of the whole scene, in some of them; jitter of each object that stands still
// [mm: largest standard deviation; degrees: 95 % of the turns from cloud to cloud], changes of identity, and clouds in
// which a visible object was not told, and the longest time for which one was not [s], from the arrival of the first
// search on. Turns are those modulo an object's symmetry.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include <sks_detector/background_search.hpp>
#include <sks_detector/simulation/camera_presets.hpp>
#include <sks_detector/simulation/training_views.hpp>
#include <sks_detector/tracker.hpp>

#include "simulation/builtin_objects.hpp"
#include "simulation/mesh_symmetry.hpp"
#include "simulation/sequence.hpp"

namespace sks {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double first_search = 1.0;  // [s] after which all objects should be followed
constexpr double visible = 0.5;       // share of an object from which on it should be told
constexpr double degrees = 180 / double(EIGEN_PI);
constexpr double same_place = 0.05;   // [m]
constexpr std::size_t compared = 10;  // one in so many clouds is searched as a whole, for its errors

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::size_t(share * double(values.size() - 1))];
}

double deviation(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double v : values) sum += v, squares += v * v;
  const double mean = sum / double(values.size());
  return std::sqrt(std::max(0.0, squares / double(values.size()) - mean * mean));
}

/// CPU time of this thread [ms].
double threadTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

/// Of a turn and those after which the object looks as after this one the smallest [deg].
double turnModulo(const std::optional<Symmetry>& symmetry, const Eigen::Matrix3d& turn) {
  if (symmetry && symmetry->order == 0) {
    return degrees * std::acos(std::clamp(symmetry->axis.dot(turn * symmetry->axis), -1.0, 1.0));
  }
  double smallest = 180;
  for (int k = 0, order = symmetry ? symmetry->order : 1; k < order; ++k) {
    const Eigen::AngleAxisd same(2 * EIGEN_PI * k / order, symmetry ? symmetry->axis : Eigen::Vector3d::UnitZ());
    smallest = std::min(smallest, degrees * Eigen::AngleAxisd(turn * same.toRotationMatrix()).angle());
  }
  return smallest;
}

/// All but the bowl, whose turn cannot be told.
std::vector<SceneModel> householdModels() {
  std::vector<SceneModel> models;
  for (const std::string& name : builtinNames()) {
    if (name == "bowl") continue;
    models.push_back({name, name, std::make_shared<const Mesh>(builtinObject(name))});
  }
  return models;
}

const Detection& detectionOf(const Detection& detection) {
  return detection;
}
const Detection& detectionOf(const TrackedObject& object) {
  return object.detection;
}

/// How far poses are off.
struct PoseErrors {
  void add(const Eigen::Isometry3d& error, const Eigen::Vector3d& center, const std::optional<Symmetry>& symmetry) {
    shifts.push_back(1000 * (error * center - center).norm());
    turns.push_back(turnModulo(symmetry, error.linear()));
  }
  void report(const std::string& name, benchmark::State& state) const {
    state.counters[name + "_mm"] = quantile(shifts, 0.5);
    state.counters[name + "_deg"] = quantile(turns, 0.5);
    state.counters[name + "_deg_p90"] = quantile(turns, 0.9);
  }
  std::vector<double> shifts, turns;  // [mm], [deg]
};

/// What was told, compared with the truth.
class TrackingRecord {
public:
  explicit TrackingRecord(const std::vector<SceneModel>& models) : models_(models) {
    for (const SceneModel& model : models) symmetries_.push_back(estimateSymmetry(*model.mesh));
  }

  /// @param searched whether a search has arrived yet
  void add(const SequenceFrame& frame, const std::vector<TrackedObject>& told, std::size_t pushed, bool searched) {
    for (std::size_t i = 0; i < frame.scene.objects.size(); ++i) {
      const ScenePlacement& truth = frame.scene.objects[i];
      const SceneModel& model = models_[truth.model];
      const Eigen::Vector3d center = centerOf(truth);
      const auto found = at(truth, told);
      if (found != told.end() || truth.visibility < visible || !searched) not_lost_[i] = frame.stamp;
      longest_loss_ = std::max(longest_loss_, frame.stamp - not_lost_[i]);
      if (found == told.end()) {
        if (frame.stamp > first_search && truth.visibility >= visible) ++missed_;
        continue;
      }
      const Eigen::Isometry3d error = truth.T_camera_model.inverse() * found->detection.T_scene_model;
      errors_.add(error, center, symmetries_[truth.model]);
      names_[i] = model.object;
      if (ids_.count(i) > 0 && ids_[i] != found->id) ++switches_;
      ids_[i] = found->id;
      if (i == pushed || frame.stamp < first_search) continue;
      const Eigen::Isometry3d T_table_model = frame.scene.T_table_camera * found->detection.T_scene_model;
      const Eigen::Vector3d place = T_table_model * center;
      for (int axis = 0; axis < 3; ++axis) places_[i][axis].push_back(1000 * place[axis]);
      const auto before = rotations_.find(i);
      if (before != rotations_.end()) {
        flutter_[i].push_back(turnModulo(symmetries_[truth.model], before->second.transpose() * error.linear()));
      }
      rotations_[i] = error.linear();
    }
  }

  /// Of what both have told in a cloud.
  void compare(const SequenceFrame& frame, const std::vector<TrackedObject>& told,
               const std::vector<Detection>& detections) {
    for (const ScenePlacement& truth : frame.scene.objects) {
      const auto followed = at(truth, told);
      const auto detected = at(truth, detections);
      if (followed == told.end() || detected == detections.end()) continue;
      const Eigen::Isometry3d T_model_camera = truth.T_camera_model.inverse();
      const auto& symmetry = symmetries_[truth.model];
      followed_.add(T_model_camera * followed->detection.T_scene_model, centerOf(truth), symmetry);
      detected_.add(T_model_camera * detected->T_scene_model, centerOf(truth), symmetry);
    }
  }

  void report(benchmark::State& state) const {
    errors_.report("error", state);
    followed_.report("compared", state);
    detected_.report("detector", state);
    for (const auto& [object, axes] : places_) {
      double shift = 0;
      for (const auto& [axis, values] : axes) shift = std::max(shift, deviation(values));
      state.counters[names_.at(object) + "_jitter_mm"] = shift;
    }
    for (const auto& [object, values] : flutter_) {
      state.counters[names_.at(object) + "_jitter_deg"] = quantile(values, 0.95);
    }
    state.counters["switches"] = switches_;
    state.counters["missed"] = missed_;
    state.counters["longest_loss_s"] = longest_loss_;
  }

private:
  Eigen::Vector3d centerOf(const ScenePlacement& placement) const {
    return models_[placement.model].mesh->box().center().cast<double>();
  }

  /// What was told of an object.
  template <typename Told>
  typename std::vector<Told>::const_iterator at(const ScenePlacement& truth, const std::vector<Told>& told) const {
    const Eigen::Vector3d center = centerOf(truth);
    return std::find_if(told.begin(), told.end(), [&](const Told& one) {
      const Detection& detection = detectionOf(one);
      const Eigen::Vector3d apart = detection.T_scene_model * center - truth.T_camera_model * center;
      return detection.object == models_[truth.model].object && apart.norm() < same_place;
    });
  }

  const std::vector<SceneModel>& models_;
  std::vector<std::optional<Symmetry>> symmetries_;  // of the models
  std::map<std::size_t, std::string> names_;
  PoseErrors errors_, followed_, detected_;
  std::map<std::size_t, std::map<int, std::vector<double>>> places_;  // of each object and axis
  std::map<std::size_t, Eigen::Matrix3d> rotations_;                  // errors in the last cloud
  std::map<std::size_t, std::vector<double>> flutter_;                // between successive clouds
  std::map<std::size_t, std::uint32_t> ids_;
  std::map<std::size_t, double> not_lost_;  // when each object was last told, or need not be [s]
  double longest_loss_ = 0;                 // [s]
  int switches_ = 0, missed_ = 0;
};

void follow(benchmark::State& state, bool fixed_frame) {
  const std::vector<SceneModel> models = householdModels();
  std::vector<TrainingSample> samples;
  for (const SceneModel& model : models) {
    for (const TrainingSample& sample : meshSamples(model.object, model.source, model.mesh, {}))
      samples.push_back(sample);
  }
  Settings settings;
  settings.threads = int(state.range(0));
  const auto codebook = std::make_shared<const Codebook>(train(samples, {}, "household"));
  const auto detector = std::make_shared<const Detector>(codebook, settings);
  SceneOptions scene;
  scene.distractors = 2;
  scene.region = 0.25;
  scene.max_distance = 0.95;
  scene.seed = std::uint64_t(state.range(1));
  scene.camera = cameraPreset("xtion");
  SequenceOptions options;
  options.seconds = 4;
  SimulatedSequence sequence(models, scene, options, 0);
  std::vector<SequenceFrame> frames;
  for (std::size_t i = 0; i < sequence.size(); ++i) frames.push_back(sequence.at(i));

  for (auto _ : state) {
    Tracker tracker(*detector);
    TrackingRecord record(models);
    std::vector<double> times, cpu_times;
    std::vector<std::vector<TrackedObject>> all_told;
    BackgroundSearch search;
    bool searched_once = false;
    double searching = 0;
    const Clock::time_point begin = Clock::now();
    for (const SequenceFrame& frame : frames) {
      std::this_thread::sleep_until(
          begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(frame.stamp)));
      const Clock::time_point start = Clock::now();
      const double cpu_start = threadTime();
      CloudView view{frame.stamp, {}};
      if (fixed_frame) view.T_fixed_cloud = frame.scene.T_table_camera;
      if (search.finished()) {
        search.giveTo(tracker);
        searched_once = true;
      }
      std::vector<TrackedObject> told = tracker.follow(frame.scene.view.cloud, view);
      times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
      cpu_times.push_back(threadTime() - cpu_start);
      if (!search.started() && tracker.wantsDetection(frame.stamp)) {
        const std::shared_ptr<const Cloud> cloud(std::shared_ptr<void>(), &frame.scene.view.cloud);  // kept by frames
        search.start(detector, cloud, view, tracker.occupied());
      }
      searching += search.started() ? 1 : 0;
      told.erase(std::remove_if(told.begin(), told.end(),
                                [&](const auto& o) { return o.detection.score < settings.detection.threshold; }),
                 told.end());
      record.add(frame, told, sequence.pushed(), searched_once);
      all_told.push_back(std::move(told));
    }
    for (std::size_t i = compared / 2; i < frames.size(); i += compared) {
      const DetectionResult whole = detector->detect(frames[i].scene.view.cloud);
      record.compare(frames[i], all_told[i], whole.above(settings.detection.threshold));
    }
    state.counters["p50_ms"] = quantile(times, 0.5);
    state.counters["p95_ms"] = quantile(times, 0.95);
    state.counters["cpu_p50_ms"] = quantile(cpu_times, 0.5);
    state.counters["cpu_p95_ms"] = quantile(cpu_times, 0.95);
    state.counters["searching"] = searching / double(frames.size());
    record.report(state);
  }
}

void followSequence(benchmark::State& state) {
  follow(state, true);
}

/// Where the camera's motion is not known.
void followWithoutFixedFrame(benchmark::State& state) {
  follow(state, false);
}

// Threads of the tracker, and of the search; seed of the scene.
BENCHMARK(followSequence)
    ->Args({1, 1})
    ->Args({1, 2})
    ->Args({1, 3})
    ->Args({2, 1})
    ->Args({2, 2})
    ->Args({2, 3})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(followWithoutFixedFrame)
    ->Args({1, 1})
    ->Args({1, 2})
    ->Args({1, 3})
    ->Args({1, 4})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace sks
