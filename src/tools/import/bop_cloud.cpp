// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <system_error>

#include <sks_detector/error.hpp>

#include "io/image_file.hpp"
#include "tools/import/bop_files.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

/// Empty where there is no picture. One that cannot be used, such as a link to nothing, is there: reading it tells why.
std::string pictureIn(const fs::path& folder, int id) {
  const std::string stem = (folder / bopNumber(id)).string();
  for (const char* extension : {".png", ".jpg", ".jpeg", ".PNG", ".JPG", ".JPEG", ".tif", ".tiff"}) {
    std::error_code ignored;
    if (fs::symlink_status(stem + extension, ignored).type() != fs::file_type::not_found) return stem + extension;
  }
  return "";
}

}  // namespace

BopPictures findBopPictures(const fs::path& folder, int image) {
  BopPictures pictures;
  pictures.depth = pictureIn(folder / "depth", image);
  pictures.color = pictureIn(folder / "rgb", image);
  std::error_code ignored;
  pictures.complete = !pictures.depth.empty() && (!pictures.color.empty() || !fs::exists(folder / "rgb", ignored));
  return pictures;
}

Cloud readBopCloud(const BopPictures& pictures, const BopCamera& camera) {
  const DepthImage depth = readDepthImage(pictures.depth);
  const ColorImage color = pictures.color.empty() ? ColorImage() : readColorImage(pictures.color);
  const bool colored = !pictures.color.empty();
  if (colored && (color.width != depth.width || color.height != depth.height)) {
    throw Error(ErrorCode::bad_file, pictures.color + ": its size differs from that of '" + pictures.depth + "'");
  }
  Cloud cloud;
  cloud.width = std::uint32_t(depth.width);
  cloud.height = std::uint32_t(depth.height);
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
