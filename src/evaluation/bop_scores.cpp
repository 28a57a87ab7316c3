// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/bop_scores.hpp"

#include <algorithm>
#include <limits>

#include <sks_detector/cloud_io.hpp>

#include "evaluation/average_recall.hpp"
#include "evaluation/depth_rendering.hpp"
#include "evaluation/shared_scoring.hpp"
#include "evaluation/surface_distance.hpp"
#include "evaluation/visible_surface.hpp"

namespace sks {

template <typename Archive>
void fields(Archive& archive, RecallCount& count) {
  archive(count.targets, count.found);
}

namespace {

constexpr double least_visible = 0.1;                               // fraction of a target's surface
constexpr double usual_image_width = 640;                           // that thresholds in pixels are meant for
constexpr int threshold_steps = 10;                                 // from one step up
constexpr double fraction_step = 0.05;                              // of the diameter, or of the visible pixels
constexpr double pixel_step = 5;                                    // of a usual image
constexpr double unlike = std::numeric_limits<double>::infinity();  // error of a pose in another frame

std::vector<double> stepsOf(double step) {
  std::vector<double> steps;
  for (int i = 1; i <= threshold_steps; ++i) steps.push_back(i * step);
  return steps;
}

/// The three errors of an object over the scenes; those that some of its targets lack do not count.
struct ObjectCounts {
  RecallCount vsd, mssd, mspd;
  bool has_vsd = true, has_mssd = true, has_mspd = true;
  std::size_t targets = 0;
  std::string shortcoming;

  void lacksAll(const std::string& reason) {
    has_mssd = false;
    lacksPicture(reason);
  }
  void lacksPicture(const std::string& reason) {
    has_mspd = false;
    lacksSurface(reason);
  }
  void lacksSurface(const std::string& reason) {
    has_vsd = false;
    if (shortcoming.empty()) shortcoming = reason;
  }

  void add(const ObjectCounts& other) {
    targets += other.targets;
    if (!has_mssd) return;  // nothing can be taken
    vsd.add(other.vsd);
    mssd.add(other.mssd);
    mspd.add(other.mspd);
    has_vsd = has_vsd && other.has_vsd;
    has_mssd = has_mssd && other.has_mssd;
    has_mspd = has_mspd && other.has_mspd;
    if (shortcoming.empty()) shortcoming = other.shortcoming;
  }
};

struct NamedCounts {
  std::string object;
  ObjectCounts counts;
};

template <typename Archive>
void fields(Archive& archive, NamedCounts& named) {
  ObjectCounts& c = named.counts;
  archive(named.object, c.vsd, c.mssd, c.mspd, c.has_vsd, c.has_mssd, c.has_mspd, c.targets, c.shortcoming);
}

/// A true or found pose of a model.
struct PosedModel {
  const ObjectModel* model;
  Eigen::Isometry3d T_scene_model;
  DepthMap depth;  // empty without a mesh or a camera
};

/// The targets of one object in one scene, and as many of its best detections.
struct Instances {
  std::vector<const GroundTruth*> targets;
  std::vector<const Detection*> found;
};

std::map<std::string, Instances> instancesOf(const Scene& scene, const std::vector<MatchedDetection>& found) {
  std::map<std::string, Instances> result;
  for (const GroundTruth& truth : scene.objects) {
    if (truth.visibility.value_or(1) < least_visible || isIgnored(scene, truth.object)) continue;
    result[truth.object].targets.push_back(&truth);
  }
  for (const MatchedDetection& matched : found) {
    const auto wanted = result.find(matched.detection.object);
    if (wanted == result.end() || wanted->second.found.size() == wanted->second.targets.size()) continue;
    wanted->second.found.push_back(&matched.detection);
  }
  return result;
}

/// Takes the errors of one object in one scene.
class SceneErrors {
public:
  SceneErrors(const std::optional<SceneDepth>& depth, ModelCache& models) : depth_(depth), models_(models) {}

  void add(const std::string& scene, const Instances& instances, ObjectCounts& counts) const {
    counts.targets += instances.targets.size();
    if (!counts.has_mssd) return;  // nothing can be taken
    std::vector<PosedModel> truths, found;
    std::string reason;
    for (const GroundTruth* truth : instances.targets) {
      const ObjectModel* model = models_.find(truth->T_scene_reference ? truth->reference : "", reason);
      if (model == nullptr) return counts.lacksAll(reason);
      truths.push_back(posed(model, *truth->T_scene_reference));
    }
    for (const Detection* detection : instances.found) {
      const bool same_frame =
          std::any_of(instances.targets.begin(), instances.targets.end(),
                      [&](const GroundTruth* truth) { return truth->reference == detection->view; });
      if (!same_frame) {
        return counts.lacksAll("in scene '" + scene + "' it was found in the frame of '" + detection->view +
                               "', which is not that of its ground truth");
      }
      found.push_back(posed(models_.find(detection->view, reason), detection->T_scene_model));
    }
    if (!depth_) counts.lacksPicture("the cloud of scene '" + scene + "' is not organised as a pinhole camera sees it");
    for (const PosedModel& truth : truths) {
      if (truth.model->triangles.empty()) counts.lacksSurface("it is trained from points: VSD needs a mesh");
    }
    count(truths, found, counts);
  }

private:
  PosedModel posed(const ObjectModel* model, const Eigen::Isometry3d& pose) const {
    const bool drawn = depth_ && !model->triangles.empty();
    return {model, pose, drawn ? renderDepth(*model, pose, depth_->camera) : DepthMap()};
  }

