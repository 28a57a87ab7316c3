// SPDX-License-Identifier: BSD-3-Clause
#include "ros/diagnostics.hpp"

#include <fstream>

#include <unistd.h>

#include <sks_detector/Status.h>

#include "core/settings/number_format.hpp"
#include "ros/master_access.hpp"

namespace sks_detector {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr std::size_t rate_window = 10;  // updates

/// Resident memory of the process [MB].
double residentMemory() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident = 0;
  statm >> pages >> resident;
  return resident * double(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

const char* describe(std::uint8_t state) {
  switch (state) {
    case sks_detector::Status::NO_CODEBOOK:
      return "no codebook";
    case sks_detector::Status::READY:
      return "ready: nobody listens, not subscribed";
    case sks_detector::Status::DETECTING:
      return "detecting";
    case sks_detector::Status::FAILING:
      return "the last cloud cannot be used";
    case sks_detector::Status::DISABLED:
      return "disabled by ~enable";
    default:
      return "training";
  }
}

}  // namespace

Diagnostics::Diagnostics(const ros::NodeHandle& private_handle, const DiagnosedParts& parts,
                         std::function<double()> silence_limit)
    : parts_(parts),
      silence_limit_(std::move(silence_limit)),
      updater_(private_handle, private_handle, private_handle.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("State", this, &Diagnostics::reportState);
  updater_.add("Input", this, &Diagnostics::reportInput);
  updater_.add("Detection", this, &Diagnostics::reportDetection);
  updater_.add("Tracking", this, &Diagnostics::reportTracking);
  updater_.add("Codebook", this, &Diagnostics::reportCodebook);
  updater_.add("Process", this, &Diagnostics::reportProcess);
}

void Diagnostics::update() {
  updater_.force_update();  // its own period goes by the clock of ROS, which may stand still or jump
}

void Diagnostics::reset() {
  received_.clear();
}

void Diagnostics::reportState(Status& status) {
  const sks_detector::Status state = parts_.board.current();
  const bool fails = state.state == sks_detector::Status::NO_CODEBOOK || state.state == sks_detector::Status::FAILING;
  status.summary(fails ? DiagnosticStatus::ERROR : DiagnosticStatus::OK, describe(state.state));
  if (!state.progress.empty()) {
    status.add("training", state.progress);
    status.addf("training progress [%]", "%.0f", 100.0 * double(state.progress_fraction));
  }
  status.add("last error", state.last_error.empty() ? "none" : state.last_error);
}

void Diagnostics::reportInput(Status& status) {
  const CloudInput::Counts counts = parts_.input.counts();
  const FrameStatistics::Summary summary = parts_.statistics.summary();
  const double silence = parts_.input.silence(), limit = silence_limit_();
  if (parts_.input.lacksMaster()) {
    status.summary(DiagnosticStatus::WARN, "not subscribed: " + masterIsAway());
  } else if (!parts_.input.subscribed()) {
    status.summary(DiagnosticStatus::OK, "not subscribed");
  } else if (limit > 0 && silence > limit) {
    status.summary(DiagnosticStatus::WARN, "no cloud on " + parts_.input.topic() +
                                               sks::formatted(" for %.0f s: ", silence) +
                                               parts_.input.describePublishers());
  } else if (summary.too_old > too_old_) {
    status.summaryf(DiagnosticStatus::WARN, "clouds are dropped by ~max_input_age: they are %.2f s old", summary.age);
  } else {
    status.summary(DiagnosticStatus::OK, "receiving");
  }
  too_old_ = summary.too_old;
  status.add("topic", parts_.input.topic());
  status.add("publishers", parts_.input.publishers());
  status.addf("rate [Hz]", "%.2f", inputRate());
  status.addf("age [s]", "%.3f", summary.age);
  status.add("received", counts.received);
  status.add("dropped for newer ones", counts.dropped);
  status.add("of these lost on the way", counts.lost);
  status.add("dropped as too old", summary.too_old);
}

void Diagnostics::reportDetection(Status& status) {
  const FrameStatistics::Summary summary = parts_.statistics.summary();
  if (summary.unusable > unusable_) {
    const std::string reason = parts_.board.current().last_error;  // gone where a good cloud came since
    status.summary(DiagnosticStatus::ERROR,
                   reason.empty() ? "some clouds cannot be used: see the log" : "clouds cannot be used: " + reason);
  } else if (summary.frames == 0) {
    status.summary(DiagnosticStatus::OK, "no cloud yet");
  } else {
    status.summaryf(DiagnosticStatus::OK, "%.0f ms (median)", 1000 * summary.latency_p50);
  }
  unusable_ = summary.unusable;
  status.addf("latency p50 [ms]", "%.1f", 1000 * summary.latency_p50);
  status.addf("latency p95 [ms]", "%.1f", 1000 * summary.latency_p95);
  status.addf("latency max [ms]", "%.1f", 1000 * summary.latency_max);
  status.add("processed", summary.processed);
  status.add("unusable", summary.unusable);
}

void Diagnostics::reportTracking(Status& status) {
  const ObjectTracking::Summary summary = parts_.tracking.summary();
  if (summary.active) {
    status.summaryf(DiagnosticStatus::OK, "%d objects followed", int(summary.tracks));
  } else {
    status.summary(DiagnosticStatus::OK, "off: every cloud is searched anew");
  }
  status.add("objects", summary.tracks);
  status.add("begun", summary.counts.begun);
  status.add("lost", summary.counts.lost);
  status.add("found again", summary.counts.found_again);
  status.add("identity changes", summary.counts.identity_changes);
}

void Diagnostics::reportCodebook(Status& status) {
  const sks_detector::Status state = parts_.board.current();
  if (state.codebook.empty()) {
    status.summary(DiagnosticStatus::ERROR, "no codebook: set ~codebook, call ~load_codebook, or train one by ~train");
    return;
  }
  status.summary(DiagnosticStatus::OK, state.codebook);
  status.add("file", state.codebook_file.empty() ? "not saved" : state.codebook_file);
  status.add("objects", state.objects.size());
  status.add("words", state.words);
}

void Diagnostics::reportProcess(Status& status) {
  const double memory = residentMemory();
  status.summaryf(DiagnosticStatus::OK, "%.0f MB", memory);
  status.addf("resident memory [MB]", "%.1f", memory);
}

double Diagnostics::inputRate() {
  received_.emplace_back(Clock::now(), parts_.input.counts().received);
  if (received_.size() > rate_window) received_.pop_front();
  const double seconds = std::chrono::duration<double>(received_.back().first - received_.front().first).count();
  return seconds > 0 ? double(received_.back().second - received_.front().second) / seconds : 0;
}

}  // namespace sks_detector
