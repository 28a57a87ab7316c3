// SPDX-License-Identifier: BSD-3-Clause
// The results of detection and classification as bytes.
#pragma once

#include <sks_detector/detection.hpp>

#include "core/pipeline/classifier.hpp"

namespace sks {

template <typename Archive>
void fields(Archive& archive, Detection& d) {
  archive(d.object, d.score, d.view, d.T_scene_model, d.T_scene_box, d.box_size, d.covariance, d.density, d.evidence,
          d.votes, d.inliers);
}

template <typename Archive>
void fields(Archive& archive, StageTimes& t) {
  archive(t.sanitize, t.normals, t.keypoints, t.descriptors, t.matching, t.voting, t.verification, t.total);
}

template <typename Archive>
void fields(Archive& archive, StageCounts& c) {
  archive(c.input_points, c.points, c.grid_keypoints, c.keypoints, c.descriptors, c.votes, c.hypotheses);
}

template <typename Archive>
void fields(Archive& archive, DetectionResult& result) {
  archive(result.detections, result.times, result.counts);
}

template <typename Archive>
void fields(Archive& archive, Classification::Candidate& candidate) {
  archive(candidate.object, candidate.score);
}

template <typename Archive>
void fields(Archive& archive, Classification& result) {
  archive(result.candidates, result.times, result.counts);
}

}  // namespace sks
