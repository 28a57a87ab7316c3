// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/trainer.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "core/descriptors/quantizer.hpp"
#include "core/descriptors/shot.hpp"
#include "core/matching/background_words.hpp"
#include "core/pipeline/default_stages.hpp"
#include "core/pipeline/prepared_view.hpp"
#include "core/pipeline/repeated_words.hpp"
#include "core/pipeline/scene_description.hpp"
#include "core/pipeline/shared_training.hpp"
#include "core/settings/name_text.hpp"
#include "core/settings/threads.hpp"

namespace sks {
namespace {

constexpr std::size_t longest_stage_name = 100;  // of a descriptor stage
constexpr float same_place = 0.5f;               // of the keypoints' spacing: what is nearer is one place
constexpr std::size_t views_of_thread = 8;       // of meshes that are prepared before their words are added

std::shared_ptr<const DescriptorStage> trainedDescriptors(const Stages& stages, DescriptorType type) {
  if (!stages.descriptors) {
    return std::make_shared<const ShotDescriptors>(type == DescriptorType::automatic ? DescriptorType::cshot : type);
  }
  const std::string name = stages.descriptors->name();
  if (name.empty() || name.size() > longest_stage_name || name == "shot" || name == "cshot" ||
      stages.descriptors->size() == 0) {
    throw Error(ErrorCode::bad_usage, "a descriptor stage needs a size and a name of 1 to " +
                                          std::to_string(longest_stage_name) +
                                          " characters that is not shot or cshot; '" + name + "' of " +
                                          std::to_string(stages.descriptors->size()) + " values is none");
  }
  return stages.descriptors;
}

/// Of the whole object.
Eigen::AlignedBox3f boxOf(const TrainingSample& sample, const Cloud& cloud) {
  if (sample.box) return *sample.box;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : cloud.points) box.extend(p);
  return box;
}

/// Nothing of that size can be measured: its unit is another one.
void checkSize(const Eigen::AlignedBox3f& box) {
  constexpr float smallest = 0.001f;  // [m]
  if (box.sizes().maxCoeff() >= smallest) return;
  throw Error(ErrorCode::bad_data,
              "it is less than 1 mm large; are its coordinates in another unit? See `units` of the "
              "data set");
}

/// Of a mesh seen along a thin part next to nothing is in sight; its other views have to do.
bool showsTooLittle(const TrainingSample& sample, const Cloud& cloud, const Settings& settings) {
  if (!sample.rendered || !sample.box) return false;
  Eigen::AlignedBox3f seen;
  for (const Eigen::Vector3f& p : cloud.points) {
    if (p.allFinite()) seen.extend(p);
  }
  const float smallest = float(settings.surface.normal_radius);
  return sample.box->sizes().maxCoeff() >= smallest && (seen.isEmpty() || seen.sizes().maxCoeff() < smallest);
}

/// From the frame of its cloud, in which all is computed, to the model frame.
Eigen::Isometry3f motionOf(const TrainingView& view) {
  return view.T_model_source ? view.T_model_source->cast<float>() : Eigen::Isometry3f::Identity();
}

/// The view, none where it shows too little, or why it cannot be used.
struct Preparation {
  std::optional<PreparedView> view;
  std::exception_ptr failure;
};

/// Codewords under construction. Descriptors start as CSHOT under `automatic`, with their SHOT parts beside them; from
/// the first cloud without colour, or with the colours of a mesh, on they are SHOT.
class CodebookBuilder {
public:
  CodebookBuilder(const Settings& settings, const std::string& name, const Stages& stages)
      : threads_(startableThreads(settings)),
        keypoints_(stages.keypoints ? stages.keypoints : std::make_shared<const ConfiguredKeypoints>()),
        descriptors_(trainedDescriptors(stages, settings.descriptor.type)),
        rows_(descriptors_->size()),
        shot_rows_(shot_size),
        repeated_(same_place * float(settings.keypoints.grid_size)) {
    codebook_.name = name;
    codebook_.settings = settings;
    codebook_.descriptor_type = settings.descriptor.type;
    if (stages.descriptors) {
      codebook_.own_descriptor = descriptors_->name();
      codebook_.descriptor_type = DescriptorType::automatic;
    } else if (settings.descriptor.type == DescriptorType::automatic) {
      codebook_.descriptor_type = DescriptorType::cshot;
      may_drop_color_ = true;
    }
  }

  void add(const TrainingSample& sample) {
    const Cloud loaded = sample.load();
    if (showsTooLittle(sample, loaded, codebook_.settings)) return;
    if (may_drop_color_ && (sample.rendered || !loaded.hasColor())) dropColor();
    add(prepared(sample, loaded));
  }

