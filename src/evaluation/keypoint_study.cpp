// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/keypoint_study.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/stages/surface.hpp>

#include "core/pipeline/scene_description.hpp"
#include "core/pipeline/stopwatch.hpp"
#include "core/settings/threads.hpp"
#include "core/surface/sanitize.hpp"
#include "evaluation/metrics.hpp"

namespace sks {
template <typename Archive>
void fields(Archive& archive, StudiedPair& p) {
  archive(p.scene, p.object, p.pair.object_keypoints, p.pair.scene_keypoints, p.pair.correspondences, p.pair.inliers,
          p.pair.T_scene_object, p.t_diff);
}

namespace {

constexpr std::size_t timed_runs = 5;
constexpr double long_run = 0.2;  // [s] what takes longer is timed once

KeypointStudy emptyStudy(const DataSet& data_set, const Settings& settings) {
  KeypointStudy study;
  study.data_set = data_set.name;
  study.settings = settings;
  KeypointSettings grid = settings.keypoints, iss = settings.keypoints, sks = settings.keypoints;
  sks.detector = grid.detector = KeypointDetector::grid;
  grid.selection = SelectionRule::rank;
  grid.discard = 0;
  iss.detector = KeypointDetector::iss;
  const std::string percentage = sks.selection == SelectionRule::rank ? std::to_string(std::lround(100 * sks.discard))
                                                                      : getSetting(settings, "keypoints.selection");
  study.kinds = {{"grid", grid, {}, {}}, {"sks-" + percentage, sks, {}, {}}, {"iss", iss, {}, {}}};
  return study;
}

/// What one kind of keypoints gave in one scene.
struct KindInScene {
  double seconds = 0;
  std::vector<StudiedPair> pairs;
};

template <typename Archive>
void fields(Archive& archive, KindInScene& kind) {
  archive(kind.seconds, kind.pairs);
}

/// Goes through the scenes of a data set; keeps the described training clouds.
class Study {
public:
  Study(const DataSet& data_set, const Settings& settings)
      : data_set_(data_set), threads_(startableThreads(settings)), study_(emptyStudy(data_set, settings)) {}

  KeypointStudy run(const Progress& progress, WorkShare* share) {
    const std::vector<Scene>& scenes = data_set_.scenes;
    dealOut<std::vector<KindInScene>>(
        share, scenes.size(), [&](std::size_t i) { return studyScene(scenes[i]); },
        [&](std::size_t i, std::vector<KindInScene> kinds) { take(scenes[i], std::move(kinds)); },
        [&](std::size_t done) {
          report(progress, {"comparing keypoints", done < scenes.size() ? scenes[done].name : "", done, scenes.size()});
        });
    report(progress, {"comparing keypoints", "", scenes.size(), scenes.size()});
    if (study_.scenes == 0 && (share == nullptr || share->leads())) {
      throw Error(ErrorCode::bad_data, "'" + data_set_.file +
                                           "' has no pair to compare: an object of a scene needs a "
                                           "'pose' and, as 'reference', one of the training clouds");
    }
    return std::move(study_);
  }

private:
  /// The training cloud that a pose maps; null where there is none.
  const TrainingEntry* referenceOf(const GroundTruth& truth) const {
    if (!truth.T_scene_reference) return nullptr;
    for (const TrainingEntry& entry : data_set_.training) {
      if (!entry.mesh && entry.source == truth.reference) return &entry;
    }
    return nullptr;
  }

  Surface prepare(const std::string& path, ViewKind kind) const {
    try {
      const Orientation orientation = orientationOf(kind);
      const Cloud cloud =
          sanitize(readCloud(path, data_set_.scale), sanitizingFor(orientation, study_.settings.sanitize));
      return prepareSurface(cloud, study_.settings.surface, orientation, threads_);
    } catch (const Error& error) {
      const bool named = std::string(error.what()).find(path) != std::string::npos;
      throw Error(error.code(), (named ? "" : path + ": ") + error.what());
    }
  }

