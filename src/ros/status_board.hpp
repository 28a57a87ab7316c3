// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sks_detector/Status.h>

#include <sks_detector/progress.hpp>

#include "ros/detector_slot.hpp"

namespace sks_detector {

/// The kind of error of a codebook that cannot be loaded: it goes when another one is in use.
constexpr const char* codebook_error = "codebook";

/// E.g. "training 12 of 95: mug/003.pcd".
std::string progressText(const sks::ProgressState& progress);
/// 0 to 1; 0 where it is not known.
float progressFraction(const sks::ProgressState& progress);

/// `~status`, latched: published whenever something in it changes. Safe to use from several threads.
class StatusBoard {
public:
  StatusBoard(ros::NodeHandle& private_handle, const DetectorSlot& slot);

  /// Whether clouds are processed at the moment: somebody listens, or ~always_on.
  void setDetecting(bool detecting);
  /// Whether the last cloud could be used; starts anew when detecting does.
  void setUsable(bool usable);
  void setEnabled(bool enabled);

  void trainingStarted();
  void trainingProgress(const sks::ProgressState& progress);  ///< publishes at most ten times a second
  void trainingEnded();

  /// Objects with captured views that are not trained yet.
  void setCaptured(const std::vector<std::string>& objects);
  /// The codebook in the slot was changed.
  void codebookChanged();
  /// Called by codebookChanged(), from its thread.
  void setCodebookListener(std::function<void()> listener);
  /// Remembers an error for people who look later; the caller logs and replies it.
  /// @param kind what failed: a new error of a kind replaces the old one
  void setError(const std::string& kind, const std::string& message);
  bool hasError(const std::string& kind) const;
  /// What failed works again: the status goes back to the latest error of another kind, if there is one.
  void clearError(const std::string& kind);

  /// What the status is at the moment.
  Status current() const;

private:
  using Clock = std::chrono::steady_clock;

  /// Makes a change and, if it returns that it is worth publishing, publishes.
  void change(const std::function<bool()>& change);
  std::uint8_t state() const;
  void showLatestError();

  struct Failure {
    std::string message;
    ros::Time stamp;
    std::uint64_t number = 0;  // of setError(): stamps may jump back
  };

  const DetectorSlot& slot_;
  mutable std::mutex mutex_;
  Status status_;
  bool detecting_ = false;
  bool usable_ = true;
  bool enabled_ = true;
  bool training_ = false;
  Clock::time_point progress_published_;
  std::map<std::string, Failure> failures_;  // by kind
  std::uint64_t failure_count_ = 0;
  Clock::time_point error_published_;
  std::function<void()> codebook_listener_;
  ros::Publisher publisher_;
};

}  // namespace sks_detector
