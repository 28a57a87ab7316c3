// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/CaptureView.h>
#include <sks_detector/Detect.h>
#include <sks_detector/UndoCapture.h>

#include "ros/capture_models.hpp"
#include "ros/service_context.hpp"

namespace sks_detector {

/// `~detect` and `~capture_view`, which look at one cloud, and `~undo_capture`. They throw what the caller is to reply.
class CloudServices {
public:
  explicit CloudServices(ServiceContext& context) : context_(context) {}

  void detect(const Detect::Request& request, Detect::Response& response);
  void captureView(const CaptureView::Request& request, CaptureView::Response& response);
  /// Takes the last captured view of an object back.
  void undoCapture(const UndoCapture::Request& request, UndoCapture::Response& response);

private:
  /// Fills in what the view adds to the model. @return the same in words; why not, where that cannot be told
  std::string describeModel(const std::string& object, CaptureView::Response& response);
  sensor_msgs::PointCloud2ConstPtr nextCloud(double timeout) const;

  ServiceContext& context_;
  CaptureModels models_;
};

}  // namespace sks_detector
