// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/node_topics.hpp"

#include <mutex>

#include <boost/function.hpp>

namespace sks_detector {
namespace {

constexpr std::uint32_t status_queue = 10;
constexpr std::uint32_t detections_queue = 100;  // what comes between two looks, as each counts for the rate

/// One thread subscribes or unsubscribes at a time. Else roscpp may tell the master of a new subscription before it
/// tells it of the end of an old one, and the master then knows of none.
std::mutex& subscribing() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

const char* const threshold_parameter = "detection.threshold";

void readThreshold(const dynamic_reconfigure::Config& config, const std::function<void(double)>& use) {
  for (const dynamic_reconfigure::DoubleParameter& parameter : config.doubles) {
    if (parameter.name == threshold_parameter) use(parameter.value);
  }
}

NodeTopics::NodeTopics(const std::string& node) : handle(node) {
  handle.setCallbackQueue(&queue);
  const boost::function<void(const Status::ConstPtr&)> take_status = [this](const Status::ConstPtr& message) {
    if (on_status) on_status(*message);
  };
  using Event = ros::MessageEvent<DetectionArray const>;
  const boost::function<void(const Event&)> take_detections = [this](const Event& event) {
    if (on_detections) on_detections(*event.getConstMessage(), event.getReceiptTime());
  };
  const boost::function<void(const dynamic_reconfigure::Config::ConstPtr&)> take_parameters =
      [this](const dynamic_reconfigure::Config::ConstPtr& message) {
        if (on_threshold) readThreshold(*message, on_threshold);
      };
  const std::lock_guard<std::mutex> lock(subscribing());
  status = handle.subscribe<Status>("status", status_queue, take_status);
  detections = handle.subscribe<DetectionArray>("detections", detections_queue, take_detections);
  parameters = handle.subscribe<dynamic_reconfigure::Config>("parameter_updates", status_queue, take_parameters);
}

NodeTopics::~NodeTopics() {
  const std::lock_guard<std::mutex> lock(subscribing());
  for (ros::Subscriber* subscriber : {&status, &detections, &parameters}) subscriber->shutdown();
}

}  // namespace sks_detector
