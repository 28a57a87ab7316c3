// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sks_detector/Train.h>
#include <std_srvs/Trigger.h>

#include <sks_detector/progress.hpp>

#include "ros/service_context.hpp"

namespace sks_detector {

/// Who is told of a training; called from its thread.
struct TrainingListener {
  std::function<void()> started;  ///< no other training runs
  std::function<void(const sks::ProgressState& progress)> progressed;
};

/// `~train` and `~cancel_training`. They throw what the caller is to reply.
class TrainingServices {
public:
  explicit TrainingServices(ServiceContext& context) : context_(context) {}

  void train(const Train::Request& request, Train::Response& response) { train(request, response, {}); }
  /// @param listener its functions may be empty
  void train(const Train::Request& request, Train::Response& response, const TrainingListener& listener);
  void cancel(const std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

private:
  sks::Settings settingsOf(const Train::Request& request) const;
  /// All of a training; the old codebook is in use until the last step.
  void work(const Train::Request& request, const sks::Progress& progress, Train::Response& response,
            std::vector<std::string>& warnings);

  ServiceContext& context_;
};

}  // namespace sks_detector
