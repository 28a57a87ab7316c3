// SPDX-License-Identifier: BSD-3-Clause
#include "ros/detection_query.hpp"

#include <algorithm>
#include <cmath>

#include <sks_detector/error.hpp>
#include <sks_detector/thresholds.hpp>

#include "core/settings/nearest_name.hpp"
#include "core/settings/number_format.hpp"
#include "core/settings/shown_text.hpp"
#include "ros/frame_name.hpp"

namespace sks_detector {
namespace {

constexpr double quaternion_tolerance = 0.01;  // of its norm
constexpr double crop_limit = 1000;            // [m]; range of sanitize.crop_min_x and so on

[[noreturn]] void refuseQuery(const std::string& message) {
  throw sks::Error(sks::ErrorCode::bad_usage, message);
}

Eigen::Isometry3d poseOfRegion(const geometry_msgs::Pose& pose) {
  const Eigen::Vector3d center(pose.position.x, pose.position.y, pose.position.z);
  if (!center.allFinite()) refuseQuery("roi_pose: its position is not finite");
  Eigen::Quaterniond turn(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  if (turn.coeffs().isZero(0)) turn.setIdentity();  // it was never set
  if (!(std::abs(turn.norm() - 1) <= quaternion_tolerance)) {
    refuseQuery(
        sks::formatted("roi_pose: its orientation has the norm %g; give a unit quaternion, or zeros for the axes of "
                       "the frame",
                       turn.norm()));
  }
  return Eigen::Translation3d(center) * turn.normalized();
}

/// An axis-aligned box in the frame of the cloud.
using CropBox = Eigen::AlignedBox3d;

/// Where the points of objects in the region may be, as far as the settings let any in.
CropBox cropOf(const Region& region, const Eigen::Isometry3d& T_cloud_region, const sks::Codebook& codebook,
               const sks::SanitizeSettings& settings) {
  float diagonal = 0;  // of the largest object [m]
  for (const sks::TrainingView& view : codebook.views) diagonal = std::max(diagonal, view.extent().norm());
  const Eigen::Vector3d half_in_region = 0.5 * region.size + Eigen::Vector3d::Constant(diagonal);
  const Eigen::Vector3d half = T_cloud_region.linear().cwiseAbs() * half_in_region;
  const Eigen::Vector3d center = T_cloud_region.translation();
  CropBox allowed(Eigen::Vector3d::Constant(-crop_limit), Eigen::Vector3d::Constant(crop_limit));
  if (settings.crop) {
    allowed = CropBox(Eigen::Vector3d(settings.crop_min_x, settings.crop_min_y, settings.crop_min_z),
                      Eigen::Vector3d(settings.crop_max_x, settings.crop_max_y, settings.crop_max_z));
  }
  return allowed.intersection(CropBox(center - half, center + half));
}

void setCrop(const CropBox& box, sks::SanitizeSettings& settings) {
  settings.crop = true;
  settings.crop_min_x = box.min().x();
  settings.crop_min_y = box.min().y();
  settings.crop_min_z = box.min().z();
  settings.crop_max_x = box.max().x();
  settings.crop_max_y = box.max().y();
  settings.crop_max_z = box.max().z();
}

/// Whether too few points lie in the box, of a cloud that has enough.
bool isFree(const CropBox& box, const sks::Cloud& cloud, int min_points) {
  if ((box.max().array() <= box.min().array()).any()) return true;
  const Eigen::AlignedBox3f crop(box.cast<float>());
  int finite = 0, inside = 0;
  for (const Eigen::Vector3f& point : cloud.points) {
    finite += point.allFinite();
    inside += crop.contains(point);
    if (inside >= min_points) return false;
  }
  return finite >= min_points;
}

bool isInside(const Eigen::Vector3d& point, const Region& region, const Eigen::Isometry3d& T_region_cloud) {
  return ((T_region_cloud * point).array().abs() <= 0.5 * region.size.array()).all();
}

}  // namespace

DetectionQuery toQuery(const Detect::Request& request) {
  DetectionQuery query;
  query.objects = request.objects;
  const double threshold = double(request.threshold);
  if (!(threshold >= 0 && threshold <= 1)) {
    refuseQuery(sks::formatted("threshold = %g must lie in 0 to 1; 0: ~detection/threshold", threshold));
  }
  if (threshold > 0) query.threshold = threshold;
  const Eigen::Vector3d size(request.roi_size.x, request.roi_size.y, request.roi_size.z);
  if (size.isZero(0)) return query;
  if (!size.allFinite() || !(size.array() > 0).all()) {
    refuseQuery(
        sks::formatted("roi_size = (%g, %g, %g) m: each edge must be greater than 0, or all of them 0 for no region",
                       size.x(), size.y(), size.z()));
  }
  query.region = Region{withoutSlash(request.roi_pose.header.frame_id), poseOfRegion(request.roi_pose.pose), size};
  return query;
}

void checkObjects(const DetectionQuery& query, const sks::Codebook& codebook) {
  for (const std::string& name : query.objects) {
    if (std::find(codebook.objects.begin(), codebook.objects.end(), name) != codebook.objects.end()) continue;
    refuseQuery("objects: '" + sks::shown(name) + "' is not in the codebook " + sks::shown(codebook.name) + "; " +
                sks::nearestNameHint(name, codebook.objects));
  }
}

std::vector<sks::Detection> detectWanted(const sks::Detector& detector, const sks::Cloud& cloud,
                                         const DetectionQuery& query, const Eigen::Isometry3d& T_cloud_region,
                                         sks::Inspection* inspection) {
  const sks::Settings& settings = detector.settings();
  const sks::Thresholds thresholds =
      query.threshold ? sks::Thresholds(*query.threshold) : sks::Thresholds(settings.detection);
  std::vector<sks::Detection> found;
  if (query.region) {
    const CropBox box = cropOf(*query.region, T_cloud_region, detector.codebook(), settings.sanitize);
    if (isFree(box, cloud, settings.sanitize.min_points)) return {};
    sks::Settings cropping = settings;
    setCrop(box, cropping.sanitize);
    found = detector.withSettings(cropping).detect(cloud, inspection).above(thresholds);
  } else {
    found = detector.detect(cloud, inspection).above(thresholds);
  }
  const Eigen::Isometry3d T_region_cloud = T_cloud_region.inverse();
  const auto unwanted = [&](const sks::Detection& detection) {
    const auto& names = query.objects;
    const bool other = !names.empty() && std::find(names.begin(), names.end(), detection.object) == names.end();
    return other || (query.region && !isInside(detection.position(), *query.region, T_region_cloud));
  };
  found.erase(std::remove_if(found.begin(), found.end(), unwanted), found.end());
  return found;
}

}  // namespace sks_detector
