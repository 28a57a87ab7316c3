// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command.hpp"

#include <cstdio>
#include <iostream>

#include <sks_detector/error.hpp>
#include <sks_detector/settings_file.hpp>

#include "core/settings/detector_table.hpp"
#include "core/settings/settings_overlay.hpp"
#include "core/settings/shown_text.hpp"
#include "core/settings/threads.hpp"
#include "io/file.hpp"
#include "tools/cluster/cluster.hpp"

namespace sks::tools {

void SettingsOptions::add(CLI::App& command) {
  command.add_option("--config,-c", config_, "settings file (YAML); see `sks settings --yaml`")->type_name("FILE");
  command.add_option("--set,-s", sets_, "one setting, after those of --config; can be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void SettingsOptions::apply(Settings& settings, baselines::MethodSettings* own) const {
  std::vector<std::string> warnings;
  if (!config_.empty() && own != nullptr) {
    baselines::loadMethodSettings(config_, settings, *own, &warnings);
  } else if (!config_.empty()) {
    loadSettings(config_, settings, &warnings);
  }
  std::vector<BoundSettings> tables{detectorTable().bind(settings)};
  if (own != nullptr) tables.push_back(baselines::methodTable().bind(*own));
  for (const std::string& set : sets_) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos) {
      throw Error(ErrorCode::bad_usage,
                  "--set " + shown(set) + ": expected key=value, e.g. --set keypoints.discard=0.5");
    }
    SettingsOverlay each(tables);  // the last one of a key is used
    const std::string warning = each.set(set.substr(0, equals), set.substr(equals + 1));
    if (!warning.empty()) warnings.push_back("--set " + set + ": " + warning);
  }
  const std::string capped = tooManyThreads(settings);
  if (!capped.empty()) warnings.push_back(capped);
  for (const std::string& warning : warnings) warn(warning);
  validate(settings);
}

void JsonOption::add(CLI::App& command) {
  command.add_option("--json", path_, "write the results as JSON; - for stdout")->type_name("FILE");
}

void JsonOption::check() const {
  if (!path_.empty() && !onStdout() && leads()) checkWritable(path_);
}

void JsonOption::write(const nlohmann::json& json) const {
  if (path_.empty()) return;
  const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (onStdout()) {
    print(text);
  } else {
    writeFileAtomically(path_, text);
  }
}

void warn(const std::string& message) {
  if (!leads()) return;
  std::cerr << "sks: warning: " + shownMessage(message) + "\n";  // at once: other processes write there too
}

void print(const std::string& text) {
  std::cout << text << std::flush;
  if (!std::cout) throw Error(ErrorCode::bad_file, "cannot write the results to stdout");
}

}  // namespace sks::tools
