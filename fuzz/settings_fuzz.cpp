// SPDX-License-Identifier: BSD-3-Clause
// Settings files: what is accepted can be written and read back.
#include <sks_detector/settings_file.hpp>

#include "refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sks::fuzz::refused([&] {
    sks::Settings settings;
    sks::parseSettings({reinterpret_cast<const char*>(data), size}, "settings.yaml", settings);
    const std::string yaml = sks::settingsToYaml(settings);
    sks::Settings back;
    sks::fuzz::require(!sks::fuzz::refused([&] { sks::parseSettings(yaml, "written", back); }), "settings read back");
    sks::fuzz::require(sks::settingsToYaml(back) == yaml, "settings survive a round trip");
    sks::validate(settings);
  });
  return 0;
}