  /// Errors of each found pose to each true one; of a row of tables where an error has several values.
  template <typename Error>
  static std::vector<ErrorTable> tables(const std::vector<PosedModel>& truths, const std::vector<PosedModel>& found,
                                        std::size_t values, Error error) {
    std::vector<ErrorTable> result(values, ErrorTable(found.size(), std::vector<double>(truths.size(), unlike)));
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (std::size_t k = 0; k < truths.size(); ++k) {
        if (found[i].model != truths[k].model) continue;
        const std::vector<double> errors = error(found[i], truths[k]);
        for (std::size_t v = 0; v < values; ++v) result[v][i][k] = errors[v];
      }
    }
    return result;
  }

  static RecallCount counted(const std::vector<ErrorTable>& tables, std::size_t targets, double step) {
    RecallCount all;
    for (const ErrorTable& table : tables) {
      const RecallCount count = countRecall(table, targets, stepsOf(step));
      all.targets = targets;
      all.found.insert(all.found.end(), count.found.begin(), count.found.end());
    }
    return all;
  }

  void count(const std::vector<PosedModel>& truths, const std::vector<PosedModel>& found, ObjectCounts& counts) const {
    const auto distance = [](const PosedModel& a, const PosedModel& b) {
      return std::vector<double>{surfaceDistance(*b.model, a.T_scene_model, b.T_scene_model) / b.model->diameter};
    };
    const auto projected = [&](const PosedModel& a, const PosedModel& b) {
      const double pixels = projectionDistance(*b.model, depth_->camera, a.T_scene_model, b.T_scene_model);
      return std::vector<double>{pixels * usual_image_width / depth_->camera.width};
    };
    const auto visible = [&](const PosedModel& a, const PosedModel& b) {
      return visibleSurfaceDiscrepancy(a.depth, b.depth, *depth_, stepsOf(fraction_step * b.model->diameter));
    };
    const std::size_t targets = truths.size();
    if (counts.has_mssd) counts.mssd.add(counted(tables(truths, found, 1, distance), targets, fraction_step));
    if (counts.has_mspd) counts.mspd.add(counted(tables(truths, found, 1, projected), targets, pixel_step));
    if (counts.has_vsd) {
      counts.vsd.add(counted(tables(truths, found, threshold_steps, visible), targets, fraction_step));
    }
  }

  const std::optional<SceneDepth>& depth_;
  ModelCache& models_;
};

BopRecall recallOf(const ObjectCounts& counts) {
  BopRecall recall;
  recall.targets = counts.targets;
  const auto average = [](bool has, const RecallCount& count) {
    return has && count.targets > 0 ? std::optional<double>(count.average()) : std::nullopt;
  };
  recall.vsd = average(counts.has_vsd, counts.vsd);
  recall.mssd = average(counts.has_mssd, counts.mssd);
  recall.mspd = average(counts.has_mspd, counts.mspd);
  const bool same = counts.vsd.targets == counts.mssd.targets && counts.mssd.targets == counts.mspd.targets;
  if (recall.vsd && recall.mssd && recall.mspd && same) recall.ar = (*recall.vsd + *recall.mssd + *recall.mspd) / 3;
  return recall;
}

}  // namespace

BopScores bopScores(const DataSet& data_set, const std::vector<std::vector<MatchedDetection>>& found,
                    const ModelLoader& loader, int threads, const Progress& progress) {
  return bopScores(data_set, found, loader, threads, progress, nullptr);
}

BopScores bopScores(const DataSet& data_set, const std::vector<std::vector<MatchedDetection>>& found,
                    const ModelLoader& loader, int threads, const Progress& progress, WorkShare* share) {
  const std::vector<Scene>& scenes = data_set.scenes;
  ModelCache models(data_set, loader);
  const auto countsIn = [&](std::size_t i) {
    std::vector<NamedCounts> counts;
    const std::map<std::string, Instances> instances = instancesOf(scenes[i], found[i]);
    if (instances.empty()) return counts;
    std::optional<SceneDepth> depth;
    if (models.any()) depth = sceneDepth(readCloud(scenes[i].path, data_set.scale), threads);
    const SceneErrors errors(depth, models);
    for (const auto& [object, group] : instances) {
      counts.push_back({object, {}});
      errors.add(scenes[i].name, group, counts.back().counts);
    }
    return counts;
  };
  std::map<std::string, ObjectCounts> objects;
  dealOut<std::vector<NamedCounts>>(
      share, scenes.size(), countsIn,
      [&](std::size_t, const std::vector<NamedCounts>& counts) {
        for (const NamedCounts& named : counts) objects[named.object].add(named.counts);
      },
      [&](std::size_t done) {
        report(progress, {"taking BOP errors", done < scenes.size() ? scenes[done].name : "", done, scenes.size()});
      });
  report(progress, {"taking BOP errors", "", scenes.size(), scenes.size()});
  BopScores scores;
  ObjectCounts total;
  for (const auto& [name, counts] : objects) {
    scores.objects[name] = recallOf(counts);
    if (!counts.shortcoming.empty()) scores.shortcomings[name] = counts.shortcoming;
    total.targets += counts.targets;
    if (counts.has_vsd) total.vsd.add(counts.vsd);
    if (counts.has_mssd) total.mssd.add(counts.mssd);
    if (counts.has_mspd) total.mspd.add(counts.mspd);
  }
  scores.total = recallOf(total);
  return scores;
}

}  // namespace sks
