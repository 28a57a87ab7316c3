// SPDX-License-Identifier: BSD-3-Clause
#include "ros/termination.hpp"

#include <atomic>
#include <csignal>

#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/xmlrpc_manager.h>

namespace sks_detector {
namespace {

constexpr double poll_time = 0.1;  // [s] longest time until a request is noticed

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

void request(int) {
  requested = true;
}

void requestByName(XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) {
  requested = true;
  result = ros::xmlrpc::responseInt(1, "", 0);
}

}  // namespace

void handleTermination() {
  std::signal(SIGINT, request);
  std::signal(SIGTERM, request);
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", requestByName);
}

void spinUntilTermination() {
  while (!requested && ros::ok()) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(poll_time));
}

}  // namespace sks_detector
