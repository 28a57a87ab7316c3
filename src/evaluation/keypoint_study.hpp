// SPDX-License-Identifier: BSD-3-Clause
// How well keypoints of an object are found again in scenes: section 6.2 of the paper.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sks_detector/progress.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/keypoints.hpp>

#include "core/sharing/work_share.hpp"
#include "evaluation/scene_matching.hpp"
#include "io/dataset.hpp"

namespace sks {

/// Keypoints of a cloud that have a descriptor, and how many there are in all.
struct DescribedKeypoints {
  Keypoints keypoints;
  Descriptors descriptors;
};

/// An object and a scene: what agrees between their keypoints.
struct KeypointPair {
  std::size_t object_keypoints = 0;
  std::size_t scene_keypoints = 0;
  std::size_t correspondences = 0;                  ///< reciprocal: each descriptor is the other's nearest
  std::size_t inliers = 0;                          ///< of RANSAC among them
  std::optional<Eigen::Isometry3d> T_scene_object;  ///< T_h of RANSAC; absent where it found none

  /// C_rk (eq. 5): RANSAC inliers over keypoints of the object.
  double correctFraction() const { return object_keypoints == 0 ? 0 : double(inliers) / double(object_keypoints); }
};

/// Reciprocal correspondences under chi squared, then RANSAC. Same input, same output.
KeypointPair comparePair(const DescribedKeypoints& object, const DescribedKeypoints& scene,
                         const RansacSettings& settings, int threads);

/// One of the ground truth's instances, as one kind of keypoints sees it.
struct StudiedPair {
  std::string scene;   ///< name
  std::string object;  ///< name
  KeypointPair pair;
  std::optional<double> t_diff;  ///< eq. 4: Frobenius norm of T_h - T_g, of the symmetric poses the nearest
};

/// What one kind of keypoints reached over a data set.
struct StudiedKeypoints {
  std::string name;  ///< grid, sks-50 (by the percentage that is dropped), iss
  KeypointSettings settings;
  std::vector<StudiedPair> pairs;   ///< the same, in the same order, for each kind
  std::vector<double> scene_times;  ///< keypoints of each scene [s], normals not counted; median of some runs

  double meanTime() const;  ///< [s]
};

struct KeypointStudy {
  std::string data_set;  ///< name
  Settings settings;
  std::size_t scenes = 0;               ///< that have a pair
  std::size_t skipped = 0;              ///< instances of the ground truth without a pose of a training cloud
  std::vector<StudiedKeypoints> kinds;  ///< grid, SKS, ISS

  /// Mean time of a kind over that of ISS.
  double relativeTime(const StudiedKeypoints& kind) const;
};

/// Compares grid, SKS (by the settings' selection) and ISS keypoints over every pair of a scene and an instance whose
/// pose is known. Keypoints of object and scene are chosen alike; normals, descriptors and RANSAC are the same for all.
/// @param share where given, its processes compare; only the leader's result is whole
/// @throws Error(bad_usage) for invalid settings; Error(bad_data) for a data set without pairs; errors of reading, with
///         the file; Error(cancelled)
KeypointStudy studyKeypoints(const DataSet& data_set, const Settings& settings, const Progress& progress = {},
                             WorkShare* share = nullptr);

}  // namespace sks
