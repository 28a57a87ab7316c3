// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include "ros/configuration.hpp"

namespace sks_detector {

/// What the private parameters say.
struct ParameterReading {
  Configuration configuration;        ///< defaults where nothing, or nothing usable, was given
  std::vector<std::string> given;     ///< keys that were taken from the parameter server, by their present names
  std::vector<std::string> errors;    ///< values that cannot be used, and why
  std::vector<std::string> warnings;  ///< unknown names, with the nearest known one, and old names
};

/// Reads all private parameters. The detector's settings are one set: a wrong value among them leaves all of them at
/// their defaults. Of the node's own settings each stands for itself.
ParameterReading readParameters(const ros::NodeHandle& private_handle);
/// The same from a tree of maps. @param name_space of the tree, for messages
ParameterReading readParameters(const XmlRpc::XmlRpcValue& tree, const std::string& name_space);

/// Keeps the parameter server in step with what is in force.
class ParameterMirror {
public:
  explicit ParameterMirror(const ros::NodeHandle& private_handle) : private_handle_(private_handle) {}

  /// Writes what differs from what was written last, at first everything; nothing while there is no master. Old names
  /// are deleted first: they would contradict the present ones when the node starts again.
  void write(const Configuration& configuration);

private:
  void deleteOldNames();

  ros::NodeHandle private_handle_;
  std::map<std::string, std::string> written_;
};

}  // namespace sks_detector
