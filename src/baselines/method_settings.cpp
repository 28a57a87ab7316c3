// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/method_settings.hpp"

#include "core/settings/detector_table.hpp"
#include "io/file.hpp"
#include "io/settings_yaml.hpp"

namespace sks::baselines {

const SettingsTable<MethodSettings>& methodTable() {
  static const SettingsTable<MethodSettings> table;
  return table;
}

void loadMethodSettings(const std::string& path, Settings& settings, MethodSettings& own,
                        std::vector<std::string>* warnings) {
  Settings detector = settings;
  MethodSettings methods = own;
  const SettingsOverlay overlay({detectorTable().bind(detector), methodTable().bind(methods)});
  overlayYaml(readTextFile(path), path, overlay, warnings);
  settings = detector;
  own = methods;
}

}  // namespace sks::baselines
