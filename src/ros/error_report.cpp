// SPDX-License-Identifier: BSD-3-Clause
#include "ros/error_report.hpp"

#include <ros/console.h>

#include "core/settings/shown_text.hpp"

namespace sks_detector {
namespace {

constexpr std::chrono::seconds new_message_period(1), same_message_period(30);

}  // namespace

void ErrorReport::error(const std::string& kind, const std::string& message) {
  const bool is_due = isDue(kind, message);
  if (is_due) ROS_ERROR_STREAM(sks::shownMessage(message));
  if (is_due || !board_.hasError(kind)) board_.setError(kind, message);
}

void ErrorReport::clear(const std::string& kind) {
  board_.clearError(kind);
}

void ErrorReport::warning(const std::string& kind, const std::string& message) {
  if (isDue(kind, message)) ROS_WARN_STREAM(sks::shownMessage(message));
}

bool ErrorReport::isDue(const std::string& kind, const std::string& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Clock::time_point now = Clock::now();
  const auto [last, is_first] = said_.emplace(kind, Said{message, now});
  if (is_first) return true;
  const auto period = last->second.message == message ? same_message_period : new_message_period;
  if (now - last->second.when < period) return false;
  last->second = {message, now};
  return true;
}

}  // namespace sks_detector
