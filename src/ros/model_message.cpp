// SPDX-License-Identifier: BSD-3-Clause
#include "ros/model_message.hpp"

#include <algorithm>
#include <memory>
#include <set>

#include <sks_detector/stages/surface.hpp>

#include "core/surface/color_space.hpp"
#include "core/verification/model_surface.hpp"
#include "ros/cloud_message.hpp"

namespace sks_detector {
namespace {

constexpr double finest_spacing = 0.005;      // [m] of points that are shown
constexpr double coarser = 1.4;               // next spacing to one that leaves too many points: about half of them
constexpr int most_spacings = 40;             // to that of 3500 m
constexpr std::size_t most_points = 3000;     // of a model
constexpr std::size_t most_in_all = 500'000;  // of all models
constexpr std::size_t fewest_points = 50;     // of a model, however many there are

/// What was seen of an object in the frame of a view.
sks::Cloud surfaceOf(const sks::Codebook& codebook, const sks::TrainingView& view, const sks::ModelSurface& seen) {
  sks::Cloud cloud;
  if (const sks::RegisteredModel* model = codebook.modelOf(view)) {
    cloud.points = model->surface.points;
    cloud.colors = model->surface.colors;
    return cloud;
  }
  cloud.points = seen.points;
  for (const Eigen::Vector3f& color : seen.colors) {
    cloud.colors.push_back(sks::fromScaledLab({color.x(), color.y(), color.z()}));
  }
  return cloud;
}

/// At most so many points, as evenly spaced as they can be. @param spacing becomes theirs [m]
sks::Cloud shownPart(const sks::Cloud& surface, std::size_t most, double& spacing) {
  sks::Cloud part;
  spacing = finest_spacing;
  for (int i = 0; i < most_spacings; ++i, spacing *= coarser) {
    part = sks::thin(surface, spacing);
    if (part.size() <= most) break;
  }
  return part;
}

}  // namespace

ObjectModels toModels(const sks::Codebook& codebook, const std::string& name) {
  ObjectModels message;
  message.codebook = name;
  const auto surfaces = sks::modelSurfaces(codebook);
  const std::size_t count = std::set<std::shared_ptr<const sks::ModelSurface>>(surfaces.begin(), surfaces.end()).size();
  const std::size_t most = std::clamp(most_in_all / std::max<std::size_t>(count, 1), fewest_points, most_points);
  for (std::size_t v = 0; v < surfaces.size(); ++v) {
    if (surfaces[v]->views.front() != v) continue;  // a model stands once, at the first of its views
    const sks::TrainingView& view = codebook.views[v];
    ObjectModel model;
    model.object = codebook.objects[view.object];
    model.view = view.frameName();
    double spacing = 0;
    model.points = toMessage(shownPart(surfaceOf(codebook, view, *surfaces[v]), most, spacing), std_msgs::Header());
    model.spacing = float(spacing);
    message.models.push_back(model);
  }
  return message;
}

}  // namespace sks_detector
