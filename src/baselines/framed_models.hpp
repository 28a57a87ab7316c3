// SPDX-License-Identifier: BSD-3-Clause
// Matches as PCL's grouping classes take them.
#pragma once

#include <cstdint>
#include <vector>

#include <pcl/correspondence.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/scene.hpp>

namespace sks::baselines {

/// Keypoints with their local reference frames.
struct FramedKeypoints {
  pcl::PointCloud<pcl::PointXYZ>::Ptr positions{new pcl::PointCloud<pcl::PointXYZ>};
  pcl::PointCloud<pcl::ReferenceFrame>::Ptr frames{new pcl::PointCloud<pcl::ReferenceFrame>};

  void add(const Eigen::Vector3f& position, const Eigen::Matrix3f& frame);
  Eigen::Vector3d position(int i) const { return (*positions)[std::size_t(i)].getVector3fMap().cast<double>(); }
};

/// The matched codewords of the training views that share one model frame: only their positions can be compared with
/// each other. A view without a shared frame is a model by itself.
///
/// Each correspondence has a keypoint of its own, even where several lead to one codeword: PCL's RANSAC identifies
/// correspondences by the model's keypoint and would mix those up.
struct FramedModel {
  std::uint32_t object = 0;
  std::vector<std::uint32_t> words;  ///< of each keypoint: index into Codebook::words
  FramedKeypoints keypoints;
  pcl::CorrespondencesPtr correspondences{new pcl::Correspondences};  ///< to the rows of the scene's descriptors
};

/// Sorts the matches of scenes by model. Immutable once built.
class FramedModels {
public:
  explicit FramedModels(const Codebook& codebook);

  /// Models with at least three matches, in order of their first training view.
  std::vector<FramedModel> matched(const Codebook& codebook, const std::vector<Match>& matches) const;

private:
  std::vector<std::uint32_t> model_of_view_;
  std::size_t count_ = 0;
};

/// The described keypoints of a scene, one for each row of its descriptors.
FramedKeypoints describedKeypoints(const SceneDescription& scene);

}  // namespace sks::baselines
