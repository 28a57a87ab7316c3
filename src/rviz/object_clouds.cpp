// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/object_clouds.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "ros/cloud_message.hpp"

namespace sks_detector {
namespace {

constexpr int most_points = 200'000;                           // of a model; more would stop the window for seconds
constexpr float finest_spacing = 1e-4F, coarsest_spacing = 1;  // [m] of what can be drawn as squares

/// @throws sks::Error(bad_data)
ObjectCloud objectCloud(const ObjectModel& model) {
  ObjectCloud result;
  const sks::Cloud cloud = receivedCloud(model.points, most_points);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.points[i].allFinite()) continue;
    result.cloud.points.push_back(cloud.points[i]);
    if (cloud.hasColor()) result.cloud.colors.push_back(cloud.colors[i]);
  }
  if (result.cloud.points.empty()) throw sks::Error(sks::ErrorCode::bad_data, "it has no finite point");
  result.spacing = model.spacing > finest_spacing ? std::min(model.spacing, coarsest_spacing) : finest_spacing;
  return result;
}

}  // namespace

void ObjectClouds::set(const ObjectModels& message) {
  forget();
  known_ = true;
  codebook_ = message.codebook;
  for (const ObjectModel& model : message.models) {
    try {
      clouds_[{model.object, model.view}] = std::make_shared<const ObjectCloud>(objectCloud(model));
    } catch (const sks::Error& error) {
      if (problem_.empty()) problem_ = "the model of '" + sks::shown(model.object) + "' is not used: " + error.what();
    }
  }
}

void ObjectClouds::forget() {
  clouds_.clear();
  codebook_.clear();
  problem_.clear();
  known_ = false;
}

std::shared_ptr<const ObjectCloud> ObjectClouds::find(const Detection& detection) const {
  const auto found = clouds_.find({detection.object, detection.view});
  return found == clouds_.end() ? nullptr : found->second;
}

}  // namespace sks_detector
