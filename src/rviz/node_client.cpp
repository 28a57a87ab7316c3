// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/node_client.hpp"

#include <cmath>

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/names.h>
#include <sks_detector/LoadCodebook.h>
#include <sks_detector/RemoveObject.h>
#include <sks_detector/SaveCodebook.h>
#include <sks_detector/Train.h>
#include <sks_detector/UndoCapture.h>
#include <std_srvs/Trigger.h>

#include "core/settings/number_format.hpp"
#include "rviz/node_topics.hpp"

namespace sks_detector {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds receive_period{50};
constexpr milliseconds info_period{2000};
constexpr seconds info_bound{5};
constexpr seconds call_bound{60};         // of what the node does at once; a large codebook takes its time to be read
constexpr double capture_timeout = 10;    // [s] for the next cloud
constexpr seconds training_silence{600};  // the longest step of a training that tells no progress
constexpr double same_value = 1e-6;       // of a threshold

QString text(const std::string& utf8) {
  return QString::fromStdString(utf8);
}

/// The full name, or why there is none.
std::string resolved(const std::string& name, std::string& problem) {
  try {
    if (!name.empty()) return ros::names::resolve(name);
    problem = "give the name of the detector's node, e.g. /detector";
  } catch (const ros::InvalidNameException& error) {
    problem = error.what();
  }
  return "";
}

}  // namespace

NodeClient::NodeClient() {
  connect(&receive_timer_, &QTimer::timeout, this, [this] {
    if (topics_) topics_->receive();
  });
  receive_timer_.start(receive_period);
  info_timer_.setSingleShot(true);
  connect(&info_timer_, &QTimer::timeout, this, &NodeClient::askInfo);
}

NodeClient::~NodeClient() {
  releaseTopics();
}

void NodeClient::setNode(const std::string& name) {
  calls_.abandonAll();
  releaseTopics();
  busy_.clear();
  stream_.clear();
  info_timer_.stop();
  std::string problem;
  node_ = resolved(name, problem);
  Q_EMIT busyChanged();
  Q_EMIT reached(text(node_.empty() ? problem : "waiting for " + node_));
  if (!node_.empty()) askInfo();
}

void NodeClient::connectTopics() {
  const auto work = [node = node_, this](CallState&) -> AsyncCalls::Then {
    if (!masterAnswers()) return {};
    try {
      const auto topics = std::make_shared<NodeTopics>(node);
      return [this, topics] { useTopics(topics); };
    } catch (const ros::Exception&) {  // tried again by the next askInfo(), which says what is wrong
      return {};
    }
  };
  calls_.run(nameOf("topics"), work, info_bound, {});
}

void NodeClient::useTopics(const std::shared_ptr<NodeTopics>& topics) {
  if (topics_) return;
  topics_ = topics;
  topics->on_status = [this](const Status& status) {
    calls_.refresh(nameOf("train"));
    Q_EMIT statusReceived(status);
  };
  topics->on_detections = [this](const DetectionArray& array, ros::Time received) {
    stream_.add(StreamWatch::Clock::now(), (received - array.header.stamp).toSec(), array.processing_time);
  };
  topics->on_threshold = [this](double threshold) { Q_EMIT thresholdReceived(threshold); };
}

void NodeClient::releaseTopics() {
  if (!topics_) return;
  topics_->on_status = nullptr;
  topics_->on_detections = nullptr;
  topics_->on_threshold = nullptr;
  // to unsubscribe asks the master, for which the window must not wait
  calls_.run("",
             [topics = std::move(topics_)](CallState&) mutable -> AsyncCalls::Then {
               topics.reset();
               return {};
             },
             info_bound, {});
  topics_.reset();
}

void NodeClient::askInfo() {
  if (!topics_) connectTopics();
  calls_.call<Info>(nameOf("info"), InfoRequest(), info_bound,
                    [this](const std::string& failure, const InfoResponse& response) {
                      Q_EMIT reached(text(failure));
                      if (failure.empty()) Q_EMIT infoReceived(response);
                      info_timer_.start(info_period);
                    });
}

