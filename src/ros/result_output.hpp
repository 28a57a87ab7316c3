// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sks_detector/DetectionArray.h>

namespace sks_detector {

/// A topic with the detections in the messages of a package that need not be installed: src/ros/outputs has one file
/// for each, which is built where its package is found, and which lists itself in resultOutputs().
class ResultOutput {
public:
  ResultOutput() = default;
  virtual ~ResultOutput() = default;
  ResultOutput(const ResultOutput&) = delete;
  ResultOutput& operator=(const ResultOutput&) = delete;

  virtual bool listened() const = 0;
  /// @param places of each detection: that of its object in the codebook
  virtual void publish(const DetectionArray& detections, const std::vector<std::uint32_t>& places) = 0;
};

/// @param changed called when somebody came to listen or left
using MakeResultOutput = std::function<std::unique_ptr<ResultOutput>(ros::NodeHandle& private_handle,
                                                                     ros::SubscriberStatusCallback changed)>;

/// All that are built. To be added to before main() alone.
std::vector<MakeResultOutput>& resultOutputs();

/// One topic, whose message a function makes where somebody listens.
template <typename Message>
class MessageOutput : public ResultOutput {
public:
  using Make = Message (*)(const DetectionArray&, const std::vector<std::uint32_t>& places);

  MessageOutput(ros::NodeHandle& private_handle, const char* topic, const ros::SubscriberStatusCallback& changed,
                Make make)
      : make_(make), publisher_(private_handle.advertise<Message>(topic, 1, changed, changed)) {}

  bool listened() const override { return publisher_.getNumSubscribers() > 0; }
  void publish(const DetectionArray& detections, const std::vector<std::uint32_t>& places) override {
    if (listened()) publisher_.publish(make_(detections, places));
  }

  /// Lists such a topic in resultOutputs(). @return something, so that a constant can be made of it
  static bool enlist(const char* topic, Make make) {
    resultOutputs().push_back([topic, make](ros::NodeHandle& handle, const ros::SubscriberStatusCallback& changed) {
      return std::make_unique<MessageOutput>(handle, topic, changed, make);
    });
    return true;
  }

private:
  Make make_;
  ros::Publisher publisher_;
};

}  // namespace sks_detector
