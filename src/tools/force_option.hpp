// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <CLI/App.hpp>

#include <sks_detector/codebook.hpp>

namespace sks::tools {

/// `--force`: what is written may take the place of a data set or codebook that is there. Without it, two data sets
/// would be mixed in one folder without a word.
class ForceOption {
public:
  void add(CLI::App& command);
  /// For a command that writes a codebook.
  void addForCodebook(CLI::App& command);

  /// For a folder that is to hold dataset.yaml and scenes/. With --force dataset.yaml is removed, so that a run that is
  /// interrupted leaves no list of clouds that are half old and half new.
  /// @throws Error(bad_usage) naming the folder
  void checkFolder(const std::string& folder) const;

  /// For a data set file or codebook; that is written last, and stays as it is until then. @throws Error(bad_usage)
  void checkFile(const std::string& file) const;

  /// Writes a file that checkFile() or checkFolder() let pass; one that came since then, by another program, is not
  /// replaced without --force. @throws Error(bad_usage), and what writeFileAtomically() throws
  void write(const std::string& file, const std::string& text) const;
  /// The same for a codebook. @throws Error(bad_usage), and what writeCodebook() throws
  void write(const std::string& file, const Codebook& codebook) const;

private:
  void refuse(const std::string& path, const std::string& what) const;

  bool force_ = false;
};

}  // namespace sks::tools
