// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "io/captured_views.hpp"
#include "ros/background_job.hpp"
#include "ros/detector_slot.hpp"
#include "ros/services.hpp"
#include "ros/status_board.hpp"

namespace sks_detector {

/// "1 view", "2 views".
std::string counted(std::size_t count, const std::string& what);

/// Warnings as they end a reply: the first few, each after "; "; empty if there are none.
std::string asRemarks(const std::vector<std::string>& warnings);

/// What the services share.
struct ServiceContext {
  ServiceContext(DetectorSlot& detector_slot, StatusBoard& status_board, const NodeSettings& settings,
                 NodeAccess node_access);

  DetectorSlot& slot;
  StatusBoard& board;
  const NodeAccess node;
  const std::string codebook_directory;  ///< absolute, like that of the data sets
  const std::string dataset_directory;
  const double service_timeout;  ///< [s]
  sks::CapturedViews captured;
  BackgroundJob training;
  std::mutex codebook_change;  ///< held from reading a codebook to swapping in what was made of it

  /// The file of a codebook that a request names. @throws sks::Error if it lies elsewhere or is not called *.sks
  std::string codebookPath(const std::string& path) const;
  /// @throws sks::Error(bad_usage) where an existing file must not be overwritten: it is no codebook, or another one
  /// than `same` and `overwrite` is not set
  void checkOverwriting(const std::string& path, bool overwrite, const sks::Codebook* same) const;

  /// Writes what checkOverwriting() let pass. A file that came since then, by another node with the same folder, is
  /// looked at in the same way: it is not replaced unasked.
  /// @throws sks::Error as checkOverwriting() and sks::writeCodebook()
  void writeCodebook(const std::string& path, bool overwrite, const sks::Codebook& codebook) const;

  /// Does what somebody asks for. What it throws is logged and kept in the status, until it works again.
  /// @param name resolved, of the service
  /// @return why it failed, for the reply; empty if it did not
  std::string attempt(const std::string& name, const std::function<void()>& action);

  /// Tells the status of captured objects, and of the codebook; does not throw.
  void updateStatus();
};

}  // namespace sks_detector