  /// Prepares views of meshes, one in each thread: they are small, and as much work to render as to describe.
  std::vector<Preparation> prepareRendered(const TrainingSample* samples, std::size_t count) {
    if (may_drop_color_) dropColor();
    std::vector<Preparation> preparations(count);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
    for (std::size_t i = 0; i < count; ++i) {
      try {
        const Cloud loaded = samples[i].load();
        if (!showsTooLittle(samples[i], loaded, codebook_.settings))
          preparations[i].view = prepared(samples[i], loaded);
      } catch (...) {
        preparations[i].failure = std::current_exception();
      }
    }
    return preparations;
  }

  void add(Preparation preparation) {
    if (preparation.failure) std::rethrow_exception(preparation.failure);
    if (preparation.view) add(std::move(*preparation.view));
  }

  /// For another builder, which takes it with take(). Samples are to come in their order, but not all of them.
  SharedView prepareShared(const TrainingSample& sample) {
    const Cloud loaded = sample.load();
    SharedView shared;
    shared.colorless = sample.rendered || !loaded.hasColor();
    if (may_drop_color_ && shared.colorless) dropColor();
    if (showsTooLittle(sample, loaded, codebook_.settings)) return shared;
    const bool colorless = shared.colorless;
    shared = sharedView(prepared(sample, loaded));
    shared.colorless = colorless;
    return shared;
  }

  /// @param shared what another builder made of the sample
  void take(const TrainingSample& sample, SharedView shared) {
    if (may_drop_color_ && shared.colorless) dropColor();
    if (!shared.described) return;
    if (shared.cols() > 0 && shared.cols() != rows_.cols()) return add(sample);  // it did not know of a cloud before it
    add(preparedView(std::move(shared), sample));
  }

  int threads() const {
    return threads_;
  }

  bool knows(const std::string& object) const {
    return std::find(codebook_.objects.begin(), codebook_.objects.end(), object) != codebook_.objects.end();
  }

  Codebook finish() {
    codebook_.settings.descriptor.type = codebook_.descriptor_type;
    codebook_.descriptors = rows_.release();
    if (hasBackground(codebook_, codebook_.settings)) codebook_.background = backgroundDescriptors(codebook_.settings);
    return std::move(codebook_);
  }

private:
  void dropColor() {
    rows_ = std::move(shot_rows_);
    codebook_.descriptor_type = DescriptorType::shot;
    descriptors_ = std::make_shared<const ShotDescriptors>(DescriptorType::shot);
    may_drop_color_ = false;
  }

  PreparedView prepared(const TrainingSample& sample, const Cloud& loaded) const {
    const Settings& settings = codebook_.settings;
    const Orientation orientation = orientationOf(sample.kind);
    const Cloud cloud = usablePoints(loaded, orientation, settings);
    checkSize(boxOf(sample, cloud));
    const Surface surface = prepareSurface(cloud, settings.surface, orientation, threads_);
    PreparedView result{
        sample.object, sample.rendered, viewOf(sample, surface, cloud), keypoints_->detect(surface, settings), {}};
    result.descriptors = described(*descriptors_, surface, result.keypoints, settings);
    if (result.descriptors.keypoints.empty() && !sample.rendered) {
      throw Error(ErrorCode::bad_data, "none of its " + std::to_string(result.keypoints.size()) +
                                           " keypoints has a descriptor; is surface.normal_radius (" +
                                           getSetting(settings, "surface.normal_radius") +
                                           " m) or descriptor.radius (" + getSetting(settings, "descriptor.radius") +
                                           " m) below the spacing of the points?");
    }
    return result;
  }

  /// But for its object.
  TrainingView viewOf(const TrainingSample& sample, const Surface& surface, const Cloud& cloud) const {
    TrainingView view;
    view.source = sample.source;
    view.frame = sample.frame;
    view.kind = sample.kind;
    view.T_model_source = sample.T_model_source;
    const Eigen::Isometry3f T = motionOf(view);
    view.sensor_origin = T * cloud.sensor_origin;
    const Eigen::AlignedBox3f box = boxOf(sample, cloud);
    view.box_min = box.min();
    view.box_max = box.max();
    const std::vector<std::uint32_t> kept = thinnedIndices(surface, codebook_.settings.training.surface_resolution);
    view.surface_points.reserve(kept.size());  // vectors that grow hold up to twice what they need
    view.surface_normals.reserve(kept.size());
    view.surface_colors.reserve(surface.hasColor() ? kept.size() : 0);
    for (const std::uint32_t i : kept) {
      if (!surface.normal(i).allFinite()) continue;
      view.surface_points.push_back(T * surface.point(i));
      view.surface_normals.push_back(T.linear() * surface.normal(i));
      if (surface.hasColor()) view.surface_colors.push_back(surface.colorAt(i));
    }
    return view;
  }

