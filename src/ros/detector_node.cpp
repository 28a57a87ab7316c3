// SPDX-License-Identifier: BSD-3-Clause
#include "ros/detector_node.hpp"

#include <algorithm>
#include <utility>

#include <ros/console.h>

#include <sks_detector/codebook_file.hpp>

#include "core/settings/threads.hpp"
#include "core/settings/value_text.hpp"
#include "ros/detection_frame.hpp"
#include "ros/folders.hpp"
#include "ros/master_access.hpp"
#include "ros/with_queue.hpp"

namespace sks_detector {
namespace {

constexpr double watch_period = 0.5;  // [s]

// Kinds of errors.
constexpr const char* cloud_error = "cloud";
constexpr const char* frame_error = "frame";
constexpr const char* parameter_error = "parameters";
constexpr const char* watch_error = "watch";

/// A node leaves one core to the rest of the robot, unless it is told how many threads to use.
sks::Settings withThreads(sks::Settings settings) {
  const std::string capped = sks::tooManyThreads(settings);
  if (!capped.empty()) ROS_WARN_STREAM(capped);
  settings.threads = settings.threads == 0 ? std::max(1, sks::threadCount(settings) - 1) : sks::threadCount(settings);
  return settings;
}

double secondsSince(CloudInput::Clock::time_point start) {
  return std::chrono::duration<double>(CloudInput::Clock::now() - start).count();
}

}  // namespace

DetectorNode::DetectorNode(const ros::NodeHandle& private_handle)
    : DetectorNode(private_handle, readParameters(private_handle)) {}

DetectorNode::DetectorNode(const ros::NodeHandle& private_handle, const ParameterReading& parameters)
    : control_handle_(withQueue(private_handle, control_queue_)),
      settings_(parameters.configuration.node),
      slot_(withThreads(parameters.configuration.detector)),
      board_(control_handle_, slot_),
      errors_(board_),
      input_(private_handle),
      frame_detector_(slot_, transforms_),
      output_(control_handle_, [this] { updateWanted(); }),
      models_(control_handle_, slot_),
      diagnostics_(control_handle_, {board_, input_, statistics_, tracking_},
                   [this] { return nodeSettings().silence_warning; }),
      control_spinner_(1, &control_queue_) {
  for (const std::string& warning : parameters.warnings) ROS_WARN_STREAM(warning);
  for (const std::string& error : parameters.errors) refuse(parameter_error, error);
  loadCodebook(parameters);
  reconfigure_ = std::make_unique<Reconfigure>(
      control_handle_, configuration(), [this](const Configuration& wanted) { return apply(wanted); },
      [this](const std::string& reason) { refuse(parameter_error, reason); });
  board_.setCodebookListener([this] {
    reconfigure_->update(configuration());
    errors_.clear(cloud_error);  // that there was none, for example
    board_.setUsable(true);
    advertiseObjects();
    models_.codebookChanged();
  });
  services_ = std::make_unique<Services>(control_handle_, slot_, board_, nodeSettings(), nodeAccess());
  listenToTransforms();
  advertiseTransforms();
  advertiseObjects();
  timer_ = control_handle_.createSteadyTimer(ros::WallDuration(watch_period),
                                             [this](const ros::SteadyTimerEvent&) { watch(); });
  updateWanted();
  control_spinner_.start();
  worker_ = std::thread([this] { work(); });
}

DetectorNode::~DetectorNode() {
  input_.stop();
  transforms_.stop();
  services_.reset();
  timer_.stop();
  control_spinner_.stop();
  worker_.join();
}

void DetectorNode::loadCodebook(const ParameterReading& parameters) {
  const std::string file = codebookFile(nodeSettings());
  if (file.empty()) {
    ROS_WARN_STREAM("there is no codebook, so nothing is detected: set "
                    << control_handle_.resolveName("codebook") << ", or call " << control_handle_.resolveName("train")
                    << " or " << control_handle_.resolveName("load_codebook"));
    return;
  }
  try {
    slot_.setCodebook(sks::readCodebook(file), file);
  } catch (const std::exception& error) {
    refuse(codebook_error, control_handle_.resolveName("codebook") + ": " + error.what());
    return;
  }
  board_.codebookChanged();
  ROS_INFO_STREAM("detecting with the codebook " << slot_.codebookName() << " of '" << file << "'");
  for (const std::string& key : sks::bindingConflicts(slot_.settings(), parameters.configuration.detector)) {
    const auto& given = parameters.given;
    if (std::find(given.begin(), given.end(), key) == given.end()) continue;
    ROS_WARN_STREAM(key << " = " << sks::getSetting(parameters.configuration.detector, key)
                        << " is only used for training: the codebook in use was trained with "
                        << sks::getSetting(slot_.settings(), key));
  }
}

void DetectorNode::work() {
  while (const std::optional<CloudInput::Frame> frame = input_.take()) {
    try {
      process(*frame);
    } catch (const std::exception& error) {
      statistics_.unusable();
      board_.setUsable(false);
      errors_.error(frame_error, "cloud of " + input_.topic() + ": " + error.what());
    }
  }
}

void DetectorNode::process(const CloudInput::Frame& frame) {
  watchTime();
  const NodeSettings settings = nodeSettings();
  const std_msgs::Header& header = frame.cloud->header;
  const ros::Time start = ros::Time::now();
  if (start < frame.received_at) return input_.countDropped();  // it came before time jumped back
  const double age = header.stamp.isZero() ? 0 : start.toSec() - header.stamp.toSec();  // ros::Duration may overflow
  if (settings.max_input_age > 0 && age > settings.max_input_age) {
    statistics_.tooOld(age);
    errors_.warning("age", "clouds of " + input_.topic() + " are dropped: they are older than ~max_input_age");
    return;
  }

  FrameResult result;
  const bool usable = detect(*frame.cloud, settings, result);
  if (ros::Time::now() < start || !enabled_) return input_.countDropped();
  result.detections.processing_time = secondsSince(frame.received);
  output_.publish(result, settings);
  board_.setUsable(usable);
  if (usable) {
    errors_.clear(cloud_error);
    errors_.clear(frame_error);
    statistics_.processed(secondsSince(frame.received), age + secondsSince(frame.received));
  } else {
    statistics_.unusable();
  }
}

bool DetectorNode::detect(const sensor_msgs::PointCloud2& cloud, const NodeSettings& settings, FrameResult& result) {
  try {
    if (settings.tracking) {
      result = frame_detector_.follow(cloud, settings, output_.wantedExtras(), tracking_);
      if (!result.warning.empty()) errors_.warning("fixed_frame", result.warning);
    } else {
      tracking_.clear();
      result = frame_detector_.detect(cloud, settings, output_.wantedExtras());
    }
    return true;
  } catch (const std::exception& error) {
    errors_.error(cloud_error, "cloud of " + input_.topic() + ": " + error.what());
  }
  result.detections.header = FrameDetector::answerHeader(cloud.header, settings);
  result.detections.codebook = slot_.codebookName();
  result.support_sought = true;  // and none found
  return false;
}

DetectionArray DetectorNode::detect(const sensor_msgs::PointCloud2& cloud, const DetectionQuery& query) {
  const auto start = CloudInput::Clock::now();
  DetectionArray detections = frame_detector_.detect(cloud, nodeSettings(), {}, query).detections;
  detections.processing_time = secondsSince(start);
  return detections;
}

NodeAccess DetectorNode::nodeAccess() {
  return {[this](double timeout) { return input_.next(timeout); },
          [this](const sensor_msgs::PointCloud2ConstPtr& cloud, const DetectionQuery& query) {
            return detect(*cloud, query);
          },
          [this](bool enabled) { setEnabled(enabled); },
          [this](const sensor_msgs::PointCloud2& cloud) { return frame_detector_.read(cloud, nodeSettings()); },
          [this](const std_msgs::Header& cloud) { return frame_detector_.fixedPose(cloud, nodeSettings()); }};
}

void DetectorNode::setEnabled(bool enabled) {
  enabled_ = enabled;
  board_.setEnabled(enabled);
  updateWanted();
  if (!enabled) output_.clearMarkers();
}

void DetectorNode::updateWanted() {
  const std::lock_guard<std::mutex> lock(wanting_);
  const NodeSettings settings = nodeSettings();
  const bool wanted = enabled_ && (settings.always_on || settings.publish_tf || output_.listened());
  input_.setWanted(wanted);
  board_.setDetecting(wanted);
}

void DetectorNode::watch() {
  try {
    watchTime();
    watchMaster();
    watchSilence();
    diagnostics_.update();
    errors_.clear(watch_error);
  } catch (const std::exception& error) {
    errors_.error(watch_error, error.what());
  }
}

void DetectorNode::watchTime() {
  const double back = time_watch_.jumpedBack();
  if (back == 0) return;
  ROS_WARN_STREAM("time jumped back by " << back << " s: transforms and waiting clouds are forgotten");
  transforms_.clear();
  statistics_.reset();
}

void DetectorNode::watchMaster() {
  input_.refresh();
  listenToTransforms();
  advertiseTransforms();
  advertiseObjects();
  if (input_.lacksMaster()) {
    errors_.warning("master", masterIsAway() + ": " + input_.topic() + " is subscribed to when it is back");
  }
}

void DetectorNode::watchSilence() {
  const double limit = nodeSettings().silence_warning, silence = input_.silence();
  if (limit == 0 || silence <= limit) return;
  errors_.warning("silence", "no cloud on " + input_.topic() + " for more than " + sks::toText(limit) +
                                 " s: " + input_.describePublishers());
}

void DetectorNode::listenToTransforms() {
  const NodeSettings settings = nodeSettings();
  const bool any = !settings.fixed_frame.empty() || !settings.target_frame.empty() || !settings.sensor_frame.empty();
  if (any) transforms_.listen();
}

void DetectorNode::advertiseTransforms() {
  output_.advertiseTransforms(nodeSettings().publish_tf);
}

void DetectorNode::advertiseObjects() {
  const auto detector = slot_.detector();
  output_.setObjects(detector ? detector->codebook().objects : std::vector<std::string>());
}

NodeSettings DetectorNode::nodeSettings() const {
  const std::lock_guard<std::mutex> lock(settings_mutex_);
  return settings_;
}

Configuration DetectorNode::configuration() const {
  return {slot_.settings(), nodeSettings()};
}

Configuration DetectorNode::apply(const Configuration& wanted) {
  checkFramePattern(wanted.node.tf_frame);
  slot_.setSettings(withThreads(wanted.detector));
  {
    const std::lock_guard<std::mutex> lock(settings_mutex_);
    settings_ = wanted.node;
  }
  listenToTransforms();
  advertiseTransforms();
  updateWanted();
  errors_.clear(parameter_error);
  return configuration();
}

void DetectorNode::refuse(const std::string& kind, const std::string& reason) {
  ROS_ERROR_STREAM(reason);
  board_.setError(kind, reason);
}

}  // namespace sks_detector
