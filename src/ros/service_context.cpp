// SPDX-License-Identifier: BSD-3-Clause
#include "ros/service_context.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <utility>

#include <ros/console.h>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "io/codebook_layout.hpp"
#include "io/confined_path.hpp"
#include "ros/folders.hpp"

namespace sks_detector {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_failure = 2000;  // bytes; it may quote a request, and goes to log and status
constexpr std::size_t most_remarks = 3;
constexpr const char* captured_error = "captured views";

/// What an action says that it throws; empty if it succeeds.
std::string failureOf(const std::function<void()>& action) {
  try {
    action();
    return "";
  } catch (const std::bad_alloc&) {
    return "there is not enough memory for this";
  } catch (const std::exception& error) {
    return sks::shown(error.what(), longest_failure);
  } catch (...) {
    return "an unknown error";
  }
}

}  // namespace

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string asRemarks(const std::vector<std::string>& warnings) {
  std::string remarks;
  const std::size_t shown = std::min(warnings.size(), most_remarks);
  for (std::size_t i = 0; i < shown; ++i) remarks += "; warning: " + warnings[i];
  if (shown < warnings.size()) remarks += "; " + counted(warnings.size() - shown, "more warning") + " in the log";
  return remarks;
}

ServiceContext::ServiceContext(DetectorSlot& detector_slot, StatusBoard& status_board, const NodeSettings& settings,
                               NodeAccess node_access)
    : slot(detector_slot),
      board(status_board),
      node(std::move(node_access)),
      codebook_directory(codebookDirectory(settings)),
      dataset_directory(datasetDirectory(settings)),
      service_timeout(settings.service_timeout),
      captured((fs::path(dataset_directory) / "captured").string()) {}

std::string ServiceContext::codebookPath(const std::string& path) const {
  std::string file = sks::confinedPath(path, codebook_directory);
  sks::checkCodebookName(file);
  return file;
}

void ServiceContext::checkOverwriting(const std::string& path, bool overwrite, const sks::Codebook* same) const {
  if (overwrite || !fs::exists(path)) return;
  const auto refuse = [&](const std::string& what) {
    throw sks::Error(sks::ErrorCode::bad_usage,
                     "'" + path + "' exists already and " + what + "; choose another name, or set overwrite to true");
  };
  std::shared_ptr<const sks::Codebook> old;
  try {
    old = sks::readCodebook(path);
  } catch (const sks::Error&) {
    refuse("is not a codebook that this program can read");
  }
  if (!same || sks::codebookChecksum(*old) != sks::codebookChecksum(*same))
    refuse("holds the codebook " + nameWithChecksum(*old));
}

void ServiceContext::writeCodebook(const std::string& path, bool overwrite, const sks::Codebook& codebook) const {
  if (overwrite) {
    sks::writeCodebook(path, codebook);
  } else if (!sks::writeNewCodebook(path, codebook)) {
    checkOverwriting(path, overwrite, &codebook);
    if (!fs::exists(path)) {
      throw sks::Error(sks::ErrorCode::bad_file,
                       "'" + path + "' was written and removed by another program: try again");
    }
  }
}

std::string ServiceContext::attempt(const std::string& name, const std::function<void()>& action) {
  std::string failure = failureOf(action);
  if (failure.empty()) {
    board.clearError(name);
  } else {
    ROS_WARN_STREAM(name << ": " << failure);
    board.setError(name, name + ": " + failure);
  }
  return failure;
}

void ServiceContext::updateStatus() {
  board.codebookChanged();
  try {
    std::vector<std::string> objects = captured.objects();
    if (const auto detector = slot.detector()) {
      const std::vector<std::string>& trained = detector->codebook().objects;
      const auto is_trained = [&](const std::string& object) {
        return std::find(trained.begin(), trained.end(), object) != trained.end();
      };
      objects.erase(std::remove_if(objects.begin(), objects.end(), is_trained), objects.end());
    }
    board.setCaptured(objects);
    board.clearError(captured_error);
  } catch (const std::exception& error) {
    const std::string message = sks::shownMessage(std::string("the captured views cannot be used: ") + error.what());
    ROS_ERROR_STREAM(message);
    board.setError(captured_error, message);
  }
}

}  // namespace sks_detector
