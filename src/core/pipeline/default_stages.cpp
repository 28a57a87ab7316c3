// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/default_stages.hpp"

#include <utility>

#include <sks_detector/error.hpp>

#include "core/keypoints/sparse_selection.hpp"

namespace sks {

Keypoints ConfiguredKeypoints::detect(const Surface& surface, const Settings& settings) const {
  return detectKeypoints(surface, settings.keypoints, threadCount(settings));
}

Keypoints ConfiguredKeypoints::select(const Surface& surface, Keypoints keypoints, const Settings& settings) const {
  const bool selects = settings.keypoints.detector == KeypointDetector::grid &&
                       (settings.keypoints.selection != SelectionRule::rank || settings.keypoints.discard > 0);
  if (!selects) return keypoints;
  measureCurvature(surface, keypoints, settings.keypoints, settings.surface, threadCount(settings));
  return selectKeypoints(keypoints, settings.keypoints);
}

std::string ShotDescriptors::name() const {
  return EnumNames<DescriptorType>::value[std::size_t(type_)];
}

std::size_t ShotDescriptors::size() const {
  return descriptorSize(type_);
}

Descriptors ShotDescriptors::describe(const Surface& surface, const Keypoints& keypoints,
                                      const Settings& settings) const {
  return computeDescriptors(surface, keypoints, type_, settings.descriptor, threadCount(settings));
}

Stages completed(Stages stages, const Codebook& codebook) {
  if (!stages.keypoints) stages.keypoints = std::make_shared<const ConfiguredKeypoints>();
  if (!stages.descriptors && codebook.own_descriptor.empty()) {
    stages.descriptors = std::make_shared<const ShotDescriptors>(codebook.descriptor_type);
  }
  const std::string trained = "the codebook '" + codebook.name + "' holds descriptors '" + codebook.descriptorName() +
                              "' of " + std::to_string(codebook.descriptorSize()) + " values";
  const std::string remedy = ": use the stages that it was trained with, or train again";
  if (!stages.descriptors) {
    throw Error(ErrorCode::incompatible, trained + ", which are of a stage that is not there" + remedy);
  }
  const bool same_size = codebook.words.empty() || stages.descriptors->size() == codebook.descriptorSize();
  if (stages.descriptors->name() != codebook.descriptorName() || !same_size) {
    throw Error(ErrorCode::incompatible, trained + ", but scenes are described by '" + stages.descriptors->name() +
                                             "' of " + std::to_string(stages.descriptors->size()) + " values" + remedy);
  }
  return stages;
}

Descriptors described(const DescriptorStage& stage, const Surface& surface, const Keypoints& keypoints,
                      const Settings& settings) {
  Descriptors descriptors = stage.describe(surface, keypoints, settings);
  const std::size_t rows = descriptors.keypoints.size();
  bool sound = descriptors.frames.size() == rows && descriptors.values.rows() == rows &&
               (rows == 0 || descriptors.values.cols() == stage.size());
  for (const std::uint32_t keypoint : descriptors.keypoints) sound = sound && keypoint < keypoints.size();
  if (!sound) {
    throw Error(ErrorCode::bad_data, "the descriptor stage '" + stage.name() + "' gave " +
                                         std::to_string(descriptors.values.rows()) + " descriptors of " +
                                         std::to_string(descriptors.values.cols()) + " values and " +
                                         std::to_string(descriptors.frames.size()) + " frames for " +
                                         std::to_string(rows) + " of " + std::to_string(keypoints.size()) +
                                         " keypoints; it says that a descriptor has " + std::to_string(stage.size()));
  }
  return descriptors;
}

bool verifiesPoses(const Settings& settings) {
  return settings.detection.hypotheses == Hypotheses::verified;
}

double ambiguityOf(const Settings& settings) {
  return verifiesPoses(settings) ? settings.matching.ambiguity : 1.0;
}

bool hasBackground(const Codebook& codebook, const Settings& settings) {
  const bool shot = codebook.own_descriptor.empty() && codebook.descriptor_type == DescriptorType::shot;
  return shot && verifiesPoses(settings) && settings.matching.background;
}

bool skipsPlanes(const Settings& settings) {
  return verifiesPoses(settings) && settings.keypoints.skip_planes;
}

}  // namespace sks
