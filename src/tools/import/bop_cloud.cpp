// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include <opencv2/imgcodecs.hpp>

#include <sks_detector/error.hpp>

#include "tools/import/bop_files.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

/// The image of that number with any of the extensions that BOP sets have; empty where there is none.
cv::Mat readImage(const fs::path& folder, int id, int flags, std::string& path) {
  for (const char* extension : {".png", ".jpg", ".tif"}) {
    path = (folder / (bopNumber(id) + extension)).string();
    if (fs::is_regular_file(path)) return cv::imread(path, flags);
  }
  path = (folder / (bopNumber(id) + ".png")).string();
  return {};
}

}  // namespace

Cloud readBopCloud(const fs::path& folder, const BopImage& image) {
  std::string depth_path, color_path;
  const cv::Mat depth = readImage(folder / "depth", image.id, cv::IMREAD_UNCHANGED, depth_path);
  if (depth.empty()) throw Error(ErrorCode::bad_file, "cannot read the depth image '" + depth_path + "'");
  if (depth.type() != CV_16UC1) {
    throw Error(ErrorCode::bad_file, depth_path + ": a depth image must have one channel of 16 bits");
  }
  cv::Mat color = readImage(folder / "rgb", image.id, cv::IMREAD_COLOR, color_path);
  if (!color.empty() && color.size() != depth.size()) {
    throw Error(ErrorCode::bad_file, color_path + ": its size differs from that of '" + depth_path + "'");
  }
  Cloud cloud;
  cloud.width = std::uint32_t(depth.cols);
  cloud.height = std::uint32_t(depth.rows);
  const BopCamera& camera = image.camera;
  for (int row = 0; row < depth.rows; ++row) {
    for (int column = 0; column < depth.cols; ++column) {
      double z = camera.depth_scale * depth.at<std::uint16_t>(row, column);
      if (z == 0) z = std::numeric_limits<double>::quiet_NaN();  // nothing was measured
      cloud.points.emplace_back(float(z * (column - camera.cx) / camera.fx), float(z * (row - camera.cy) / camera.fy),
                                float(z));
      if (color.empty()) continue;
      const cv::Vec3b& bgr = color.at<cv::Vec3b>(row, column);
      cloud.colors.push_back({bgr[2], bgr[1], bgr[0]});
    }
  }
  return cloud;
}

}  // namespace sks::tools
