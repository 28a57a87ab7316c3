// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/stub_node.hpp"

namespace sks_detector {
namespace {

constexpr int stub_threads = 4;

template <typename Request>
std::string objectOf(const Request& request) {
  return request.object;
}

template <typename Response>
Response success(const std::string& message) {
  Response response;
  response.success = true;
  response.message = message;
  return response;
}

dynamic_reconfigure::Config withThreshold(double threshold) {
  dynamic_reconfigure::Config config;
  config.doubles.resize(1);
  config.doubles[0].name = "detection.threshold";
  config.doubles[0].value = threshold;
  return config;
}

}  // namespace

StubNode::StubNode(const std::string& name) : handle_(name), spinner_(stub_threads, &queue_) {
  handle_.setCallbackQueue(&queue_);
  info_ = success<InfoResponse>("");
  capture_ = success<CaptureViewResponse>("captured");
  status_ = handle_.advertise<Status>("status", 1, true);
  detections_ = handle_.advertise<DetectionArray>("detections", 10);
  parameters_ = handle_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);

  advertise<UndoCapture>("undo_capture", objectOf, success<UndoCaptureResponse>("taken back"));
  advertise<Train>(
      "train",
      [](const TrainRequest& request) { return std::string(request.captured ? "captured" : "") + request.dataset; },
      success<TrainResponse>("trained"));
  advertise<LoadCodebook>(
      "load_codebook", [](const LoadCodebookRequest& request) { return request.path; },
      success<LoadCodebookResponse>("loaded"));
  advertise<SaveCodebook>(
      "save_codebook",
      [](const SaveCodebookRequest& request) { return request.path + (request.overwrite ? " overwrite" : ""); },
      success<SaveCodebookResponse>("saved"));
  advertise<RemoveObject>(
      "remove_object",
      [](const RemoveObjectRequest& request) { return request.object + (request.delete_views ? " views" : ""); },
      success<RemoveObjectResponse>("removed"));

  using Info = sks_detector::Info;
  const boost::function<bool(Info::Request&, Info::Response&)> info = [this](Info::Request&, Info::Response& response) {
    waitWhileHanging();
    const std::lock_guard<std::mutex> lock(mutex_);
    response = info_;
    return true;
  };
  services_.push_back(handle_.advertiseService("info", info));
  const boost::function<bool(CaptureView::Request&, CaptureView::Response&)> capture =
      [this](CaptureView::Request& request, CaptureView::Response& response) {
        note("capture_view " + request.object);
        waitWhileHanging();
        const std::lock_guard<std::mutex> lock(mutex_);
        response = capture_;
        return true;
      };
  services_.push_back(handle_.advertiseService("capture_view", capture));
  const boost::function<bool(std_srvs::Trigger::Request&, std_srvs::Trigger::Response&)> cancel =
      [this](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
        note("cancel_training ");
        response = success<std_srvs::TriggerResponse>("the training ends");
        return true;
      };
  services_.push_back(handle_.advertiseService("cancel_training", cancel));
  using dynamic_reconfigure::Reconfigure;
  const boost::function<bool(Reconfigure::Request&, Reconfigure::Response&)> reconfigure =
      [this](Reconfigure::Request& request, Reconfigure::Response& response) {
        const dynamic_reconfigure::DoubleParameter& asked = request.config.doubles.at(0);
        note("set_parameters " + asked.name + " " + std::to_string(int(std::lround(100 * asked.value))));
        const std::lock_guard<std::mutex> lock(mutex_);
        response.config = withThreshold(forced_threshold_ < 0 ? asked.value : forced_threshold_);
        return true;
      };
  services_.push_back(handle_.advertiseService("set_parameters", reconfigure));
  status_.publish(Status());
  spinner_.start();
}

StubNode::~StubNode() {
  setHanging(false);
  for (ros::ServiceServer& service : services_) service.shutdown();
  spinner_.stop();
}

template <typename Service>
void StubNode::advertise(const std::string& name, std::string (*describe)(const typename Service::Request&),
                         const typename Service::Response& response) {
  const boost::function<bool(typename Service::Request&, typename Service::Response&)> callback =
      [=](typename Service::Request& request, typename Service::Response& reply) {
        note(name + " " + describe(request));
        waitWhileHanging();
        reply = response;
        return true;
      };
  services_.push_back(handle_.advertiseService(name, callback));
}

void StubNode::publishThreshold(double threshold) {
  parameters_.publish(withThreshold(threshold));
}

std::vector<std::string> StubNode::requests() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return requests_;
}

void StubNode::setHanging(bool hanging) {
  const std::lock_guard<std::mutex> lock(mutex_);
  hanging_ = hanging;
  changed_.notify_all();
}

void StubNode::setInfo(const InfoResponse& info) {
  const std::lock_guard<std::mutex> lock(mutex_);
  info_ = info;
}

void StubNode::setCapture(const CaptureViewResponse& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  capture_ = response;
}

void StubNode::setForcedThreshold(double threshold) {
  const std::lock_guard<std::mutex> lock(mutex_);
  forced_threshold_ = threshold;
}

void StubNode::note(const std::string& request) {
  const std::lock_guard<std::mutex> lock(mutex_);
  requests_.push_back(request);
}

void StubNode::waitWhileHanging() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return !hanging_; });
}

}  // namespace sks_detector