  DescribedKeypoints describe(const Surface& surface, Keypoints keypoints) const {
    Descriptors descriptors =
        computeDescriptors(surface, keypoints, DescriptorType::shot, study_.settings.descriptor, threads_);
    return {std::move(keypoints), std::move(descriptors)};
  }

  /// @param seconds where given: median time of some runs, of one where that is long
  Keypoints find(const Surface& surface, const KeypointSettings& kind, double* seconds = nullptr) const {
    Settings settings = study_.settings;
    settings.keypoints = kind;
    Stopwatch stopwatch;
    Keypoints keypoints = selectedKeypoints(surface, settings);
    if (seconds == nullptr) return keypoints;
    std::vector<double> times{stopwatch.lap()};
    while (times.size() < timed_runs && times.front() < long_run) {
      selectedKeypoints(surface, settings);
      times.push_back(stopwatch.lap());
    }
    *seconds = *percentile(times, 0.5);
    return keypoints;
  }

  /// Of a training cloud, one for each kind.
  const std::vector<DescribedKeypoints>& describedObject(const TrainingEntry& entry) {
    std::vector<DescribedKeypoints>& kinds = objects_[entry.source];
    if (!kinds.empty()) return kinds;
    const Surface surface = prepare(entry.path, entry.kind);
    for (const StudiedKeypoints& kind : study_.kinds) {
      kinds.push_back(describe(surface, find(surface, kind.settings)));
    }
    return kinds;
  }

  /// One for each kind; none where there is no pair.
  std::vector<KindInScene> studyScene(const Scene& scene) {
    std::vector<std::pair<const GroundTruth*, const TrainingEntry*>> pairs;
    for (const GroundTruth& truth : scene.objects) {
      if (const TrainingEntry* reference = referenceOf(truth)) pairs.emplace_back(&truth, reference);
    }
    std::vector<KindInScene> kinds;
    if (pairs.empty()) return kinds;
    const Surface surface = prepare(scene.path, ViewKind::view);
    for (std::size_t k = 0; k < study_.kinds.size(); ++k) {
      KindInScene kind;
      const DescribedKeypoints described = describe(surface, find(surface, study_.kinds[k].settings, &kind.seconds));
      for (const auto& [truth, reference] : pairs) {
        StudiedPair pair{scene.name, truth->object, {}, {}};
        pair.pair = comparePair(describedObject(*reference)[k], described, study_.settings.ransac, threads_);
        if (pair.pair.T_scene_object) {
          pair.t_diff =
              poseError(*pair.pair.T_scene_object, *truth->T_scene_reference, truth->position, truth->symmetry).t_diff;
        }
        kind.pairs.push_back(std::move(pair));
      }
      kinds.push_back(std::move(kind));
    }
    return kinds;
  }

  void take(const Scene& scene, std::vector<KindInScene> kinds) {
    study_.skipped += scene.objects.size() - (kinds.empty() ? 0 : kinds.front().pairs.size());
    if (kinds.empty()) return;
    ++study_.scenes;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      study_.kinds[k].scene_times.push_back(kinds[k].seconds);
      for (StudiedPair& pair : kinds[k].pairs) study_.kinds[k].pairs.push_back(std::move(pair));
    }
  }

  const DataSet& data_set_;
  int threads_;
  KeypointStudy study_;
  std::map<std::string, std::vector<DescribedKeypoints>> objects_;
};

}  // namespace

double StudiedKeypoints::meanTime() const {
  return std::accumulate(scene_times.begin(), scene_times.end(), 0.0) /
         double(std::max<std::size_t>(1, scene_times.size()));
}

double KeypointStudy::relativeTime(const StudiedKeypoints& kind) const {
  return kind.meanTime() / kinds.back().meanTime();
}

KeypointStudy studyKeypoints(const DataSet& data_set, const Settings& settings, const Progress& progress,
                             WorkShare* share) {
  validate(settings);
  return Study(data_set, settings).run(progress, share);
}

}  // namespace sks
