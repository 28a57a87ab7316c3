// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include <sks_detector/error.hpp>
#include <sks_detector/settings.hpp>

// Calls the library, reads what it returns, and catches its exception on this side of the shared library's boundary.
int main() {
  const auto& infos = sks::settingInfos();
  const auto discard = std::find_if(infos.begin(), infos.end(),
                                    [](const sks::SettingInfo& info) { return info.key == "keypoints.discard"; });
  if (discard == infos.end()) {
    std::cerr << "settingInfos() does not name keypoints.discard\n";
    return EXIT_FAILURE;
  }
  try {
    sks::Settings settings;
    sks::setSetting(settings, "keypoints.discrad", "0.5");
  } catch (const sks::Error& error) {
    std::cout << infos.size() << " settings; " << error.what() << '\n';
    return error.code() == sks::ErrorCode::bad_usage ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  std::cerr << "an unknown setting was accepted\n";
  return EXIT_FAILURE;
}
