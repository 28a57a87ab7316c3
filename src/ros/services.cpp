// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services.hpp"

#include <string>
#include <utility>
#include <vector>

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/service_server.h>
#include <ros/spinner.h>
#include <std_srvs/SetBool.h>

#include "ros/cloud_services.hpp"
#include "ros/codebook_services.hpp"
#include "ros/service_context.hpp"
#include "ros/train_action_server.hpp"
#include "ros/training_services.hpp"
#include "ros/with_queue.hpp"

namespace sks_detector {
namespace {

constexpr int thread_count = 4;  // a training and two that wait for clouds leave one for ~cancel_training

}  // namespace

class Services::Implementation {
public:
  Implementation(const ros::NodeHandle& private_handle, DetectorSlot& slot, StatusBoard& board,
                 const NodeSettings& settings, NodeAccess node)
      : context_(slot, board, settings, std::move(node)), handle_(withQueue(private_handle, queue_)) {
    context_.updateStatus();
    using TrainMethod = void (TrainingServices::*)(const Train::Request&, Train::Response&);
    advertise<Train>("train", &training_, TrainMethod(&TrainingServices::train));
    advertise<std_srvs::Trigger>("cancel_training", &training_, &TrainingServices::cancel);
    advertise<LoadCodebook>("load_codebook", &codebooks_, &CodebookServices::load);
    advertise<SaveCodebook>("save_codebook", &codebooks_, &CodebookServices::save);
    advertise<RemoveObject>("remove_object", &codebooks_, &CodebookServices::removeObject);
    advertise<Info>("info", &codebooks_, &CodebookServices::info);
    advertise<Detect>("detect", &clouds_, &CloudServices::detect);
    advertise<CaptureView>("capture_view", &clouds_, &CloudServices::captureView);
    advertise<UndoCapture>("undo_capture", &clouds_, &CloudServices::undoCapture);
    advertise<std_srvs::SetBool>("enable", this, &Implementation::enable);
    spinner_.start();
  }

  ~Implementation() {
    context_.training.stop();
    train_action_.stop();
    for (ros::ServiceServer& server : servers_) server.shutdown();
    spinner_.stop();
  }

private:
  void enable(const std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    context_.node.enable(request.data);
    response.message = request.data ? "enabled" : "disabled";
  }

  template <typename Service, typename Object>
  void advertise(const std::string& name, Object* object,
                 void (Object::*method)(const typename Service::Request&, typename Service::Response&)) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    const std::string full_name = handle_.resolveName(name);
    const bool asked_often = name == "info" || name == "detect";
    const boost::function<bool(Request&, Response&)> callback = [=](Request& request, Response& response) {
      const std::string failure = context_.attempt(full_name, [&] { (object->*method)(request, response); });
      response.success = failure.empty();
      if (failure.empty()) {
        if (!asked_often) ROS_INFO_STREAM(full_name << ": " << response.message);
      } else {
        response = Response();
        response.message = failure;
      }
      return true;  // false would hide the message from the caller
    };
    servers_.push_back(handle_.advertiseService<Request, Response>(name, callback));
  }

  ServiceContext context_;
  CodebookServices codebooks_{context_};
  TrainingServices training_{context_};
  CloudServices clouds_{context_};
  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  TrainActionServer train_action_{context_, training_, handle_};
  ros::AsyncSpinner spinner_{thread_count, &queue_};
  std::vector<ros::ServiceServer> servers_;
};

Services::Services(const ros::NodeHandle& private_handle, DetectorSlot& slot, StatusBoard& board,
                   const NodeSettings& settings, NodeAccess node)
    : implementation_(std::make_unique<Implementation>(private_handle, slot, board, settings, std::move(node))) {}

Services::~Services() = default;

}  // namespace sks_detector
