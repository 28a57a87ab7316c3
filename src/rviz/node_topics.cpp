// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/node_topics.hpp"

#include <boost/function.hpp>

namespace sks_detector {
namespace {

constexpr std::uint32_t status_queue = 10;
constexpr std::uint32_t detections_queue = 100;  // what comes between two looks, as each counts for the rate

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
  status = handle.subscribe<Status>("status", status_queue, take_status);
  detections = handle.subscribe<DetectionArray>("detections", detections_queue, take_detections);
  parameters = handle.subscribe<dynamic_reconfigure::Config>("parameter_updates", status_queue, take_parameters);
}

}  // namespace sks_detector
