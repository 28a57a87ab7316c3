// SPDX-License-Identifier: BSD-3-Clause
// What the subcommands of `sks` share. Each subcommand is one file that adds itself to the application:
//
//   void addInfo(CLI::App& app) {
//     CLI::App* command = app.add_subcommand("info", "what a codebook holds");
//     const auto options = std::make_shared<Options>();
//     command->add_option("codebook", options->codebook, "codebook file (*.sks)")->required();
//     options->json.add(*command);
//     command->callback([options] { run(*options); });
//   }
//
// run() throws sks::Error for whatever goes wrong; main() turns it into a message and an exit status.
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <sks_detector/settings.hpp>

#include "baselines/method_settings.hpp"

namespace sks::tools {

void addTrain(CLI::App& app);
void addMerge(CLI::App& app);
void addDetect(CLI::App& app);
void addEvaluate(CLI::App& app);
void addClassify(CLI::App& app);
void addKeypoints(CLI::App& app);
void addImport(CLI::App& app);
void addSimulate(CLI::App& app);
void addInfo(CLI::App& app);
void addVerify(CLI::App& app);
void addSettings(CLI::App& app);

/// `--config FILE` and `--set key=value ...`.
class SettingsOptions {
public:
  void add(CLI::App& command);

  /// Overlays the file, then each --set in its order, warns about old names, and validates the outcome.
  /// @param own takes what belongs to a method; where there is none, that is refused
  /// @throws Error(bad_usage), Error(bad_file)
  void apply(Settings& settings, baselines::MethodSettings* own = nullptr) const;

private:
  std::string config_;
  std::vector<std::string> sets_;
};

/// `--json FILE`, where `-` is stdout.
class JsonOption {
public:
  void add(CLI::App& command);

  /// True if stdout belongs to the JSON: no table may be printed to it then.
  bool onStdout() const { return path_ == "-"; }
  /// Empty where --json was not given.
  const std::string& path() const { return path_; }

  /// Throws what write() would throw, before the work is done whose results it writes. @throws Error(bad_file)
  void check() const;

  /// Does nothing where --json was not given. @throws Error(bad_file)
  void write(const nlohmann::json& json) const;

private:
  std::string path_;
};

/// One line on stderr that begins with "sks: warning: ".
void warn(const std::string& message);

/// Prints results to stdout. @throws Error(bad_file) if they cannot be written, e.g. on a full disk
void print(const std::string& text);

}  // namespace sks::tools
