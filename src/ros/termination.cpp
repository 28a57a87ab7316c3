// SPDX-License-Identifier: BSD-3-Clause
#include "ros/termination.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/xmlrpc_manager.h>

namespace sks_detector {
namespace {

constexpr double signal_poll_time = 0.1;  // [s] longest time until a request is noticed

// From the request; roslaunch sends SIGTERM 15 s after SIGINT, and kills 2 s later.
constexpr std::chrono::seconds until_shutdown(5), until_exit(12);

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

void request(int) {
  requested = true;
}

void requestByName(XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) {
  requested = true;
  result = ros::xmlrpc::responseInt(1, "", 0);
}

/// Ends what does not end by itself, nor starts, as roscpp waits for a master that is away. Runs until the process has
/// ended.
void watchTheEnd() {
  while (!requested) std::this_thread::sleep_for(std::chrono::duration<double>(signal_poll_time));
  std::this_thread::sleep_for(until_shutdown);
  std::thread(ros::shutdown).detach();  // it may wait for others
  std::this_thread::sleep_for(until_exit - until_shutdown);
  std::fputs("the process is ended, as it did not end by itself\n", stderr);
  std::_Exit(EXIT_FAILURE);
}

}  // namespace

void handleTermination() {
  std::signal(SIGINT, request);
  std::signal(SIGTERM, request);
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", requestByName);
  std::thread(watchTheEnd).detach();
}

void spinUntilTermination() {
  while (!requested && ros::ok()) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(signal_poll_time));
}

}  // namespace sks_detector
