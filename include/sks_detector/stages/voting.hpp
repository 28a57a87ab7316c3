// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/matching.hpp>

namespace sks {

/// One correspondence's vote for an object's centre (eq. 1, 2).
struct Vote {
  Eigen::Vector3f position;  ///< of the object's box centre in the scene [m]
  Eigen::Matrix3f rotation;  ///< R = R_s^T R_t, model to scene
  Eigen::Vector3f keypoint;  ///< p_s [m], scene frame
  std::uint32_t word;        ///< index into Codebook::words
  float distance;            ///< chi squared distance of the match
  float weight = 1;          ///< of the match
};

/// One Hough space per object: votes[object], in the order of the matches.
/// @param keypoints positions that `descriptors.keypoints` refers to
std::vector<std::vector<Vote>> castVotes(const Codebook& codebook, const std::vector<Match>& matches,
                                         const Descriptors& descriptors, const Keypoints& keypoints);

}  // namespace sks
