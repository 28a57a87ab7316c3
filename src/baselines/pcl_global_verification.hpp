// SPDX-License-Identifier: BSD-3-Clause
// pcl::GlobalHypothesesVerification for points with normals, made to work. Include it in one source file only.
//
// In PCL 1.13 addModel() drops every point of a model whose normal is finite, where it means to drop the others, so
// that no hypothesis explains anything and all are rejected. It also pairs each scene point with the farthest of the
// model points that explain it, where its comment says closest. refresh() shuffles with a random device, so that
// results differ from run to run. The specialisations below are used instead of these two; the rest is PCL's.
#pragma once

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <pcl/common/time.h>
#include <pcl/point_types.h>

namespace sks::baselines {

/// Takes the place of pcl::ScopeTime, which prints on stderr how long everything took.
struct SilentScopeTime {
  explicit SilentScopeTime(const char*) {}
};

}  // namespace sks::baselines

// Before the header: where templates are not precompiled, it brings its implementation.
#define ScopeTime SilentScopeTime
namespace pcl {
using sks::baselines::SilentScopeTime;
}
#include <pcl/recognition/hv/hv_go.h>
#include <pcl/recognition/impl/hv/hv_go.hpp>
#undef ScopeTime

namespace sks::baselines {

using HvPoint = pcl::PointNormal;
using HvCloud = pcl::PointCloud<HvPoint>;

/// Shuffles the moves of simulated annealing; to be seeded before each verification.
inline thread_local std::mt19937 annealing_moves;

}  // namespace sks::baselines

namespace pcl {

template <>
void GlobalHypothesesVerification<sks::baselines::HvPoint, sks::baselines::HvPoint>::move_manager::refresh(
    mets::feasible_solution&) {
  std::shuffle(moves_m.begin(), moves_m.end(), sks::baselines::annealing_moves);
}

/// Compares a hypothesis with the scene. @param model its visible part @param complete_model all of it
template <>
bool GlobalHypothesesVerification<sks::baselines::HvPoint, sks::baselines::HvPoint>::addModel(
    PointCloud<sks::baselines::HvPoint>::ConstPtr& model, PointCloud<sks::baselines::HvPoint>::ConstPtr& complete_model,
    RecognitionModelPtr& recog_model) {
  using sks::baselines::HvCloud;
  using sks::baselines::HvPoint;
  HvCloud::Ptr thinned(new HvCloud);
  VoxelGrid<HvPoint> grid;
  grid.setLeafSize(resolution_, resolution_, resolution_);
  grid.setInputCloud(model);
  grid.filter(*thinned);
  if (thinned->empty()) return false;
  recog_model->cloud_ = thinned;
  recog_model->complete_cloud_.reset(new HvCloud(*complete_model));

  std::map<int, std::pair<float, std::size_t>> explained;  // scene point: squared distance, nearest model point
  std::vector<int> neighbors;
  std::vector<float> squared;
  for (std::size_t i = 0; i < thinned->size(); ++i) {
    if (scene_downsampled_tree_->radiusSearch((*thinned)[i], inliers_threshold_, neighbors, squared) == 0) {
      recog_model->outlier_indices_.push_back(int(i));
      continue;
    }
    for (std::size_t k = 0; k < neighbors.size(); ++k) {
      const auto entry = explained.emplace(neighbors[k], std::make_pair(squared[k], i)).first;
      entry->second = std::min(entry->second, std::make_pair(squared[k], i));
    }
  }
  for (const auto& [point, nearest] : explained) {
    const float closeness = 1 - nearest.first / (inliers_threshold_ * inliers_threshold_);
    const float alignment = (*scene_normals_)[std::size_t(point)].getNormalVector3fMap().dot(
        (*thinned)[nearest.second].getNormalVector3fMap());
    recog_model->explained_.push_back(point);
    recog_model->explained_distances_.push_back(closeness * std::max(0.f, alignment));
  }
  recog_model->bad_information_ = int(recog_model->outlier_indices_.size());
  recog_model->outliers_weight_ = regularizer_;
  return true;
}

}  // namespace pcl
