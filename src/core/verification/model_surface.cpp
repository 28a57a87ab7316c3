// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/model_surface.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/surface/color_space.hpp"
#include "core/surface/sided_cube.hpp"

namespace sks {
namespace {

using PointOfView = std::pair<std::uint32_t, std::uint32_t>;  // which view, and which of its points

struct HashOfCube {
  std::size_t operator()(const SidedCube& cube) const {
    const auto [x, y, z, side] = cube;
    constexpr std::uint64_t spread = 0x9e3779b97f4a7c15;  // odd, and its bits look random
    std::uint64_t hash = 0;
    for (const std::int64_t part : {std::int64_t(x), std::int64_t(y), std::int64_t(z), std::int64_t(side)}) {
      hash = (hash ^ std::uint64_t(part)) * spread;
      hash ^= hash >> 32;
    }
    return std::size_t(hash);
  }
};

/// One point of the views in each cube: that of the first view that has any.
ModelSurface merged(const Codebook& codebook, const std::vector<std::uint32_t>& views) {
  const float resolution = float(codebook.settings.training.surface_resolution);
  std::unordered_map<SidedCube, PointOfView, HashOfCube> first;  // that lies in each cube
  bool colored = true;
  for (const std::uint32_t v : views) {
    const TrainingView& view = codebook.views[v];
    colored = colored && !view.surface_colors.empty();
    for (std::uint32_t i = 0; i < view.surface_points.size(); ++i) {
      first.try_emplace(sidedCube(view.surface_points[i], view.surface_normals[i], resolution), PointOfView{v, i});
    }
  }
  std::vector<std::pair<SidedCube, PointOfView>> all(first.begin(), first.end());
  std::sort(all.begin(), all.end());  // few of many: most points of the views share their cubes
  ModelSurface surface;
  for (const auto& [cube, point] : all) {
    const auto [v, i] = point;
    const TrainingView& view = codebook.views[v];
    surface.points.push_back(view.surface_points[i]);
    surface.normals.push_back(view.surface_normals[i]);
    if (colored) surface.colors.push_back(view.surface_colors[i]);
  }
  return surface;
}

/// Of captured views: averaged over all of them. The colours of single views are a patchwork of their light and shade.
ModelSurface averaged(const FusedModel& model) {
  ModelSurface surface;
  surface.points = model.points;
  surface.normals = model.normals;
  for (const Rgb& color : model.colors) {
    const std::array<float, 3> lab = toScaledLab(color);
    surface.colors.emplace_back(lab[0], lab[1], lab[2]);
  }
  return surface;
}

ModelSurface surfaceOf(const Codebook& codebook, std::vector<std::uint32_t> views) {
  const RegisteredModel* model = codebook.modelOf(codebook.views[views.front()]);
  const bool fused = model != nullptr && !model->surface.points.empty();
  ModelSurface surface = fused ? averaged(model->surface) : merged(codebook, views);
  surface.resolution = float(codebook.settings.training.surface_resolution);
  if (views.size() > 1) surface.body = findBodyAxis(surface.points, surface.normals);
  for (const std::uint32_t v : views) {
    const TrainingView& view = codebook.views[v];
    surface.centers.push_back(view.center());
    surface.directions.push_back((view.sensor_origin - view.center()).stableNormalized());
  }
  surface.views = std::move(views);
  return surface;
}

}  // namespace

std::vector<std::shared_ptr<const ModelSurface>> modelSurfaces(const Codebook& codebook, int threads) {
  std::map<std::pair<std::uint32_t, std::string>, std::vector<std::uint32_t>> frames;
  for (std::uint32_t v = 0; v < codebook.views.size(); ++v) {
    frames[{codebook.views[v].object, codebook.views[v].frameName()}].push_back(v);
  }
  std::vector<std::vector<std::uint32_t>> together;
  for (auto& [frame, views] : frames) together.push_back(std::move(views));
  std::vector<std::shared_ptr<const ModelSurface>> of_views(codebook.views.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < together.size(); ++i) {
    const auto surface = std::make_shared<const ModelSurface>(surfaceOf(codebook, together[i]));
    for (const std::uint32_t v : together[i]) of_views[v] = surface;
  }
  return of_views;
}

}  // namespace sks
