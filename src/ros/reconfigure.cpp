// SPDX-License-Identifier: BSD-3-Clause
#include "ros/reconfigure.hpp"

#include <exception>
#include <utility>
#include <vector>

#include <ros/console.h>

#include "ros/reconfigure_messages.hpp"

namespace sks_detector {

Reconfigure::Reconfigure(ros::NodeHandle& private_handle, const Configuration& in_force, Apply apply, Refused refused)
    : in_force_(in_force), mirror_(private_handle), apply_(std::move(apply)), refused_(std::move(refused)) {
  descriptions_ = private_handle.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  descriptions_.publish(parameterDescriptions());
  updates_ = private_handle.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  publish();
  service_ = private_handle.advertiseService("set_parameters", &Reconfigure::set, this);
}

void Reconfigure::update(const Configuration& in_force) {
  const std::lock_guard<std::mutex> lock(mutex_);
  in_force_ = in_force;
  publish();
}

bool Reconfigure::set(dynamic_reconfigure::Reconfigure::Request& request,
                      dynamic_reconfigure::Reconfigure::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    std::vector<std::string> warnings;
    const Configuration wanted = overlaid(in_force_, request.config, warnings);
    for (const std::string& warning : warnings) ROS_WARN_STREAM("dynamic_reconfigure: " << warning);
    in_force_ = apply_(wanted);
  } catch (const std::exception& error) {
    refused_(std::string("parameters are left as they were: ") + error.what());
  }
  publish();  // also what was refused: whoever asked for it shows it otherwise
  response.config = toMessage(in_force_);
  return true;
}

void Reconfigure::publish() {
  mirror_.write(in_force_);
  updates_.publish(toMessage(in_force_));
}

}  // namespace sks_detector
