// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>

#include <sks_detector/trainer.hpp>

#include "core/settings/value_text.hpp"

namespace sks {
namespace {

// Largest and second extent of an object in edges of a cell of keypoints.grid_size: below the first it is hardly found,
// at the second it is (measured with coloured objects of 30 and 50 mm).
constexpr double fewest_cells[] = {3, 1}, wanted_cells[] = {5, 1.5};
constexpr double flattest = 0.012;  // [m] what rises less above a plane has no keypoints of its own
constexpr double hidden = 0.005;    // [m] and what rises less than this is hidden by the noise of an RGB-D camera
constexpr double smallest = 0.02;   // [m] two extents of a thing that stands alone: else too few points

struct ObjectSize {
  Eigen::Vector3d extents = Eigen::Vector3d::Zero();  // in all its views, the largest first [m]
  bool whole = true;   // its boxes are those of the whole object; a view of its front alone looks flat
  int registered = 0;  // views that share a frame: from two on it is found as what stands alone, too
};

std::vector<ObjectSize> sizesOf(const Codebook& codebook) {
  std::vector<ObjectSize> sizes(codebook.objects.size());
  for (const TrainingView& view : codebook.views) {
    ObjectSize& size = sizes[view.object];
    size.extents = size.extents.cwiseMax(view.extent().cast<double>());
    size.whole = size.whole && (view.kind == ViewKind::model || !view.frame.empty());
    size.registered += view.frame.empty() ? 0 : 1;
  }
  for (ObjectSize& size : sizes) std::sort(size.extents.data(), size.extents.data() + 3, std::greater<>());
  return sizes;
}

std::string inMillimetres(const Eigen::Vector3d& extents) {
  std::string text;
  for (const double extent : {extents[0], extents[1], extents[2]}) {
    text += (text.empty() ? "" : " x ") + toText(std::round(10000 * extent) / 10);
  }
  return text + " mm";
}

/// A length in whole millimetres.
std::string setting(double metres) {
  return toText(std::max(0.001, std::floor(1000 * metres) / 1000));
}

}  // namespace

std::vector<std::string> trainingWarnings(const Codebook& codebook) {
  const Settings& settings = codebook.settings;
  const std::vector<ObjectSize> sizes = sizesOf(codebook);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Eigen::Vector3d& extents = sizes[i].extents;
    const double grid = settings.keypoints.grid_size;
    const bool stands_alone = sizes[i].registered > 1 && extents[1] >= smallest;
    const std::string object = "object '" + codebook.objects[i] + "' is " + inMillimetres(extents) + " large, ";
    if (sizes[i].whole && extents[2] < hidden) {
      warnings.push_back(object + "so flat that the noise of an RGB-D camera hides it on a table");
    } else if (std::min(extents[0] / fewest_cells[0], extents[1] / fewest_cells[1]) < grid) {
      const double finer = std::min(extents[0] / wanted_cells[0], extents[1] / wanted_cells[1]), factor = finer / grid;
      const std::string effect = stands_alone ? "so small that it is found only where it stands alone on a plane"
                                              : "which is too small for these settings";
      warnings.push_back(object + effect + "; set keypoints.grid_size=" + setting(finer) +
                         ", descriptor.radius=" + setting(factor * settings.descriptor.radius) +
                         " and surface.normal_radius=" + setting(factor * settings.surface.normal_radius) +
                         ", or check its unit");
    } else if (extents[2] < flattest && settings.keypoints.skip_planes && sizes[i].whole) {
      const std::string effect = stands_alone ? "so flat that it is found only where it lies alone on a plane"
                                              : "so flat that it counts as a part of what it lies on";
      warnings.push_back(object + effect + "; set keypoints.skip_planes=false");
    }
  }
  return warnings;
}

}  // namespace sks
