// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <sks_detector/settings_file.hpp>

#include "core/settings/value_text.hpp"
#include "tools/command.hpp"
#include "tools/settings_json.hpp"
#include "tools/table.hpp"

namespace sks::tools {
namespace {

struct ListOptions {
  bool yaml = false;
  bool markdown = false;
  SettingsOptions settings;
  JsonOption json;
};

std::string helpText(const SettingInfo& info) {
  return info.help + (info.binding == Binding::codebook ? " (fixed by the codebook)" : "");
}

std::string tableOf(const Settings& settings) {
  Table table({"<setting", "<value", "<range", "<meaning"});
  for (const SettingInfo& info : settingInfos()) {
    table.add({info.key, getSetting(settings, info.key), allowedValues(info), helpText(info)});
  }
  return table.text();
}

std::string markdownOf(const Settings& settings) {
  std::string text = "| setting | value | range | meaning |\n| --- | --- | --- | --- |\n";
  for (const SettingInfo& info : settingInfos()) {
    text += "| `" + info.key + "` | " + getSetting(settings, info.key) + " | " + allowedValues(info) + " | " +
            helpText(info) + " |\n";
  }
  return text;
}

nlohmann::json jsonOf(const Settings& settings) {
  nlohmann::json list = nlohmann::json::array();
  for (const SettingInfo& info : settingInfos()) {
    nlohmann::json entry = {{"key", info.key},
                            {"value", settingJson(settings, info)},
                            {"default", settingJson(Settings(), info)},
                            {"type", info.type},
                            {"unit", info.unit},
                            {"help", info.help},
                            {"fixed_by_codebook", info.binding == Binding::codebook}};
    if (info.type == "choice") entry["choices"] = info.choices;
    if (info.type == "double" || info.type == "int") entry["range"] = {info.range.min, info.range.max};
    list.push_back(entry);
  }
  return list;
}

void run(const ListOptions& options) {
  Settings settings;
  options.settings.apply(settings);
  options.json.write(jsonOf(settings));
  if (options.json.onStdout()) return;
  print(options.yaml ? settingsToYaml(settings, true) : options.markdown ? markdownOf(settings) : tableOf(settings));
}

}  // namespace

void addSettings(CLI::App& app) {
  CLI::App* command = app.add_subcommand("settings", "lists all settings with their values, units and ranges");
  const auto options = std::make_shared<ListOptions>();
  CLI::Option* yaml = command->add_flag("--yaml", options->yaml, "as a settings file for --config, with comments");
  command->add_flag("--markdown", options->markdown, "as a Markdown table")->excludes(yaml);
  options->settings.add(*command);
  options->json.add(*command);
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
