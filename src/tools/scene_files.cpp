// SPDX-License-Identifier: BSD-3-Clause
#include "tools/scene_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <sks_detector/cloud_io.hpp>

#include "core/settings/value_text.hpp"
#include "io/file.hpp"
#include "io/image_file.hpp"
#include "tools/data_set_yaml.hpp"

namespace sks::tools {
namespace {

ColorImage colorImage(const Cloud& cloud) {
  ColorImage image(int(cloud.width), int(cloud.height));
  image.pixels = cloud.colors;
  return image;
}

DepthImage depthImage(const Cloud& cloud) {
  DepthImage image(int(cloud.width), int(cloud.height));
  std::transform(cloud.points.begin(), cloud.points.end(), image.pixels.begin(), [](const Eigen::Vector3f& p) {
    return std::isfinite(p.z()) ? std::uint16_t(std::min(65535L, std::lround(1000 * p.z()))) : std::uint16_t(0);
  });
  return image;
}

}  // namespace

void writeSceneFiles(const std::string& base, const Cloud& cloud) {
  writeCloud(base + ".pcd", cloud);
  if (cloud.hasColor()) writeFileAtomically(base + "_color.png", encodePng(colorImage(cloud)));
  writeFileAtomically(base + "_depth.png", encodePng(depthImage(cloud)));
}

std::string relativeSource(const std::string& source, const std::string& folder) {
  namespace fs = std::filesystem;
  return source.rfind("builtin:", 0) == 0 ? source : fs::relative(source, folder).lexically_normal().string();
}

std::string trainingYaml(const std::string& object, const std::string& cloud, double scale,
                         const std::optional<Symmetry>& symmetry) {
  std::string text = "  - {object: " + yamlText(object) + ", cloud: " + yamlText(cloud) + ", kind: mesh";
  if (scale > 0) text += ", units: " + toText(scale);
  if (symmetry) {
    text += ", symmetry: {axis: " + yamlList({symmetry->axis.x(), symmetry->axis.y(), symmetry->axis.z()}) +
            ", order: " + (symmetry->order == 0 ? "inf" : std::to_string(symmetry->order)) + "}";
  }
  return text + "}\n";
}

}  // namespace sks::tools
