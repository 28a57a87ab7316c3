// SPDX-License-Identifier: BSD-3-Clause
#include "tools/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <sks_detector/error.hpp>

#include "io/file.hpp"
#include "tools/point_image.hpp"

namespace sks::tools {
namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr double font_scale = 0.7;
constexpr int gap = 5;  // around a label's text [pixels]

cv::Scalar toBgr(Rgb color) {
  return cv::Scalar(color.b, color.g, color.r);
}

/// Corner i has bit 0, 1, 2 set where it lies at the upper end of x, y, z.
std::array<Eigen::Vector3d, 8> corners(const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& size) {
  std::array<Eigen::Vector3d, 8> result;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5);
    result[std::size_t(i)] = T_cloud_box * sign.cwiseProduct(size);
  }
  return result;
}

std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (ending != ".png" && ending != ".jpg" && ending != ".jpeg") {
    throw Error(ErrorCode::bad_usage,
                "cannot tell the kind of picture from '" + path + "'; let it end in .png or .jpg");
  }
  return ending;
}

}  // namespace

Picture::Picture(const Cloud& cloud, cv::Size size)
    : camera_(cloud, size), image_(renderPoints(cloud, camera_, size)) {}

void Picture::drawLine(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Rgb color, int thickness) {
  Eigen::Vector3d a = camera_.toCamera(from), b = camera_.toCamera(to);
  if (a.z() < b.z()) std::swap(a, b);
  if (a.z() < near_plane || !a.allFinite() || !b.allFinite()) return;
  if (b.z() < near_plane) b = a + (b - a) * ((a.z() - near_plane) / (a.z() - b.z()));
  constexpr double limit = 1e5;  // pixels, so that the line can be cut at the picture's rim in whole numbers
  const cv::Point2d p = camera_.pixel(a), q = camera_.pixel(b);
  if (std::max({std::abs(p.x), std::abs(p.y), std::abs(q.x), std::abs(q.y)}) > limit) return;
  cv::line(image_, p, q, toBgr(color), thickness, cv::LINE_AA);
}

void Picture::drawBox(const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& box_size, Rgb color) {
  const auto corner = corners(T_cloud_box, box_size);
  for (std::size_t i = 0; i < 8; ++i) {
    for (const std::size_t bit : {1, 2, 4}) {
      if ((i & bit) == 0) drawLine(corner[i], corner[i | bit], color, 2);
    }
  }
}

void Picture::drawAxes(const Eigen::Vector3d& origin, const Eigen::Matrix3d& axes, double length) {
  const Rgb colors[] = {{255, 40, 40}, {40, 220, 40}, {60, 90, 255}};
  for (int i = 0; i < 3; ++i) drawLine(origin, origin + length * axes.col(i), colors[i], 3);
}

void Picture::drawCross(const Eigen::Vector3d& place, Rgb color) {
  const Eigen::Vector3d p = camera_.toCamera(place);
  if (p.z() < near_plane) return;
  const cv::Point2d pixel = camera_.pixel(p);
  cv::drawMarker(image_, pixel, cv::Scalar::all(0), cv::MARKER_TILTED_CROSS, 30, 6, cv::LINE_AA);
  cv::drawMarker(image_, pixel, toBgr(color), cv::MARKER_TILTED_CROSS, 28, 3, cv::LINE_AA);
}

void Picture::drawLabel(const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& box_size, const std::string& text,
                        Rgb color) {
  cv::Point2d top(0, image_.rows);
  double middle = 0;
  for (const Eigen::Vector3d& corner : corners(T_cloud_box, box_size)) {
    const Eigen::Vector3d p = camera_.toCamera(corner);
    if (p.z() < near_plane) return;
    const cv::Point2d pixel = camera_.pixel(p);
    top.y = std::min(top.y, pixel.y);
    middle += pixel.x / 8;
  }
  const cv::Size extent = cv::getTextSize(text, font, font_scale, 1, nullptr);
  cv::Rect plate(0, 0, extent.width + 2 * gap, extent.height + 3 * gap);
  const auto within = [](double value, int size, int limit) {
    return int(std::clamp(value, 0.0, std::max(0.0, double(limit - size))));
  };
  plate.x = within(middle - 0.5 * plate.width, plate.width, image_.cols);
  plate.y = within(top.y - plate.height - gap, plate.height, image_.rows);
  const auto taken = [&](const Label& other) { return (plate & other.plate).area() > 0; };
  for (auto hit = labels_.begin(); (hit = std::find_if(labels_.begin(), labels_.end(), taken)) != labels_.end();) {
    if (plate.y + plate.height >= image_.rows) break;  // no room left
    plate.y = hit->plate.y + hit->plate.height + 1;
  }
  labels_.push_back({plate, text, color});
}

void Picture::drawDetection(const Detection& detection, Rgb color) {
  char score[16];
  std::snprintf(score, sizeof(score), " %.2f", detection.score);
  drawBox(detection.T_scene_box, detection.box_size, color);
  drawAxes(detection.position(), detection.T_scene_model.linear(), 0.4 * detection.box_size.maxCoeff());
  drawLabel(detection.T_scene_box, detection.box_size, detection.object + score, color);
}

void Picture::save(const std::string& path) const {
  cv::Mat image = image_.clone();
  for (const Label& label : labels_) {
    const Rgb& color = label.color;
    const bool light = 0.3 * color.r + 0.59 * color.g + 0.11 * color.b > 120;
    cv::rectangle(image, label.plate, toBgr(color), cv::FILLED);
    cv::putText(image, label.text, {label.plate.x + gap, label.plate.y + label.plate.height - 2 * gap}, font,
                font_scale, cv::Scalar::all(light ? 0 : 255), 1, cv::LINE_AA);
  }
  std::vector<uchar> bytes;
  cv::imencode(endingOf(path), image, bytes);
  writeFileAtomically(path, std::string(bytes.begin(), bytes.end()));
}

Rgb paletteColor(std::size_t index) {
  // Hues a golden section apart never meet again.
  const double hue = std::fmod(0.09 + 0.618034 * double(index), 1.0) * 180;
  const cv::Mat3b hsv(1, 1, cv::Vec3b(uchar(hue), 190, 255));
  cv::Mat3b bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  return {bgr(0, 0)[2], bgr(0, 0)[1], bgr(0, 0)[0]};
}

void checkPicturePath(const std::string& path) {
  endingOf(path);
  checkWritable(path);
}

}  // namespace sks::tools
