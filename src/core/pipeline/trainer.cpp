// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/trainer.hpp>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>

#include "core/descriptors/shot.hpp"
#include "core/pipeline/default_stages.hpp"
#include "core/pipeline/scene_description.hpp"
#include "core/settings/name_text.hpp"
#include "core/settings/threads.hpp"

namespace sks {
namespace {

constexpr std::size_t longest_stage_name = 100;  // of a descriptor stage

/// Numbers that grow in place: a vector would copy them from time to time, and hold them twice meanwhile. Large blocks
/// are moved by the kernel, page by page.
class GrowingValues {
public:
  void append(const float* values, std::size_t count) {
    if (size_ + count > capacity_) reserve(std::max(size_ + count, capacity_ + capacity_ / 2));
    std::copy_n(values, count, data_.get() + size_);
    size_ += count;
  }
  float* at(std::size_t index) { return data_.get() + index; }
  void shrinkTo(std::size_t size) { size_ = size; }
  /// Leaves nothing here.
  DescriptorMatrix release(std::size_t cols) {
    if (size_ > 0) reserve(size_);
    const std::shared_ptr<const float> owner(data_.release(), std::free);
    return DescriptorMatrix(owner.get(), size_ / cols, cols, owner);
  }

private:
  void reserve(std::size_t capacity) {
    void* moved = std::realloc(data_.get(), capacity * sizeof(float));
    if (moved == nullptr) throw std::bad_alloc();
    static_cast<void>(data_.release());  // realloc() has freed it
    data_.reset(static_cast<float*>(moved));
    capacity_ = capacity;
  }

  struct Free {
    void operator()(float* data) const { std::free(data); }
  };
  std::unique_ptr<float, Free> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

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

/// Codewords under construction. Descriptors start as CSHOT under `automatic`; from the first cloud without colour, or
/// with the colours of a mesh, on they are SHOT, and what was there is cut down to its SHOT part.
class CodebookBuilder {
public:
  CodebookBuilder(const Settings& settings, const std::string& name, const Stages& stages)
      : threads_(startableThreads(settings)),
        keypoints_(stages.keypoints ? stages.keypoints : std::make_shared<const ConfiguredKeypoints>()),
        descriptors_(trainedDescriptors(stages, settings.descriptor.type)) {
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
    const Settings& settings = codebook_.settings;
    const Orientation orientation = orientationOf(sample.kind);
    const Cloud loaded = sample.load();
    if (showsTooLittle(sample, loaded, settings)) return;
    const Cloud cloud = usablePoints(loaded, orientation, settings);
    checkSize(boxOf(sample, cloud));
    if (may_drop_color_ && (sample.rendered || !cloud.hasColor())) dropColor();

    const Surface surface = prepareSurface(cloud, settings.surface, orientation, threads_);
    const Keypoints keypoints = keypoints_->detect(surface, settings);
    const Descriptors descriptors = described(*descriptors_, surface, keypoints, settings);
    if (descriptors.keypoints.empty() && !sample.rendered) {
      throw Error(ErrorCode::bad_data, "none of its " + std::to_string(keypoints.size()) +
                                           " keypoints has a descriptor; is surface.normal_radius (" +
                                           getSetting(settings, "surface.normal_radius") +
                                           " m) or descriptor.radius (" + getSetting(settings, "descriptor.radius") +
                                           " m) below the spacing of the points?");
    }
    addView(sample, surface, cloud);
    addWords(keypoints, descriptors, codebook_.views.back());
  }

  bool knows(const std::string& object) const {
    return std::find(codebook_.objects.begin(), codebook_.objects.end(), object) != codebook_.objects.end();
  }

  Codebook finish() {
    codebook_.settings.descriptor.type = codebook_.descriptor_type;
    codebook_.descriptors = values_.release(descriptors_->size());
    return std::move(codebook_);
  }

private:
  void dropColor() {
    for (std::size_t row = 0; row < codebook_.words.size(); ++row) {
      std::copy_n(values_.at(row * cshot_size), shot_size, values_.at(row * shot_size));
      normalize(values_.at(row * shot_size), shot_size);
    }
    values_.shrinkTo(codebook_.words.size() * shot_size);
    codebook_.descriptor_type = DescriptorType::shot;
    descriptors_ = std::make_shared<const ShotDescriptors>(DescriptorType::shot);
    may_drop_color_ = false;
  }

  void addView(const TrainingSample& sample, const Surface& surface, const Cloud& cloud) {
    TrainingView view;
    const auto known = std::find(codebook_.objects.begin(), codebook_.objects.end(), sample.object);
    view.object = std::uint32_t(known - codebook_.objects.begin());
    if (known == codebook_.objects.end()) codebook_.objects.push_back(sample.object);
    view.source = sample.source;
    view.frame = sample.frame;
    view.kind = sample.kind;
    view.T_model_source = sample.T_model_source;
    const Eigen::Isometry3f T = motionOf(view);
    view.sensor_origin = T * cloud.sensor_origin;
    const Eigen::AlignedBox3f box = boxOf(sample, cloud);
    view.box_min = box.min();
    view.box_max = box.max();
    for (const std::uint32_t i : thinnedIndices(surface, codebook_.settings.training.surface_resolution)) {
      if (!surface.normal(i).allFinite()) continue;
      view.surface_points.push_back(T * surface.point(i));
      view.surface_normals.push_back(T.linear() * surface.normal(i));
      if (surface.hasColor()) view.surface_colors.push_back(surface.colorAt(i));
    }
    codebook_.views.push_back(std::move(view));
  }

  void addWords(const Keypoints& keypoints, const Descriptors& descriptors, const TrainingView& view) {
    const Eigen::Isometry3f T = motionOf(view);
    const DescriptorMatrix& rows = descriptors.values;
    values_.append(rows.data(), rows.rows() * rows.cols());
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      Codeword word;
      word.view = std::uint32_t(codebook_.views.size() - 1);
      word.position = T * keypoints.positions[descriptors.keypoints[row]];
      word.frame = descriptors.frames[row] * T.linear().transpose();
      codebook_.words.push_back(word);
    }
  }

  int threads_;
  std::shared_ptr<const KeypointStage> keypoints_;
  std::shared_ptr<const DescriptorStage> descriptors_;
  bool may_drop_color_ = false;
  Codebook codebook_;
  GrowingValues values_;
};

}  // namespace

Codebook train(const std::vector<TrainingSample>& samples, const Settings& settings, const std::string& name,
               const Progress& progress, const Stages& stages) {
  validate(settings);
  if (samples.empty()) throw Error(ErrorCode::bad_usage, "there is nothing to train: no training cloud was given");
  if (!name.empty()) checkName(name, "the codebook's name");
  for (const TrainingSample& sample : samples) checkName(sample.object, "the object's name");
  CodebookBuilder builder(settings, name, stages);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    report(progress, {"training", samples[i].source, i, samples.size()});
    try {
      builder.add(samples[i]);
    } catch (const Error& error) {
      throw Error(error.code(), samples[i].source + ": " + error.what());
    }
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
