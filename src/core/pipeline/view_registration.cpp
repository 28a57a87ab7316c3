// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/registration.hpp>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/pipeline/default_stages.hpp"
#include "core/pipeline/scene_description.hpp"
#include "core/registration/captured_view.hpp"
#include "core/registration/model_fusion.hpp"
#include "core/registration/view_graph.hpp"
#include "core/registration/view_relation.hpp"
#include "core/settings/threads.hpp"

namespace sks {
namespace {

bool isCaptured(const TrainingSample& sample) {
  return sample.kind == ViewKind::view && !sample.rendered && sample.frame.empty();
}

/// Objects with their captured views, in order of their first sample.
std::vector<RegisteredObject> capturedObjects(const std::vector<TrainingSample>& samples) {
  std::vector<RegisteredObject> objects;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!isCaptured(samples[i])) continue;
    auto known = std::find_if(objects.begin(), objects.end(),
                              [&](const RegisteredObject& o) { return o.object == samples[i].object; });
    if (known == objects.end()) {
      objects.emplace_back();
      known = std::prev(objects.end());
      known->object = samples[i].object;
    }
    RegisteredView view;
    view.sample = i;
    view.source = samples[i].source;
    known->views.push_back(std::move(view));
  }
  objects.erase(std::remove_if(objects.begin(), objects.end(), [](const auto& o) { return o.views.size() < 2; }),
                objects.end());
  for (RegisteredObject& object : objects) object.frame = object.object + "#model";
  return objects;
}

/// What registration keeps of the run of stages that training has, too.
class ViewDescriber {
public:
  ViewDescriber(const Settings& settings, const Stages& stages, int threads)
      : settings_(settings), threads_(threads),
        keypoints_(stages.keypoints ? stages.keypoints : std::make_shared<const ConfiguredKeypoints>()),
        descriptors_(stages.descriptors ? stages.descriptors
                                        : std::make_shared<const ShotDescriptors>(DescriptorType::shot)) {}

  CapturedView describe(const TrainingSample& sample) const {
    const Cloud cloud = usablePoints(sample.load(), Orientation::sensor, settings_);
    Surface surface = prepareSurface(cloud, settings_.surface, Orientation::sensor, threads_);
    const Keypoints keypoints = keypoints_->detect(surface, settings_);
    const Descriptors descriptors = described(*descriptors_, surface, keypoints, settings_);
    CapturedView view(std::move(surface), keypoints, descriptors, settings_, sample.plane);
    view.source = sample.source;
    return view;
  }

private:
  const Settings& settings_;
  int threads_;
  std::shared_ptr<const KeypointStage> keypoints_;
  std::shared_ptr<const DescriptorStage> descriptors_;
};

std::vector<ViewRelation> allRelations(const std::vector<CapturedView>& views, const RegisteredObject& object,
                                       const Settings& settings, const PairLimits& limits, const Progress& progress,
                                       int threads) {
  std::vector<ViewRelation> all;
  for (std::size_t b = 1; b < views.size(); ++b) {
    report(progress, {"registering", object.object, b, views.size()});
    std::vector<std::vector<ViewRelation>> of_pairs(b);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (std::size_t a = 0; a < b; ++a) {
      of_pairs[a] = relateViews(views[a], views[b], settings, limits);
      for (ViewRelation& relation : of_pairs[a]) {
        relation.a = a;
        relation.b = b;
      }
    }
    for (const auto& relations : of_pairs) all.insert(all.end(), relations.begin(), relations.end());
  }
  return all;
}

/// Moves the origin of the model to where the settings want it.
void moveOrigin(RegisteredObject& object, std::vector<std::optional<Eigen::Isometry3d>>& poses, ModelOrigin wanted) {
  if (object.model.box.isEmpty()) return;
  const bool base = object.on_plane && wanted != ModelOrigin::center;
  Eigen::Vector3f origin = object.model.box.center();
  if (base) origin.z() = 0;
  for (auto& pose : poses) {
    if (pose) pose->pretranslate(-origin.cast<double>());
  }
  for (Eigen::Vector3f& p : object.model.points) p -= origin;
  object.model.box.translate(-origin);
}

void registerObject(RegisteredObject& object, const std::vector<TrainingSample>& samples, const ViewDescriber& describer,
                    const Settings& settings, const Progress& progress, int threads) {
  std::vector<CapturedView> views;
  for (const RegisteredView& view : object.views) {
    report(progress, {"registering", view.source, views.size(), object.views.size()});
    try {
      views.push_back(describer.describe(samples[view.sample]));
    } catch (const Error& error) {
      throw Error(error.code(), view.source + ": " + error.what());
    }
  }
  const PairLimits limits;
  const std::vector<ViewRelation> relations = allRelations(views, object, settings, limits, progress, threads);
  TiedViews tied = tieViews(views, relations, settings, limits, LoopLimits(), threads);
  object.loops = tied.loops;
  object.on_plane = tied.first && views[*tied.first].plane;
  object.model = fuseViews(views, tied.T_model_view, settings);
  moveOrigin(object, tied.T_model_view, settings.training.origin);
  for (std::size_t v = 0; v < views.size(); ++v) {
    object.views[v].T_model_view = tied.T_model_view[v];
    object.views[v].reason = tied.reasons[v];
    if (tied.T_model_view[v]) {
      object.views[v].sensor = *tied.T_model_view[v] * views[v].surface.sensor_origin.cast<double>();
    }
  }
}

}  // namespace

std::size_t RegisteredObject::tied() const {
  return std::size_t(std::count_if(views.begin(), views.end(), [](const auto& v) { return bool(v.T_model_view); }));
}

ViewRegistration registerViews(const std::vector<TrainingSample>& samples, const Settings& settings,
                               const Progress& progress, const Stages& stages) {
  validate(settings);
  const int threads = startableThreads(settings);
  const ViewDescriber describer(settings, stages, threads);
  ViewRegistration registration{samples, capturedObjects(samples)};
  for (RegisteredObject& object : registration.objects) {
    registerObject(object, samples, describer, settings, progress, threads);
    for (const RegisteredView& view : object.views) {
      if (!view.T_model_view) continue;
      TrainingSample& sample = registration.samples[view.sample];
      sample.frame = object.frame;
      sample.box = object.model.box;
      sample.T_model_source = view.T_model_view;
    }
  }
  return registration;
}

RegisteredTraining trainRegistered(const std::vector<TrainingSample>& samples, const Settings& settings,
                                   const std::string& name, const Progress& progress, const Stages& stages) {
  if (!settings.training.register_views) return {train(samples, settings, name, progress, stages), {}};
  ViewRegistration registration = registerViews(samples, settings, progress, stages);
  return {train(registration.samples, settings, name, progress, stages), std::move(registration.objects)};
}

std::vector<std::string> registrationWarnings(const std::vector<RegisteredObject>& objects) {
  std::vector<std::string> warnings;
  for (const RegisteredObject& object : objects) {
    std::string text;
    for (const RegisteredView& view : object.views) {
      if (!view.T_model_view) text += "; " + view.source + ": " + view.reason;
    }
    if (text.empty()) continue;
    warnings.push_back("object '" + object.object + "': " + std::to_string(object.tied()) + " of " +
                       std::to_string(object.views.size()) + " views share one frame" + text);
  }
  return warnings;
}

}  // namespace sks
