// SPDX-License-Identifier: BSD-3-Clause
#include "ros/train_action_server.hpp"

#include <chrono>
#include <memory>

#include <ros/console.h>

namespace sks_detector {
namespace {

constexpr std::chrono::milliseconds feedback_period(250);

Train::Request requestOf(const TrainGoal& goal) {
  Train::Request request;
  request.dataset = goal.dataset;
  request.captured = goal.captured;
  request.name = goal.name;
  request.output = goal.output;
  request.overwrite = goal.overwrite;
  request.settings = goal.settings;
  return request;
}

TrainResult resultOf(const Train::Response& response) {
  TrainResult result;
  result.success = true;
  result.message = response.message;
  result.codebook = response.codebook;
  result.objects = response.objects;
  result.views = response.views;
  result.words = response.words;
  result.seconds = response.seconds;
  return result;
}

TrainResult failedResult(const std::string& message) {
  TrainResult result;
  result.message = message;
  return result;
}

bool isPreempted(const actionlib::ServerGoalHandle<sks_detector::TrainAction>& goal) {
  return goal.getGoalStatus().status == actionlib_msgs::GoalStatus::PREEMPTING;
}

}  // namespace

TrainActionServer::TrainActionServer(ServiceContext& context, TrainingServices& training, const ros::NodeHandle& handle)
    : context_(context),
      training_(training),
      name_(handle.resolveName("train_action")),
      server_(
          handle, "train_action", [this](Goal goal) { receive(goal); },
          [](Goal) {},  // the training looks at its goal whenever it goes on
          false),
      thread_([this] { serve(); }) {
  server_.start();
}

void TrainActionServer::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void TrainActionServer::receive(Goal goal) {
  std::string reason = training_runs;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_) reason = "the node shuts down";
    if (!busy_ && !stopped_) {
      busy_ = true;
      next_ = goal;
      changed_.notify_all();
      return;
    }
  }
  ROS_WARN_STREAM(name_ << ": " << reason);
  goal.setRejected(failedResult(reason), reason);
}

void TrainActionServer::serve() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopped_ || next_; });
    if (!next_) return;
    Goal goal = *next_;
    next_.reset();
    lock.unlock();
    train(goal);
    lock.lock();
  }
}

void TrainActionServer::train(Goal& goal) {
  const Train::Request request = requestOf(*goal.getGoal());
  Train::Response response;
  bool accepted = false;
  const TrainingListener listener = listenerOf(goal, accepted);
  const std::string failure = context_.attempt(name_, [&] { training_.train(request, response, listener); });
  {  // who hears of the outcome may send the next goal at once
    const std::lock_guard<std::mutex> lock(mutex_);
    busy_ = false;
  }
  if (failure.empty()) {
    ROS_INFO_STREAM(name_ << ": " << response.message);
    goal.setSucceeded(resultOf(response), response.message);
  } else if (!accepted) {
    goal.setRejected(failedResult(failure), failure);
  } else if (isPreempted(goal)) {
    goal.setCanceled(failedResult(failure), failure);
  } else {
    goal.setAborted(failedResult(failure), failure);
  }
}

TrainingListener TrainActionServer::listenerOf(Goal& goal, bool& accepted) {
  using Clock = std::chrono::steady_clock;
  TrainingListener listener;
  listener.started = [&] {
    accepted = true;
    goal.setAccepted();
  };
  listener.progressed = [&goal, this, told = Clock::time_point()](const sks::ProgressState& progress) mutable {
    if (isPreempted(goal)) context_.training.cancel();
    if (Clock::now() - told < feedback_period) return;
    told = Clock::now();
    TrainFeedback feedback;
    feedback.progress = progressText(progress);
    feedback.fraction = progressFraction(progress);
    goal.publishFeedback(feedback);
  };
  return listener;
}

}  // namespace sks_detector
