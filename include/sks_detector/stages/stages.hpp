// SPDX-License-Identifier: BSD-3-Clause
// The stages that a user can exchange: train() and Detector take them. What is not exchanged is what the settings say.
// One instance may be used by several threads at once: all methods are const and must be thread-safe. Detections are
// deterministic where the stages are. What a stage throws comes out of train() and Detector::detect(); use Error.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/hypothesis.hpp>
#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/scene.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Where a surface is described.
class KeypointStage {
public:
  virtual ~KeypointStage();

  /// All keypoints of a training cloud or scene.
  /// @return finite positions in the frame of the surface [m]; normals and curvature may be empty
  virtual Keypoints detect(const Surface& surface, const Settings& settings) const = 0;

  /// Those of a scene that are worth describing. Default: all.
  /// @param keypoints of detect() @return if it gives normals and curvature, then one for each position
  virtual Keypoints select(const Surface& surface, Keypoints keypoints, const Settings& settings) const;
};

/// What the surface around a keypoint looks like. Training and detection need the same one.
class DescriptorStage {
public:
  virtual ~DescriptorStage();

  /// By which a codebook knows what it was trained with: at most 100 characters, not "shot" or "cshot".
  virtual std::string name() const = 0;

  /// Values of one descriptor, at least 1.
  virtual std::size_t size() const = 0;

  /// Keypoints that cannot be described are left out.
  /// @return size() columns of finite values of at least 0 (they are compared by chi squared), and for each row a local
  ///         reference frame: a rotation matrix whose rows are the axes x, y, z. From these come the votes (eq. 1, 2)
  virtual Descriptors describe(const Surface& surface, const Keypoints& keypoints, const Settings& settings) const = 0;
};

/// From votes to the poses that are believed.
class VerifierStage {
public:
  virtual ~VerifierStage();

  /// Hypotheses from the votes. Default: the maxima of each Hough space (mean shift, eq. 3) that pass RANSAC (section
  /// 3.2), strongest first within each object.
  virtual std::vector<Hypothesis> propose(const SceneDescription& scene, const Codebook& codebook,
                                          const Settings& settings) const;

  /// Keeps those that the scene confirms; may move poses (T_scene_model and T_scene_box together) and set their
  /// evidence.
  /// @param proposed by propose()
  /// @return object and view are indices into the codebook
  virtual std::vector<Hypothesis> verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                         const Codebook& codebook, const Settings& settings) const = 0;

  /// Confidence in [0, 1] of a verified hypothesis, comparable across scenes. Default: by the density of its inliers'
  /// votes, 0.5 at `detection.half_density`.
  virtual double score(const Hypothesis& hypothesis, const Settings& settings) const;
};

/// The stages of a user's own; null stands for the one that the settings ask for.
struct Stages {
  std::shared_ptr<const KeypointStage> keypoints;      ///< else `keypoints.detector` and its selection
  std::shared_ptr<const DescriptorStage> descriptors;  ///< else SHOT or CSHOT, `descriptor.type`
  std::shared_ptr<const VerifierStage> verifier;       ///< of detection; else as `verification` and `refinement` say
};

}  // namespace sks