void NodeClient::end(Action action, bool success, const std::string& message) {
  busy_.erase(action);
  Q_EMIT replied(success, text(message));
  Q_EMIT busyChanged();
  if (info_timer_.isActive()) info_timer_.start(0);  // what it has changed
}

template <typename Service, typename Then>
void NodeClient::ask(Action action, const std::string& service, const typename Service::Request& request,
                     milliseconds bound, Then then) {
  if (node_.empty() || !busy_.insert(action).second) return;
  Q_EMIT busyChanged();
  calls_.call<Service>(nameOf(service), request, bound,
                       [=](const std::string& failure, const typename Service::Response& response) {
                         const bool success = failure.empty() && response.success;
                         if (success) then(response);
                         end(action, success, failure.empty() ? response.message : failure);
                       });
}

void NodeClient::captureView(const std::string& object) {
  CaptureViewRequest request;
  request.object = object;
  request.timeout = capture_timeout;
  ask<CaptureView>(Action::capture, "capture_view", request, call_bound,
                   [=](const CaptureViewResponse& response) { Q_EMIT captured(text(object), response); });
}

void NodeClient::undoCapture(const std::string& object) {
  UndoCaptureRequest request;
  request.object = object;
  ask<UndoCapture>(Action::undo, "undo_capture", request, call_bound,
                   [=](const UndoCaptureResponse&) { Q_EMIT viewsTaken(text(object)); });
}

void NodeClient::trainCaptured() {
  TrainRequest request;
  request.captured = true;
  ask<Train>(Action::train, "train", request, training_silence, [](const TrainResponse&) {});
}

void NodeClient::cancelTraining() {
  ask<std_srvs::Trigger>(Action::cancel, "cancel_training", std_srvs::TriggerRequest(), call_bound,
                         [](const std_srvs::TriggerResponse&) {});
}

void NodeClient::loadCodebook(const std::string& path) {
  LoadCodebookRequest request;
  request.path = path;
  ask<LoadCodebook>(Action::load, "load_codebook", request, call_bound, [](const LoadCodebookResponse&) {});
}

void NodeClient::saveCodebook(const std::string& path, bool overwrite) {
  SaveCodebookRequest request;
  request.path = path;
  request.overwrite = overwrite;
  ask<SaveCodebook>(Action::save, "save_codebook", request, call_bound, [](const SaveCodebookResponse&) {});
}

void NodeClient::removeObject(const std::string& object, bool delete_views) {
  RemoveObjectRequest request;
  request.object = object;
  request.delete_views = delete_views;
  ask<RemoveObject>(Action::remove, "remove_object", request, call_bound, [=](const RemoveObjectResponse& response) {
    if (response.views > 0) Q_EMIT viewsTaken(text(object));
  });
}

void NodeClient::setThreshold(double threshold) {
  using dynamic_reconfigure::Reconfigure;
  if (node_.empty() || !busy_.insert(Action::threshold).second) return;
  Q_EMIT busyChanged();
  Reconfigure::Request request;
  request.config.doubles.resize(1);
  request.config.doubles[0].name = threshold_parameter;
  request.config.doubles[0].value = threshold;
  calls_.call<Reconfigure>(nameOf("set_parameters"), request, info_bound,
                           [=](const std::string& failure, const Reconfigure::Response& response) {
                             double in_force = std::nan("");
                             readThreshold(response.config, [&](double value) { in_force = value; });
                             const bool success = failure.empty() && std::abs(in_force - threshold) < same_value;
                             if (std::isfinite(in_force)) Q_EMIT thresholdReceived(in_force);
                             end(Action::threshold, success,
                                 success           ? sks::formatted("detections from a score of %.2f", threshold)
                                 : failure.empty() ? "the threshold was refused: see the log of the node"
                                                   : failure);
                           });
}

}  // namespace sks_detector
