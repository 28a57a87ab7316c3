// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/to_detection.hpp"

#include <string>

#include <sks_detector/error.hpp>

#include "core/verification/pose_information.hpp"

namespace sks {

Detection toDetection(const Codebook& codebook, const Hypothesis& hypothesis, double score) {
  if (hypothesis.object >= codebook.objects.size() || hypothesis.view >= codebook.views.size()) {
    throw Error(ErrorCode::bad_data, "the verifier gave a hypothesis of object " + std::to_string(hypothesis.object) +
                                         ", view " + std::to_string(hypothesis.view) + ", which the codebook '" +
                                         codebook.name + "' does not hold");
  }
  Detection detection;
  detection.object = codebook.objects[hypothesis.object];
  detection.score = score;
  detection.view = codebook.views[hypothesis.view].frameName();
  detection.T_scene_model = hypothesis.T_scene_model;
  detection.T_scene_box = hypothesis.T_scene_box;
  detection.box_size = hypothesis.box_size;
  detection.covariance = covarianceInScene(hypothesis.covariance, hypothesis.T_scene_model,
                                           codebook.views[hypothesis.view].center().cast<double>());
  detection.density = hypothesis.density;
  detection.evidence = hypothesis.evidence;
  detection.votes = hypothesis.votes;
  detection.inliers = std::uint32_t(hypothesis.inliers.size());
  return detection;
}

}  // namespace sks
