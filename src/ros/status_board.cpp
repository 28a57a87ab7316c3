// SPDX-License-Identifier: BSD-3-Clause
#include "ros/status_board.hpp"

#include <algorithm>
#include <utility>

#include <ros/time.h>

#include "core/settings/shown_text.hpp"

namespace sks_detector {
namespace {

constexpr std::chrono::milliseconds progress_period(100);
constexpr std::chrono::seconds same_error_period(1);

}  // namespace

std::string progressText(const sks::ProgressState& progress) {
  const std::string of = progress.total > 0 ? " of " + std::to_string(progress.total) : "";
  return progress.stage + " " + std::to_string(progress.done) + of +
         (progress.item.empty() ? "" : ": " + sks::shown(progress.item));
}

float progressFraction(const sks::ProgressState& progress) {
  return progress.total > 0 ? float(progress.done) / float(progress.total) : 0;
}

StatusBoard::StatusBoard(ros::NodeHandle& private_handle, const DetectorSlot& slot)
    : slot_(slot), publisher_(private_handle.advertise<Status>("status", 1, true)) {
  codebookChanged();
}

void StatusBoard::setDetecting(bool detecting) {
  change([&] {
    if (std::exchange(detecting_, detecting) == detecting) return false;
    usable_ = true;
    return true;
  });
}

void StatusBoard::setUsable(bool usable) {
  change([&] { return std::exchange(usable_, usable) != usable; });
}

void StatusBoard::setEnabled(bool enabled) {
  change([&] { return std::exchange(enabled_, enabled) != enabled; });
}

void StatusBoard::trainingStarted() {
  change([&] {
    training_ = true;
    status_.progress = "training";
    status_.progress_fraction = 0;
    return true;
  });
}

void StatusBoard::trainingProgress(const sks::ProgressState& progress) {
  change([&] {
    status_.progress = progressText(progress);
    status_.progress_fraction = progressFraction(progress);
    if (Clock::now() - progress_published_ < progress_period) return false;
    progress_published_ = Clock::now();
    return true;
  });
}

void StatusBoard::trainingEnded() {
  change([&] {
    training_ = false;
    status_.progress.clear();
    status_.progress_fraction = 0;
    return true;
  });
}

void StatusBoard::setCaptured(const std::vector<std::string>& objects) {
  change([&] {
    status_.captured = objects;
    return true;
  });
}

void StatusBoard::codebookChanged() {
  change([&] {
    const auto detector = slot_.detector();
    status_.codebook = slot_.codebookName();
    status_.codebook_file = slot_.codebookFile();
    status_.objects = detector ? detector->codebook().objects : std::vector<std::string>();
    status_.words = detector ? std::uint32_t(detector->codebook().words.size()) : 0;
    if (detector && failures_.erase(codebook_error) > 0) showLatestError();
    return true;
  });
  std::function<void()> listener;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    listener = codebook_listener_;
  }
  if (listener) listener();
}

void StatusBoard::setCodebookListener(std::function<void()> listener) {
  const std::lock_guard<std::mutex> lock(mutex_);
  codebook_listener_ = std::move(listener);
}

void StatusBoard::setError(const std::string& kind, const std::string& text) {
  const std::string message = sks::shownMessage(text);
  change([&] {
    const bool same = status_.last_error == message;
    failures_[kind] = {message, ros::Time::now(), ++failure_count_};
    showLatestError();
    if (same && Clock::now() - error_published_ < same_error_period) return false;
    error_published_ = Clock::now();
    return true;
  });
}

bool StatusBoard::hasError(const std::string& kind) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failures_.count(kind) > 0;
}

void StatusBoard::clearError(const std::string& kind) {
  change([&] {
    if (failures_.erase(kind) == 0) return false;
    showLatestError();
    return true;
  });
}

void StatusBoard::showLatestError() {
  const auto latest = std::max_element(failures_.begin(), failures_.end(),
                                       [](const auto& a, const auto& b) { return a.second.number < b.second.number; });
  const Failure shown = latest == failures_.end() ? Failure() : latest->second;
  status_.last_error = shown.message;
  status_.last_error_stamp = shown.stamp;
}

Status StatusBoard::current() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

void StatusBoard::change(const std::function<bool()>& change) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool worth_publishing = change();
  status_.state = state();
  status_.header.stamp = ros::Time::now();
  if (worth_publishing) publisher_.publish(status_);
}

std::uint8_t StatusBoard::state() const {
  if (training_) return Status::TRAINING;
  if (!enabled_) return Status::DISABLED;
  if (status_.codebook.empty()) return Status::NO_CODEBOOK;
  if (!detecting_) return Status::READY;
  return usable_ ? Status::DETECTING : Status::FAILING;
}

}  // namespace sks_detector
