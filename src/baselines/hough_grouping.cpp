// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hough_grouping.hpp"

#include <algorithm>

#include <pcl/registration/correspondence_rejection_sample_consensus.h>

#include "baselines/hough_space.hpp"

namespace sks::baselines {
namespace {

constexpr int ransac_iterations = 10000;  // PCL's

Eigen::Vector3f axis(const float (&values)[3]) {
  return {values[0], values[1], values[2]};
}

/// Where each keypoint sees the model's centroid, in its own frame.
std::vector<Eigen::Vector3f> centroidVectors(const FramedKeypoints& model) {
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();
  for (const pcl::PointXYZ& p : *model.positions) centroid += p.getVector3fMap();
  centroid /= float(model.positions->size());
  std::vector<Eigen::Vector3f> vectors;
  for (std::size_t i = 0; i < model.positions->size(); ++i) {
    const Eigen::Vector3f offset = centroid - (*model.positions)[i].getVector3fMap();
    const pcl::ReferenceFrame& frame = (*model.frames)[i];
    vectors.emplace_back(axis(frame.x_axis).dot(offset), axis(frame.y_axis).dot(offset),
                         axis(frame.z_axis).dot(offset));
  }
  return vectors;
}

/// Where each correspondence takes the model's centroid to be in the scene.
std::vector<Eigen::Vector3d> votesOf(const FramedModel& model, const FramedKeypoints& scene) {
  const std::vector<Eigen::Vector3f> vectors = centroidVectors(model.keypoints);
  std::vector<Eigen::Vector3d> votes;
  for (const pcl::Correspondence& pair : *model.correspondences) {
    const Eigen::Vector3f& v = vectors[std::size_t(pair.index_query)];
    const pcl::ReferenceFrame& frame = (*scene.frames)[std::size_t(pair.index_match)];
    const Eigen::Vector3f position = (*scene.positions)[std::size_t(pair.index_match)].getVector3fMap();
    const Eigen::Vector3f vote =
        axis(frame.x_axis) * v.x() + axis(frame.y_axis) * v.y() + axis(frame.z_axis) * v.z() + position;
    votes.push_back(vote.cast<double>());
  }
  return votes;
}

HoughSpace filledSpace(const FramedModel& model, const FramedKeypoints& scene, const HoughParameters& parameters) {
  const std::vector<Eigen::Vector3d> votes = votesOf(model, scene);
  float farthest = 0;
  for (const pcl::Correspondence& pair : *model.correspondences) farthest = std::max(farthest, pair.distance);
  const bool weigh = parameters.weigh && parameters.interpolate && farthest > 0;  // as PCL
  HoughSpace space(votes, parameters.bin_size);
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const double weight = weigh ? 1.0 - (*model.correspondences)[i].distance / farthest : 1.0;
    if (parameters.interpolate) {
      space.voteInterpolated(votes[i], weight, int(i));
    } else {
      space.vote(votes[i], weight, int(i));
    }
  }
  return space;
}

}  // namespace

std::vector<pcl::Correspondences> houghClusters(const FramedModel& model, const FramedKeypoints& scene,
                                                const HoughParameters& parameters) {
  if (model.correspondences->empty()) return {};
  pcl::registration::CorrespondenceRejectorSampleConsensus<pcl::PointXYZ> rejector;
  rejector.setMaximumIterations(ransac_iterations);
  rejector.setInlierThreshold(parameters.bin_size);
  rejector.setInputSource(model.keypoints.positions);
  rejector.setInputTarget(scene.positions);
  std::vector<pcl::Correspondences> clusters;
  for (const std::vector<int>& voters : filledSpace(model, scene, parameters).maxima(parameters.threshold)) {
    pcl::Correspondences members;
    for (const int i : voters) members.push_back((*model.correspondences)[std::size_t(i)]);
    rejector.getRemainingCorrespondences(members, clusters.emplace_back());
  }
  return clusters;
}

Grouping houghGrouping(const TombariSettings& settings) {
  return [=](const FramedModel& model, const FramedKeypoints& scene) {
    const HoughParameters parameters{settings.bin_size, settings.votes, settings.interpolate, settings.weigh};
    return groupsOf(houghClusters(model, scene, parameters), model, scene, settings.bin_size);
  };
}

}  // namespace sks::baselines