  void add(PreparedView prepared) {
    const auto known = std::find(codebook_.objects.begin(), codebook_.objects.end(), prepared.object);
    prepared.view.object = std::uint32_t(known - codebook_.objects.begin());
    if (known == codebook_.objects.end()) codebook_.objects.push_back(prepared.object);
    const Eigen::Isometry3f T = motionOf(prepared.view);
    const Descriptors& descriptors = prepared.descriptors;
    const bool may_repeat = prepared.rendered && verifiesPoses(codebook_.settings);
    repeated_.beginView(prepared.object + "\n" + prepared.view.frame);  // two objects may have one mesh
    for (std::size_t row = 0; row < descriptors.keypoints.size(); ++row) {
      Codeword word;
      word.view = std::uint32_t(codebook_.views.size());
      word.position = T * prepared.keypoints.positions[descriptors.keypoints[row]];
      word.frame = descriptors.frames[row] * T.linear().transpose();
      const float* bins = descriptors.values.row(row);
      if (may_repeat) {
        if (repeated_.repeats(word, bins, rows_)) continue;
        repeated_.add(word, std::uint32_t(codebook_.words.size()));
      }
      addDescriptor(bins);
      codebook_.words.push_back(word);
    }
    codebook_.views.push_back(std::move(prepared.view));
  }

  void addDescriptor(const float* bins) {
    rows_.add(bins);
    if (!may_drop_color_) return;
    std::array<float, shot_size> shot;
    std::copy_n(bins, shot_size, shot.begin());
    normalize(shot.data(), shot_size);
    shot_rows_.add(shot.data());
  }

  int threads_;
  std::shared_ptr<const KeypointStage> keypoints_;
  std::shared_ptr<const DescriptorStage> descriptors_;
  bool may_drop_color_ = false;
  Codebook codebook_;
  Quantizer rows_, shot_rows_;  // the second while colour may be dropped
  RepeatedWords repeated_;      // of meshes
};

/// Runs something that works on a sample, whose source then stands in its errors.
template <typename Function>
auto onSample(const TrainingSample& sample, const Function& function) {
  try {
    return function();
  } catch (const Error& error) {
    throw Error(error.code(), sample.source + ": " + error.what());
  }
}

/// The samples by the processes of a share; those that are not the leader leave the builder as it is.
void addShared(WorkShare& share, const std::vector<TrainingSample>& samples, const Settings& settings,
               const Progress& progress, const Stages& stages, CodebookBuilder& builder) {
  std::optional<CodebookBuilder> describer;  // of the thread that works here
  dealOut<SharedView>(
      &share, samples.size(),
      [&](std::size_t i) {
        if (!describer) describer.emplace(settings, "", stages);
        return onSample(samples[i], [&] { return describer->prepareShared(samples[i]); });
      },
      [&](std::size_t i, SharedView view) { onSample(samples[i], [&] { builder.take(samples[i], std::move(view)); }); },
      [&](std::size_t done) {
        report(progress, {"training", done < samples.size() ? samples[done].source : "", done, samples.size()});
      });
}

void addHere(const std::vector<TrainingSample>& samples, const Progress& progress, CodebookBuilder& builder) {
  const std::size_t most_at_once = views_of_thread * std::size_t(builder.threads());
  std::vector<Preparation> rendered;  // from sample `first_rendered` on
  std::size_t first_rendered = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    report(progress, {"training", samples[i].source, i, samples.size()});
    onSample(samples[i], [&] {
      if (!samples[i].rendered) return builder.add(samples[i]);
      if (i >= first_rendered + rendered.size()) {
        first_rendered = i;
        std::size_t end = i;
        while (end < std::min(i + most_at_once, samples.size()) && samples[end].rendered) ++end;
        rendered = builder.prepareRendered(&samples[i], end - i);
      }
      builder.add(std::move(rendered[i - first_rendered]));
    });
  }
}

}  // namespace

Codebook train(const std::vector<TrainingSample>& samples, const Settings& settings, const std::string& name,
               const Progress& progress, const Stages& stages) {
  return train(samples, settings, name, progress, stages, nullptr);
}

Codebook train(const std::vector<TrainingSample>& samples, const Settings& settings, const std::string& name,
               const Progress& progress, const Stages& stages, WorkShare* share) {
  validate(settings);
  if (samples.empty()) throw Error(ErrorCode::bad_usage, "there is nothing to train: no training cloud was given");
  if (!name.empty()) checkName(name, "the codebook's name");
  for (const TrainingSample& sample : samples) checkName(sample.object, "the object's name");
  CodebookBuilder builder(settings, name, stages);
  if (share == nullptr) {
    addHere(samples, progress, builder);
  } else {
    addShared(*share, samples, settings, progress, stages, builder);
    if (!share->leads()) return {};
  }
  for (const TrainingSample& sample : samples) {
    if (builder.knows(sample.object)) continue;
    throw Error(ErrorCode::bad_data, sample.source + ": none of the views of '" + sample.object +
                                         "' shows more than a thin end of it; train more views");
  }
  report(progress, {"training", "", samples.size(), samples.size()});
  return builder.finish();
}

}  // namespace sks
