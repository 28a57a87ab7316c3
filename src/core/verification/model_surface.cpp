// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/model_surface.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "core/surface/sided_cube.hpp"

namespace sks {
namespace {

ModelSurface merged(const Codebook& codebook, std::vector<std::uint32_t> views) {
  const float resolution = float(codebook.settings.training.surface_resolution);
  std::vector<std::pair<SidedCube, std::pair<std::uint32_t, std::uint32_t>>> all;  // and which point of which view
  bool colored = true;
  for (const std::uint32_t v : views) {
    const TrainingView& view = codebook.views[v];
    colored = colored && !view.surface_colors.empty();
    for (std::uint32_t i = 0; i < view.surface_points.size(); ++i) {
      all.push_back({sidedCube(view.surface_points[i], view.surface_normals[i], resolution), {v, i}});
    }
  }
  std::sort(all.begin(), all.end());
  ModelSurface surface;
  surface.resolution = resolution;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k > 0 && all[k].first == all[k - 1].first) continue;
    const auto [v, i] = all[k].second;
    const TrainingView& view = codebook.views[v];
    surface.points.push_back(view.surface_points[i]);
    surface.normals.push_back(view.surface_normals[i]);
    if (colored) surface.colors.push_back(view.surface_colors[i]);
  }
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
    const auto surface = std::make_shared<const ModelSurface>(merged(codebook, together[i]));
    for (const std::uint32_t v : together[i]) of_views[v] = surface;
  }
  return of_views;
}

}  // namespace sks
