// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/CaptureView.h>
#include <sks_detector/Detect.h>

#include "ros/service_context.hpp"

namespace sks_detector {

/// `~detect` and `~capture_view`, which look at one cloud. They throw what the caller is to reply.
class CloudServices {
public:
  explicit CloudServices(ServiceContext& context) : context_(context) {}

  void detect(const Detect::Request& request, Detect::Response& response);
  void captureView(const CaptureView::Request& request, CaptureView::Response& response);

private:
  sensor_msgs::PointCloud2ConstPtr nextCloud(double timeout) const;

  ServiceContext& context_;
};

}  // namespace sks_detector
