// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/registration.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/pipeline/shared_training.hpp"
#include "core/registration/model_fusion.hpp"
#include "core/registration/model_views.hpp"

namespace sks {
template <typename Archive>
void fields(Archive& archive, RegisteredView& v) {
  archive(v.sample, v.source, v.T_model_view, v.reason, v.sensor);
}

template <typename Archive>
void fields(Archive& archive, LoopErrors& e) {
  archive(e.loops, e.median_shift, e.largest_shift, e.median_angle, e.largest_angle);
}

template <typename Archive>
void fields(Archive& archive, Rgb& color) {
  archive(color.r, color.g, color.b);
}

template <typename Archive>
void fields(Archive& archive, FusedModel& model) {
  archive(model.points, model.normals, model.colors, model.box);
}

template <typename Archive>
void fields(Archive& archive, Symmetry& symmetry) {
  archive(symmetry.axis, symmetry.order);
}

template <typename Archive>
void fields(Archive& archive, RegisteredObject& o) {
  archive(o.object, o.frame, o.views, o.on_plane, o.loops, o.model, o.symmetry);
}

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
  return objects;
}

/// Of some of its views; the registrar leaves the others alone.
bool planesKnown(const RegisteredObject& object, const std::vector<TrainingSample>& samples) {
  return std::any_of(object.views.begin(), object.views.end(),
                     [&](const RegisteredView& view) { return bool(samples[view.sample].plane); });
}

void registerObject(RegisteredObject& object, const std::vector<TrainingSample>& samples, const Settings& settings,
                    const Progress& progress, const Stages& stages) {
  ObjectRegistrar registrar(object.object, settings, stages);
  std::vector<std::size_t> indices;
  for (const RegisteredView& view : object.views) {
    report(progress, {"registering", view.source, indices.size(), object.views.size()});
    registrar.add(samples[view.sample]);
    indices.push_back(view.sample);
  }
  object = registrar.result();
  for (RegisteredView& view : object.views) view.sample = indices[view.sample];
}

void registerShared(WorkShare& share, std::vector<RegisteredObject>& objects,
                    const std::vector<TrainingSample>& samples, const Settings& settings, const Progress& progress,
                    const Stages& stages) {
  const std::vector<RegisteredObject> unregistered = objects;
  dealOut<RegisteredObject>(
      &share, objects.size(),
      [&](std::size_t i) {
        RegisteredObject object = unregistered[i];
        registerObject(object, samples, settings, {}, stages);
        return object;
      },
      [&](std::size_t i, RegisteredObject object) { objects[i] = std::move(object); },
      [&](std::size_t done) {
        report(progress, {"registering", done < objects.size() ? unregistered[done].object : "", done, objects.size()});
      });
  std::string bytes = share.leads() ? bytesOf(objects) : "";
  share.spread(bytes);
  objects = fromBytes<std::vector<RegisteredObject>>(bytes);
}

/// After the last view of each object come those of its model, so that codebooks trained apart can be joined.
std::vector<TrainingSample> withModelSamples(std::vector<TrainingSample> samples,
                                             const std::vector<RegisteredObject>& objects, const Settings& settings) {
  std::vector<TrainingSample> all;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    all.push_back(std::move(samples[i]));
    for (const RegisteredObject& object : objects) {
      if (object.views.back().sample != i) continue;
      for (TrainingSample& sample : modelSamples(object, settings)) all.push_back(std::move(sample));
    }
  }
  return all;
}

/// Puts the models of the objects into the codebook, which knows all of them.
void addModels(RegisteredTraining& trained) {
  Codebook& codebook = trained.codebook;
  for (const RegisteredObject& object : trained.objects) {
    if (object.model.points.empty()) continue;
    const auto known = std::find(codebook.objects.begin(), codebook.objects.end(), object.object);
    codebook.models.push_back({std::uint32_t(known - codebook.objects.begin()), object.frame,
                               thinnedModel(object.model, codebook.settings.training.surface_resolution),
                               object.symmetry});
  }
}

}  // namespace

ViewRegistration registerViews(const std::vector<TrainingSample>& samples, const Settings& settings,
                               const Progress& progress, const Stages& stages) {
  return registerViews(samples, settings, progress, stages, nullptr);
}

ViewRegistration registerViews(const std::vector<TrainingSample>& samples, const Settings& settings,
                               const Progress& progress, const Stages& stages, WorkShare* share) {
  validate(settings);
  ViewRegistration registration{samples, capturedObjects(samples)};
  if (settings.training.register_views != RegisterViews::on) {
    std::vector<RegisteredObject>& objects = registration.objects;
    objects.erase(std::remove_if(objects.begin(), objects.end(),
                                 [&](const RegisteredObject& object) { return !planesKnown(object, samples); }),
                  objects.end());
  }
  if (share != nullptr) registerShared(*share, registration.objects, samples, settings, progress, stages);
  for (RegisteredObject& object : registration.objects) {
    if (share == nullptr) registerObject(object, samples, settings, progress, stages);
    for (const RegisteredView& view : object.views) {
      if (!view.T_model_view) continue;
      TrainingSample& sample = registration.samples[view.sample];
      sample.frame = object.frame;
      sample.box = object.model.box;
      sample.T_model_source = view.T_model_view;
    }
  }
  registration.samples = withModelSamples(std::move(registration.samples), registration.objects, settings);
  return registration;
}

RegisteredTraining trainRegistered(const std::vector<TrainingSample>& samples, const Settings& settings,
                                   const std::string& name, const Progress& progress, const Stages& stages) {
  return trainRegistered(samples, settings, name, progress, stages, nullptr);
}

RegisteredTraining trainRegistered(const std::vector<TrainingSample>& samples, const Settings& settings,
                                   const std::string& name, const Progress& progress, const Stages& stages,
                                   WorkShare* share) {
  if (settings.training.register_views == RegisterViews::off) {
    return {train(samples, settings, name, progress, stages, share), {}};
  }
  ViewRegistration registration = registerViews(samples, settings, progress, stages, share);
  RegisteredTraining trained{train(registration.samples, settings, name, progress, stages, share),
                             std::move(registration.objects)};
  if (share == nullptr || share->leads()) addModels(trained);
  return trained;
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
