// SPDX-License-Identifier: BSD-3-Clause
#include "ros/cloud_services.hpp"

#include <filesystem>

#include <ros/console.h>
#include <tf2_eigen/tf2_eigen.h>
#include <boost/make_shared.hpp>

#include <sks_detector/error.hpp>

#include "core/capture/tabletop.hpp"
#include "core/capture/view_quality.hpp"
#include "core/settings/number_format.hpp"
#include "core/settings/value_text.hpp"
#include "io/confined_path.hpp"

namespace sks_detector {
namespace {

using sks::Error;
using sks::ErrorCode;

constexpr double longest_timeout = 3600;  // [s]

/// The one object on the dominant plane.
struct StandingObject {
  std::vector<std::uint32_t> points;
  Eigen::Hyperplane<double, 3> plane;
};

StandingObject findObject(const sks::Cloud& cloud) {
  const sks::Tabletop tabletop = sks::findTabletop(cloud);
  const std::size_t count = tabletop.objects.size();
  if (count == 1) return {tabletop.objects[0], tabletop.plane.cast<double>()};
  const std::string plane = sks::formatted("the dominant plane (%.2f m^2, %.2f m from the camera)", tabletop.area,
                                           double(tabletop.plane.absDistance(cloud.sensor_origin)));
  if (count == 0) {
    throw Error(ErrorCode::bad_data,
                "no object stands on " + plane +
                    ": put the object on a free table, away from its edges, in view of the camera");
  }
  throw Error(ErrorCode::bad_data,
              std::to_string(count) + " objects stand on " + plane + ": leave only the one that is to be captured");
}

std::string describe(const sks::ViewQuality& quality) {
  std::string description =
      sks::formatted("%zu points, %.0f x %.0f x %.0f mm, %.1f mm apart", quality.points, 1000.0 * quality.extent.x(),
                     1000.0 * quality.extent.y(), 1000.0 * quality.extent.z(), 1000.0 * quality.spacing);
  if (quality.remarks.empty()) return description + "; a good view";
  for (const std::string& remark : quality.remarks) description += "; " + remark;
  return description;
}

}  // namespace

void CloudServices::detect(const Detect::Request& request, Detect::Response& response) {
  const DetectionQuery query = toQuery(request);  // before the camera is waited for
  const bool given = !request.cloud.data.empty() || request.cloud.width != 0;
  const auto cloud =
      given ? boost::make_shared<const sensor_msgs::PointCloud2>(request.cloud) : nextCloud(request.timeout);
  response.detections = context_.node.detect(cloud, query);
  response.message = counted(response.detections.detections.size(), "detection") + " with " +
                     response.detections.codebook + " in " +
                     sks::toText(int(1000 * response.detections.processing_time)) + " ms";
}

void CloudServices::captureView(const CaptureView::Request& request, CaptureView::Response& response) {
  sks::checkFileName(request.object, "the object's name");  // before the camera is waited for
  sks::confinedPath(context_.captured.file(), context_.dataset_directory);
  const std::vector<std::string> warnings = context_.captured.read().warnings;
  for (const std::string& warning : warnings) ROS_WARN_STREAM(warning);
  const sensor_msgs::PointCloud2ConstPtr message = nextCloud(request.timeout);
  const sks::Cloud cloud = context_.node.read(*message);
  const StandingObject object = findObject(cloud);
  const sks::ViewQuality quality = sks::assessView(cloud, object.points, context_.slot.trainingSettings());
  std::optional<Eigen::Isometry3d> T_fixed_cloud;
  std::vector<std::string> remarks = warnings;
  try {
    T_fixed_cloud = context_.node.fixed_pose(message->header);
  } catch (const Error& error) {
    remarks.push_back(std::string("how the camera was moved is not known: ") + error.what());
  }
  const auto added =
      context_.captured.add(request.object, sks::cutOut(cloud, object.points), object.plane, T_fixed_cloud);
  context_.updateStatus();
  response.view = added.file;
  response.views = std::uint32_t(added.views);
  response.points = std::uint32_t(quality.points);
  response.extent.x = quality.extent.x();
  response.extent.y = quality.extent.y();
  response.extent.z = quality.extent.z();
  response.resolution = quality.spacing;
  response.message = "view " + std::to_string(added.views) + " of '" + request.object + "': " + describe(quality) +
                     describeModel(request.object, response) + asRemarks(remarks);
}

void CloudServices::undoCapture(const UndoCapture::Request& request, UndoCapture::Response& response) {
  const auto removed = context_.captured.removeLast(request.object);
  context_.updateStatus();
  response.views = 1;
  response.message = "the last view of '" + request.object + "' is taken back; " + counted(removed.views, "view") +
                     (removed.views == 1 ? " is" : " are") + " left";
}

std::string CloudServices::describeModel(const std::string& object, CaptureView::Response& response) {
  const sks::Settings settings = context_.slot.trainingSettings();
  if (settings.training.register_views == sks::RegisterViews::off) return "";
  try {
    const CaptureResult result = models_.update(object, context_.captured.read(), settings);
    const std::vector<sks::RegisteredView>& views = result.model.views;
    response.registered_views = std::uint32_t(result.model.tied());
    response.coverage = result.coverage.share;
    response.missing = result.coverage.missing;
    response.registered = !views.empty() && views.back().T_model_view;
    std::string text;
    if (result.same) {
      response.same_as = views[*result.same].source;
      text += "; it shows the same as view " + std::to_string(*result.same + 1);
    }
    if (response.registered) response.pose = tf2::toMsg(*views.back().T_model_view);
    if (views.size() < 3) return text;  // two cannot confirm each other
    if (!response.registered) text += "; it has no place in the model yet: " + views.back().reason;
    text += sks::formatted("; %zu of %zu views are registered and show %.0f %% of the directions", result.model.tied(),
                           views.size(), 100 * result.coverage.share);
    return response.missing.empty() ? text : text + "; missing: " + response.missing;
  } catch (const std::exception& error) {  // the view is stored all the same
    return std::string("; its place in the model is not known: ") + error.what();
  }
}

sensor_msgs::PointCloud2ConstPtr CloudServices::nextCloud(double timeout) const {
  if (!(timeout >= 0 && timeout <= longest_timeout)) {
    throw Error(ErrorCode::bad_usage, "timeout = " + sks::toText(timeout) + " s must lie in 0 to " +
                                          sks::toText(longest_timeout) + " s; 0: ~service_timeout (" +
                                          sks::toText(context_.service_timeout) + " s)");
  }
  return context_.node.next_cloud(timeout > 0 ? timeout : context_.service_timeout);
}

}  // namespace sks_detector
