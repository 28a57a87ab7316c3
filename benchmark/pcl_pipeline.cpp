// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_pipeline.hpp"
#include "core/keypoints/sparse_selection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_registration.h>
#include <pcl/search/kdtree.h>

namespace sks::bench {
namespace {

/// Determinant of the covariance of the neighbours' normals in the tangent plane of `normal`.
float curvature(const pcl::PointCloud<pcl::Normal>& normals, const pcl::Indices& neighbors,
                const Eigen::Vector3f& normal) {
  const Eigen::Vector3f u = normal.unitOrthogonal(), v = normal.cross(u);
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  Eigen::Matrix2f squares = Eigen::Matrix2f::Zero();
  float count = 0;
  for (const int i : neighbors) {
    const Eigen::Vector3f n = normals[i].getNormalVector3fMap();
    if (!n.allFinite()) continue;
    const Eigen::Vector2f tangent(n.dot(u), n.dot(v));
    sum += tangent;
    squares += tangent * tangent.transpose();
    ++count;
  }
  if (count < 3) return 0;
  sum /= count;
  return (squares / count - sum * sum.transpose()).determinant();
}

}  // namespace

PclPipeline::PclPipeline(const Codebook& codebook, const Settings& settings, int threads)
    : codebook_(codebook), words_(codebook.descriptors.values()), settings_(settings), threads_(threads) {
  const flann::Matrix<float> matrix(const_cast<float*>(words_.data()), words_.rows(), words_.cols());
  index_ = std::make_unique<flann::Index<flann::ChiSquareDistance<float>>>(matrix, flann::KDTreeIndexParams(4));
  index_->buildIndex();
}

std::vector<PclPipeline::Found> PclPipeline::detect(const Points::Ptr& cloud) const {
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNumberOfThreads(unsigned(threads_));
  estimation.setInputCloud(cloud);
  estimation.setRadiusSearch(settings_.surface.normal_radius);
  const Normals::Ptr normals(new Normals);
  estimation.compute(*normals);

  const Points::Ptr keypoints = selectKeypoints(cloud, *normals);
  const Shots shots = describe(cloud, normals, keypoints);
  const std::vector<int> words = nearestWords(shots);

  std::vector<std::vector<Vote>> votes(codebook_.objects.size());
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (words[i] < 0) continue;
    const Codeword& word = codebook_.words[std::size_t(words[i])];
    const TrainingView& view = codebook_.views[word.view];
    const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> frame(shots[i].rf);
    const Eigen::Vector3f scene = (*keypoints)[i].getVector3fMap();
    const Eigen::Vector3f place = scene + frame.transpose() * word.frame * (view.center() - word.position);
    votes[view.object].push_back({place, scene, word.position});
  }
  std::vector<Found> found;
  for (std::uint32_t object = 0; object < votes.size(); ++object) {
    const auto of_object = findPoses(object, votes[object]);
    found.insert(found.end(), of_object.begin(), of_object.end());
  }
  return found;
}

PclPipeline::Points::Ptr PclPipeline::selectKeypoints(const Points::Ptr& cloud, const Normals& normals) const {
  Points grid;
  pcl::VoxelGrid<pcl::PointXYZ> voxels;
  voxels.setInputCloud(cloud);
  const float edge = float(settings_.keypoints.grid_size);
  voxels.setLeafSize(edge, edge, edge);
  voxels.filter(grid);

  pcl::search::KdTree<pcl::PointXYZ> tree(false);
  tree.setInputCloud(cloud);
  std::vector<float> curvatures(grid.size(), 0);
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads_)
  for (std::size_t i = 0; i < grid.size(); ++i) {
    pcl::Indices neighbors;
    std::vector<float> distances;
    Eigen::Vector4f plane;
    float unused = 0;
    tree.radiusSearch(grid[i], settings_.surface.normal_radius, neighbors, distances);
    if (!pcl::computePointNormal(*cloud, neighbors, plane, unused)) continue;
    tree.radiusSearch(grid[i], settings_.keypoints.grid_size, neighbors, distances);
    curvatures[i] = curvature(normals, neighbors, plane.head<3>());
  }
  std::vector<std::size_t> order(grid.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto first_kept = order.begin() + std::ptrdiff_t(settings_.keypoints.discard * double(order.size()));
  std::nth_element(order.begin(), first_kept, order.end(),
                   [&](std::size_t a, std::size_t b) { return curvatures[a] < curvatures[b]; });
  const Points::Ptr kept(new Points);
  for (auto i = first_kept; i != order.end(); ++i) kept->push_back(grid[*i]);
  return kept;
}

