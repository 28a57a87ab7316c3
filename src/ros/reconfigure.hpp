// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>

#include "ros/parameters.hpp"

namespace sks_detector {

/// dynamic_reconfigure's side of the node, fed from the one source of settings: no .cfg file is generated. Unlike
/// dynamic_reconfigure::Server it refuses a set that is invalid, as a whole, instead of clamping it. Keeps the
/// parameter server in step. Safe to use from several threads.
class Reconfigure {
public:
  /// Puts a configuration in force and returns what then is; throws sks::Error and leaves all as it was.
  using Apply = std::function<Configuration(const Configuration& wanted)>;
  /// Told why a set was refused.
  using Refused = std::function<void(const std::string& reason)>;

  Reconfigure(ros::NodeHandle& private_handle, const Configuration& in_force, Apply apply, Refused refused);

  /// What is in force was changed by others.
  void update(const Configuration& in_force);

private:
  bool set(dynamic_reconfigure::Reconfigure::Request& request, dynamic_reconfigure::Reconfigure::Response& response);
  void publish();

  std::mutex mutex_;
  Configuration in_force_;
  ParameterMirror mirror_;
  Apply apply_;
  Refused refused_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace sks_detector
