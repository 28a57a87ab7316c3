// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "drawing/point_image.hpp"
#include "io/file.hpp"

namespace sks {
namespace {

constexpr int gap = 5;  // around a label's text [pixels]

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

Picture::Picture(const Cloud& cloud, PictureSize size)
    : camera_(cloud, size), image_(renderPoints(cloud, camera_, size)) {}

void Picture::drawEdge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Rgb color, double thickness) {
  Eigen::Vector3d a = camera_.toCamera(from), b = camera_.toCamera(to);
  if (a.z() < b.z()) std::swap(a, b);
  if (a.z() < near_plane || !a.allFinite() || !b.allFinite()) return;
  if (b.z() < near_plane) b = a + (b - a) * ((a.z() - near_plane) / (a.z() - b.z()));
  drawLine(image_, camera_.pixel(a), camera_.pixel(b), color, thickness);
}

void Picture::drawBox(const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& box_size, Rgb color) {
  const auto corner = corners(T_cloud_box, box_size);
  for (std::size_t i = 0; i < 8; ++i) {
    for (const std::size_t bit : {1, 2, 4}) {
      if ((i & bit) == 0) drawEdge(corner[i], corner[i | bit], color, 2);
    }
  }
}

void Picture::drawAxes(const Eigen::Vector3d& origin, const Eigen::Matrix3d& axes, double length) {
  const Rgb colors[] = {{255, 40, 40}, {40, 220, 40}, {60, 90, 255}};
  for (int i = 0; i < 3; ++i) drawEdge(origin, origin + length * axes.col(i), colors[i], 3);
}

void Picture::drawCross(const Eigen::Vector3d& place, Rgb color) {
  const Eigen::Vector3d p = camera_.toCamera(place);
  if (p.z() < near_plane) return;
  const Eigen::Vector2d pixel = camera_.pixel(p);
  const auto draw = [&](double half, Rgb ink, double thickness) {
    const Eigen::Vector2d down(half, half), up(half, -half);
    drawLine(image_, pixel - down, pixel + down, ink, thickness);
    drawLine(image_, pixel - up, pixel + up, ink, thickness);
  };
  draw(15, {0, 0, 0}, 6);  // a rim, to be seen on any ground
  draw(14, color, 3);
}

void Picture::drawLabel(const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& box_size, const std::string& text,
                        Rgb color) {
  double top = image_.height, middle = 0;
  for (const Eigen::Vector3d& corner : corners(T_cloud_box, box_size)) {
    const Eigen::Vector3d p = camera_.toCamera(corner);
    if (p.z() < near_plane) return;
    const Eigen::Vector2d pixel = camera_.pixel(p);
    top = std::min(top, pixel.y());
    middle += pixel.x() / 8;
  }
  const PictureSize extent = textSize(text);
  PixelBox plate{0, 0, extent.width + 2 * gap, extent.height + 3 * gap};
  const auto within = [](double value, int size, int limit) {
    return int(std::clamp(value, 0.0, std::max(0.0, double(limit - size))));
  };
  plate.x = within(middle - 0.5 * plate.width, plate.width, image_.width);
  plate.y = within(top - plate.height - gap, plate.height, image_.height);
  const auto taken = [&](const Label& other) { return plate.overlaps(other.plate); };
  for (auto hit = labels_.begin(); (hit = std::find_if(labels_.begin(), labels_.end(), taken)) != labels_.end();) {
    if (plate.y + plate.height >= image_.height) break;  // no room left
    plate.y = hit->plate.y + hit->plate.height + 1;
  }
  labels_.push_back({plate, text, color});
}

void Picture::drawDetection(const Detection& detection, Rgb color) {
  const std::string score = formatted(" %.2f", detection.score);
  drawBox(detection.T_scene_box, detection.box_size, color);
  drawAxes(detection.position(), detection.T_scene_model.linear(), 0.4 * detection.box_size.maxCoeff());
  drawLabel(detection.T_scene_box, detection.box_size, detection.object + score, color);
}

ColorImage Picture::image() const {
  ColorImage image = image_;
  for (const Label& label : labels_) {
    const Rgb& color = label.color;
    const bool light = 0.3 * color.r + 0.59 * color.g + 0.11 * color.b > 120;
    fillBox(image, label.plate, color);
    const Eigen::Vector2d baseline(label.plate.x + gap, label.plate.y + label.plate.height - 2 * gap);
    drawText(image, label.text, baseline, light ? Rgb{0, 0, 0} : Rgb{255, 255, 255});
  }
  return image;
}

void Picture::save(const std::string& path) const {
  const ColorImage image = this->image();
  writeFileAtomically(path, endingOf(path) == ".png" ? encodePng(image) : encodeJpeg(image));
}

void checkPicturePath(const std::string& path) {
  endingOf(path);
  checkWritable(path);
}

}  // namespace sks