PclPipeline::Shots PclPipeline::describe(const Points::Ptr& cloud, const Normals::Ptr& normals,
                                         const Points::Ptr& keypoints) const {
  pcl::SHOTEstimationOMP<pcl::PointXYZ, pcl::Normal, pcl::SHOT352> estimation;
  estimation.setNumberOfThreads(unsigned(threads_));
  estimation.setInputCloud(keypoints);
  estimation.setSearchSurface(cloud);
  estimation.setInputNormals(normals);
  estimation.setRadiusSearch(settings_.descriptor.radius);
  estimation.setLRFRadius(float(settings_.descriptor.radius));
  Shots shots;
  estimation.compute(shots);
  return shots;
}

/// Index of the nearest codeword of each descriptor, -1 where there is no descriptor.
std::vector<int> PclPipeline::nearestWords(const Shots& shots) const {
  std::vector<float> queries;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (!std::isfinite(shots[i].descriptor[0])) continue;
    queries.insert(queries.end(), shots[i].descriptor, shots[i].descriptor + shot_size);
    rows.push_back(i);
  }
  std::vector<int> nearest(rows.size()), words(shots.size(), -1);
  std::vector<float> distances(rows.size());
  flann::Matrix<int> indices(nearest.data(), rows.size(), 1);
  flann::Matrix<float> squares(distances.data(), rows.size(), 1);
  flann::SearchParams search(128);
  search.cores = threads_;
  index_->knnSearch(flann::Matrix<float>(queries.data(), rows.size(), shot_size), indices, squares, 1, search);
  for (std::size_t i = 0; i < rows.size(); ++i) words[rows[i]] = nearest[i];
  return words;
}

std::vector<PclPipeline::Found> PclPipeline::findPoses(std::uint32_t object, const std::vector<Vote>& votes) const {
  const float bin = float(settings_.voting.bandwidth);
  std::map<std::tuple<int, int, int>, std::vector<std::size_t>> space;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const Eigen::Vector3f cell = (votes[i].place / bin).array().floor();
    space[{int(cell.x()), int(cell.y()), int(cell.z())}].push_back(i);
  }
  std::vector<Found> found;
  for (const auto& [cell, members] : space) {
    if (members.size() < std::size_t(std::max(3, settings_.voting.min_votes))) continue;
    const Points::Ptr model(new Points), scene(new Points);
    for (const std::size_t i : members) {
      model->push_back({votes[i].model.x(), votes[i].model.y(), votes[i].model.z()});
      scene->push_back({votes[i].scene.x(), votes[i].scene.y(), votes[i].scene.z()});
    }
    const auto registration = pcl::make_shared<pcl::SampleConsensusModelRegistration<pcl::PointXYZ>>(model);
    registration->setInputTarget(scene);
    pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(registration, settings_.ransac.inlier_threshold);
    ransac.setMaxIterations(settings_.ransac.iterations);
    if (!ransac.computeModel()) continue;
    pcl::Indices inliers;
    Eigen::VectorXf pose;
    ransac.getInliers(inliers);
    ransac.getModelCoefficients(pose);
    if (inliers.size() < std::size_t(settings_.ransac.min_inliers)) continue;
    found.push_back(
        {object, Eigen::Map<const Eigen::Matrix<float, 4, 4, Eigen::RowMajor>>(pose.data()), inliers.size()});
  }
  return found;
}

}  // namespace sks::bench
