// SPDX-License-Identifier: BSD-3-Clause
#include "ros/markers.hpp"

#include <algorithm>
#include <utility>

#include <tf2_eigen/tf2_eigen.h>

#include "core/settings/number_format.hpp"

namespace sks_detector {
namespace {

using visualization_msgs::Marker;

constexpr double label_height = 0.04;  // of its distance to the camera

std_msgs::ColorRGBA toMessage(const sks::Rgb& color) {
  std_msgs::ColorRGBA message;
  message.r = float(color.r) / 255;
  message.g = float(color.g) / 255;
  message.b = float(color.b) / 255;
  message.a = 1;
  return message;
}

geometry_msgs::Point toPoint(const Eigen::Vector3d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = p.z();
  return point;
}

Eigen::Vector3d toVector(const geometry_msgs::Point& p) {
  return {p.x, p.y, p.z};
}

Eigen::Vector3d sizeOf(const Detection& detection) {
  return {detection.box_size.x, detection.box_size.y, detection.box_size.z};
}

/// Half the extent of a detection's box along a direction.
double reachAlong(const Detection& detection, const Eigen::Vector3d& direction) {
  Eigen::Quaterniond rotation;
  tf2::fromMsg(detection.box_center.orientation, rotation);
  return 0.5 * (rotation.inverse() * direction).cwiseAbs().dot(sizeOf(detection));
}

/// A marker with what all of them have in common, its pose the centre of the box.
Marker newMarker(const DetectionArray& detections, std::size_t index, const char* part, const MarkerStyle& style) {
  Marker marker;
  marker.header = detections.header;
  marker.ns = part;
  const std::uint32_t id = detections.detections[index].id;
  marker.id = id > 0 ? int(id) : int(index);
  marker.action = Marker::ADD;
  marker.pose = detections.detections[index].box_center;
  marker.lifetime = style.lifetime;
  marker.color = toMessage(style.colors[index]);
  return marker;
}

void addBox(Marker marker, const Detection& detection, visualization_msgs::MarkerArray& array) {
  marker.type = Marker::LINE_LIST;
  marker.scale.x = std::max(0.002, 0.015 * sizeOf(detection).maxCoeff());
  const Eigen::Vector3d half = 0.5 * sizeOf(detection);
  for (int axis = 0; axis < 3; ++axis) {  // the four edges along each axis
    for (const double u : {-1.0, 1.0}) {
      for (const double v : {-1.0, 1.0}) {
        Eigen::Vector3d corner = half;
        corner[(axis + 1) % 3] *= u;
        corner[(axis + 2) % 3] *= v;
        marker.points.push_back(toPoint(corner));
        corner[axis] *= -1;
        marker.points.push_back(toPoint(corner));
      }
    }
  }
  array.markers.push_back(std::move(marker));
}

void addAxes(Marker marker, const Detection& detection, visualization_msgs::MarkerArray& array) {
  marker.type = Marker::LINE_LIST;
  marker.pose.orientation = detection.pose.pose.orientation;
  const double length = 0.6 * sizeOf(detection).maxCoeff();
  marker.scale.x = std::max(0.002, 0.04 * length);
  marker.color = toMessage({255, 255, 255});
  const sks::Rgb colors[] = {{255, 40, 40}, {40, 220, 40}, {60, 90, 255}};
  for (int axis = 0; axis < 3; ++axis) {
    marker.points.push_back(toPoint(Eigen::Vector3d::Zero()));
    marker.points.push_back(toPoint(length * Eigen::Vector3d::Unit(axis)));
    marker.colors.insert(marker.colors.end(), 2, toMessage(colors[axis]));
  }
  array.markers.push_back(std::move(marker));
}

void addLabel(Marker marker, const Detection& detection, const Eigen::Isometry3d& T_target_sensor,
              visualization_msgs::MarkerArray& array) {
  marker.type = Marker::TEXT_VIEW_FACING;
  marker.text = detection.object + sks::formatted(" %.2f", double(detection.score));
  const Eigen::Vector3d center = toVector(marker.pose.position);
  const Eigen::Vector3d to_camera = T_target_sensor.translation() - center, up = -T_target_sensor.linear().col(1);
  marker.scale.z = label_height * to_camera.norm();
  marker.pose.orientation = geometry_msgs::Quaternion();
  marker.pose.orientation.w = 1;
  marker.pose.position = toPoint(center + (reachAlong(detection, up) + marker.scale.z) * up +
                                 reachAlong(detection, to_camera.normalized()) * to_camera.normalized());
  array.markers.push_back(std::move(marker));
}

}  // namespace

visualization_msgs::MarkerArray clearingMarkers(const std_msgs::Header& header) {
  visualization_msgs::MarkerArray array;
  array.markers.resize(1);
  array.markers[0].header = header;
  array.markers[0].action = Marker::DELETEALL;
  array.markers[0].pose.orientation.w = 1;
  return array;
}

visualization_msgs::MarkerArray detectionMarkers(const DetectionArray& detections, const MarkerStyle& style) {
  visualization_msgs::MarkerArray array = clearingMarkers(detections.header);
  for (std::size_t i = 0; i < detections.detections.size(); ++i) {
    const Detection& detection = detections.detections[i];
    addBox(newMarker(detections, i, "boxes", style), detection, array);
    addAxes(newMarker(detections, i, "axes", style), detection, array);
    addLabel(newMarker(detections, i, "labels", style), detection, style.T_target_sensor, array);
  }
  return array;
}

}  // namespace sks_detector
