// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include <sks_detector/error.hpp>

#include "io/image_file.hpp"
#include "tools/import/bop_files.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

/// The image of that number with any of the extensions that BOP sets have; of these the first one where there is none.
std::string imageFile(const fs::path& folder, int id) {
  const std::string stem = (folder / bopNumber(id)).string();
  for (const char* extension : {".png", ".jpg", ".tif"}) {
    if (fs::is_regular_file(stem + extension)) return stem + extension;
  }
  return stem + ".png";
}

}  // namespace

Cloud readBopCloud(const fs::path& folder, const BopImage& image) {
  const std::string depth_file = imageFile(folder / "depth", image.id),
                    color_file = imageFile(folder / "rgb", image.id);
  if (!fs::is_regular_file(depth_file)) {
    throw Error(ErrorCode::bad_file, "cannot read the depth image '" + depth_file + "'");
  }
  const DepthImage depth = readDepthImage(depth_file);
  const ColorImage color = fs::is_regular_file(color_file) ? readColorImage(color_file) : ColorImage();
  const bool colored = !color.pixels.empty();
  if (colored && (color.width != depth.width || color.height != depth.height)) {
    throw Error(ErrorCode::bad_file, color_file + ": its size differs from that of '" + depth_file + "'");
  }
  Cloud cloud;
  cloud.width = std::uint32_t(depth.width);
  cloud.height = std::uint32_t(depth.height);
  const BopCamera& camera = image.camera;
  for (int row = 0; row < depth.height; ++row) {
    for (int column = 0; column < depth.width; ++column) {
      double z = camera.depth_scale * depth(row, column);
      if (z == 0) z = std::numeric_limits<double>::quiet_NaN();  // nothing was measured
      cloud.points.emplace_back(float(z * (column - camera.cx) / camera.fx), float(z * (row - camera.cy) / camera.fy),
                                float(z));
    }
  }
  cloud.colors = color.pixels;
  return cloud;
}

}  // namespace sks::tools
