// SPDX-License-Identifier: BSD-3-Clause
// pcl::ism::ImplicitShapeModelEstimation on descriptors that are there already. Include it in one source file only.
//
// PCL turns votes by a keypoint's normal, with two angles that are not taken one after the other, so that they do not
// follow when an object is turned. Here they turn with the local reference frame. PCL's k-means starts from the time of
// day, and distances to its centers take minutes; here it is seeded evenly, and uses matrix products. These functions
// are specialised; learning, voting and peaks are PCL's.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <pcl/features/feature.h>
#include <pcl/point_types.h>
#include <pcl/recognition/implicit_shape_model.h>

#include <sks_detector/stages/descriptors.hpp>

namespace sks::baselines {

using ShapeHistogram = pcl::Histogram<int(shot_size)>;
using ShapeModelEstimation = pcl::ism::ImplicitShapeModelEstimation<int(shot_size), pcl::PointXYZ, pcl::Normal>;

/// A keypoint as PCL passes it along: the frame's third axis as normal, the first one and the row of its descriptor in
/// what is left of the point.
inline pcl::Normal describedNormal(const Eigen::Matrix3f& frame, std::uint32_t row) {
  pcl::Normal normal(frame(2, 0), frame(2, 1), frame(2, 2));
  normal.data_c[0] = float(row);
  for (int i = 0; i < 3; ++i) normal.data_c[i + 1] = frame(0, i);
  return normal;
}

/// The center that is nearest to each point, both one a row.
inline std::vector<Eigen::Index> nearestCenters(const Eigen::MatrixXf& points, const Eigen::MatrixXf& centers) {
  // |p - c|^2 without |p|^2, which is the same for all centers
  const Eigen::VectorXf squared = centers.rowwise().squaredNorm();
  const Eigen::MatrixXf distances = (-2 * points * centers.transpose()).rowwise() + squared.transpose();
  std::vector<Eigen::Index> nearest(std::size_t(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) distances.row(i).minCoeff(&nearest[std::size_t(i)]);
  return nearest;
}

/// Looks descriptors up, of which the shape part is used.
class StoredDescriptors : public pcl::FeatureFromNormals<pcl::PointXYZ, pcl::Normal, ShapeHistogram> {
public:
  StoredDescriptors() {
    feature_name_ = "StoredDescriptors";
    setKSearch(1);
  }
  void setRows(const DescriptorMatrix& rows) { rows_ = rows; }

protected:
  void computeFeature(pcl::PointCloud<ShapeHistogram>& output) override {
    for (std::size_t i = 0; i < output.size(); ++i) {
      const float* row = rows_.row(std::size_t((*normals_)[i].data_c[0]));
      std::copy(row, row + shot_size, output[i].histogram);
    }
  }

private:
  DescriptorMatrix rows_;
};

}  // namespace sks::baselines

namespace pcl {
namespace ism {

template <>
Eigen::Matrix3f sks::baselines::ShapeModelEstimation::alignYCoordWithNormal(const Normal& normal) {
  const Eigen::Vector3f z = normal.getNormalVector3fMap(), x(normal.data_c[1], normal.data_c[2], normal.data_c[3]);
  Eigen::Matrix3f frame;
  frame << x.transpose(), z.cross(x).transpose(), z.transpose();
  return frame;
}

template <>
double sks::baselines::ShapeModelEstimation::computeKMeansClustering(const Eigen::MatrixXf& points, int clusters,
                                                                     Eigen::MatrixXi& labels, TermCriteria criteria,
                                                                     int, int, Eigen::MatrixXf& centers) {
  const Eigen::Index count = points.rows();
  centers.resize(clusters, points.cols());
  for (int i = 0; i < clusters; ++i) centers.row(i) = points.row(Eigen::Index(i) * count / clusters);
  labels.resize(count, 1);
  for (int round = 0; round < criteria.max_count_; ++round) {
    const std::vector<Eigen::Index> nearest = sks::baselines::nearestCenters(points, centers);
    for (Eigen::Index i = 0; i < count; ++i) labels(i, 0) = int(nearest[std::size_t(i)]);
    Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(clusters, points.cols());
    std::vector<int> members(std::size_t(clusters), 0);
    for (Eigen::Index i = 0; i < count; ++i) {
      sums.row(labels(i, 0)) += points.row(i);
      ++members[std::size_t(labels(i, 0))];
    }
    for (int i = 0; i < clusters; ++i) {
      if (members[std::size_t(i)] > 0) centers.row(i) = sums.row(i) / float(members[std::size_t(i)]);
    }
  }
  return 0;  // how compact the clusters are, which no one asks for
}

/// The votes for one class; keypoints are taken as they come.
template <>
features::ISMVoteList<PointXYZ>::Ptr sks::baselines::ShapeModelEstimation::findObjects(
    // PCL's signature. NOLINTNEXTLINE(performance-unnecessary-value-param)
    ISMModelPtr model, PointCloud<PointXYZ>::Ptr keypoints, PointCloud<Normal>::Ptr normals, int wanted_class) {
  features::ISMVoteList<PointXYZ>::Ptr votes(new features::ISMVoteList<PointXYZ>);
  PointCloud<sks::baselines::ShapeHistogram>::Ptr histograms(new PointCloud<sks::baselines::ShapeHistogram>);
  if (keypoints->empty()) return votes;
  estimateFeatures(keypoints, normals, histograms);
  Eigen::MatrixXf descriptors(Eigen::Index(histograms->size()), Eigen::Index(sks::shot_size));
  for (std::size_t i = 0; i < histograms->size(); ++i) {
    descriptors.row(Eigen::Index(i)) =
        Eigen::Map<const Eigen::RowVectorXf>((*histograms)[i].histogram, Eigen::Index(sks::shot_size));
  }
  const std::vector<Eigen::Index> clusters = sks::baselines::nearestCenters(descriptors, model->clusters_centers_);
  for (std::size_t i = 0; i < keypoints->size(); ++i) {
    const Eigen::Matrix3f to_scene = alignYCoordWithNormal((*normals)[i]).transpose();
    const auto cluster = std::size_t(clusters[i]);
    for (const unsigned int word : model->clusters_[cluster]) {
      if (int(model->classes_[word]) != wanted_class) continue;
      InterestPoint vote;
      vote.getVector3fMap() = (*keypoints)[i].getVector3fMap() +
                              to_scene * model->directions_to_center_.row(Eigen::Index(word)).transpose();
      vote.strength = model->statistical_weights_[std::size_t(wanted_class)][cluster] * model->learned_weights_[word];
      if (vote.strength > 0) votes->addVote(vote, (*keypoints)[i], wanted_class);
    }
  }
  return votes;
}

}  // namespace ism
}  // namespace pcl

#include <pcl/recognition/impl/implicit_shape_model.hpp>
