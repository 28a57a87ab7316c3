// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/steady_timer.h>

#include "ros/cloud_input.hpp"
#include "ros/detection_output.hpp"
#include "ros/detector_slot.hpp"
#include "ros/diagnostics.hpp"
#include "ros/error_report.hpp"
#include "ros/frame_detector.hpp"
#include "ros/frame_statistics.hpp"
#include "ros/model_output.hpp"
#include "ros/object_tracking.hpp"
#include "ros/parameters.hpp"
#include "ros/reconfigure.hpp"
#include "ros/services.hpp"
#include "ros/status_board.hpp"
#include "ros/time_watch.hpp"
#include "ros/transforms.hpp"

namespace sks_detector {

/// The detector as a ROS node, for the nodelet and the executable alike (docs/node.md). Clouds are processed in a
/// thread of its own; parameters, diagnostics and timers have another, services theirs: none of them waits for a frame.
class DetectorNode {
public:
  /// @param private_handle where its names are; clouds come by the callback queue of this handle
  explicit DetectorNode(const ros::NodeHandle& private_handle);
  ~DetectorNode();
  DetectorNode(const DetectorNode&) = delete;
  DetectorNode& operator=(const DetectorNode&) = delete;

private:
  DetectorNode(const ros::NodeHandle& private_handle, const ParameterReading& parameters);
  void loadCodebook(const ParameterReading& parameters);

  void work();
  void process(const CloudInput::Frame& frame);
  /// False, and an empty array, where the cloud cannot be used; says why.
  bool detect(const sensor_msgs::PointCloud2& cloud, const NodeSettings& settings, FrameResult& result);
  NodeAccess nodeAccess();
  DetectionArray detect(const sensor_msgs::PointCloud2& cloud, const DetectionQuery& query);

  void setEnabled(bool enabled);
  /// Subscribes or unsubscribes, as somebody listens or not.
  void updateWanted();
  /// Looks after what no message tells: time, the master, silence, diagnostics.
  void watch();
  void watchTime();
  void watchMaster();
  void watchSilence();
  void listenToTransforms();
  void advertiseTransforms();
  void advertiseObjects();

  NodeSettings nodeSettings() const;
  Configuration configuration() const;
  /// Reconfigure::Apply.
  Configuration apply(const Configuration& wanted);
  /// Logs why parameters or codebook are not used, and leaves it in the status as an error of this kind.
  void refuse(const std::string& kind, const std::string& reason);

  ros::CallbackQueue control_queue_;
  ros::NodeHandle control_handle_;
  mutable std::mutex settings_mutex_;
  NodeSettings settings_;
  std::atomic<bool> enabled_{true};
  DetectorSlot slot_;
  StatusBoard board_;
  ErrorReport errors_;
  Transforms transforms_;
  TimeWatch time_watch_;
  FrameStatistics statistics_;
  CloudInput input_;
  FrameDetector frame_detector_;
  ObjectTracking tracking_;
  std::mutex wanting_;
  DetectionOutput output_;
  ModelOutput models_;
  Diagnostics diagnostics_;
  std::unique_ptr<Reconfigure> reconfigure_;
  std::unique_ptr<Services> services_;
  ros::SteadyTimer timer_;
  ros::AsyncSpinner control_spinner_;
  std::thread worker_;
};

}  // namespace sks_detector
