// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <actionlib/server/action_server.h>
#include <ros/node_handle.h>
#include <sks_detector/TrainAction.h>

#include "ros/service_context.hpp"
#include "ros/training_services.hpp"

namespace sks_detector {

/// `~train_action`: what `~train` does, with feedback and preemption. A goal is rejected while any training runs;
/// preemption cancels its training, and the old codebook stays in use.
class TrainActionServer {
public:
  /// @param context, training must outlive it
  /// @param handle whose queue calls back
  TrainActionServer(ServiceContext& context, TrainingServices& training, const ros::NodeHandle& handle);
  ~TrainActionServer() { stop(); }
  TrainActionServer(const TrainActionServer&) = delete;
  TrainActionServer& operator=(const TrainActionServer&) = delete;

  /// Rejects goals to come, and waits for the end of a training: cancel it before.
  void stop();

private:
  using Server = actionlib::ActionServer<sks_detector::TrainAction>;
  using Goal = Server::GoalHandle;

  void receive(Goal goal);
  /// What the thread does: one goal after the other.
  void serve();
  void train(Goal& goal);
  /// Lets a training go on or, after preemption, ends it. Tells the goal's client a few times a second.
  TrainingListener listenerOf(Goal& goal, bool& accepted);

  ServiceContext& context_;
  TrainingServices& training_;
  const std::string name_;  // resolved

  std::mutex mutex_;  // guards the next four; goals are never told anything while it is held
  std::condition_variable changed_;
  std::optional<Goal> next_;
  bool busy_ = false;  // from when a goal came until its outcome is known
  bool stopped_ = false;

  Server server_;
  std::thread thread_;
};

}  // namespace sks_detector
