// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <sks_detector/CaptureView.h>
#include <sks_detector/DetectionArray.h>
#include <sks_detector/Info.h>
#include <sks_detector/LoadCodebook.h>
#include <sks_detector/RemoveObject.h>
#include <sks_detector/SaveCodebook.h>
#include <sks_detector/Status.h>
#include <sks_detector/Train.h>
#include <sks_detector/UndoCapture.h>
#include <std_srvs/Trigger.h>

namespace sks_detector {

/// What looks like a detector: notes what it is asked, and replies what it is told to.
class StubNode {
public:
  explicit StubNode(const std::string& name = "/detector");
  ~StubNode();

  void publish(const Status& status) { status_.publish(status); }
  void publish(const DetectionArray& detections) { detections_.publish(detections); }
  void publishThreshold(double threshold);

  /// What it was asked so far, e.g. "capture_view mug"; ~info is not noted.
  std::vector<std::string> requests() const;

  /// While true, calls of all services but ~cancel_training wait.
  void setHanging(bool hanging);
  void setInfo(const InfoResponse& info);
  void setCapture(const CaptureViewResponse& response);
  /// What set_parameters then has in force, whatever it is asked; negative: what it is asked.
  void setForcedThreshold(double threshold);

private:
  template <typename Service>
  void advertise(const std::string& name, std::string (*describe)(const typename Service::Request&),
                 const typename Service::Response& response);
  void note(const std::string& request);
  void waitWhileHanging();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool hanging_ = false;
  std::vector<std::string> requests_;
  InfoResponse info_;
  CaptureViewResponse capture_;
  double forced_threshold_ = -1;

  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  ros::Publisher status_, detections_, parameters_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_;
};

}  // namespace sks_detector
