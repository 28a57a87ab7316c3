// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/Train.h>
#include <std_srvs/Trigger.h>

#include "ros/service_context.hpp"

namespace sks_detector {

/// `~train` and `~cancel_training`. They throw what the caller is to reply.
class TrainingServices {
public:
  explicit TrainingServices(ServiceContext& context) : context_(context) {}

  void train(const Train::Request& request, Train::Response& response);
  void cancel(const std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

private:
  sks::Settings settingsOf(const Train::Request& request) const;
  /// All of a training; the old codebook is in use until the last step.
  void work(const Train::Request& request, const sks::Progress& progress, Train::Response& response,
            std::vector<std::string>& warnings);

  ServiceContext& context_;
};

}  // namespace sks_detector
