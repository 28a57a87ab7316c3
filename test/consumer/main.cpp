// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>

#include <sks_detector/detector.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/trainer.hpp>

namespace {

class OwnKeypoints : public sks::KeypointStage {
public:
  sks::Keypoints detect(const sks::Surface& surface, const sks::Settings& settings) const override {
    return sks::gridKeypoints(surface, settings.keypoints.grid_size);
  }
};

int fail(const char* message) {
  std::cerr << message << '\n';
  return EXIT_FAILURE;
}

}  // namespace

// Calls the library, reads what it returns, gives it a stage, and catches its exception on this side of the shared
// library's boundary.
int main() {
  const auto& infos = sks::settingInfos();
  const auto discard = std::find_if(infos.begin(), infos.end(),
                                    [](const sks::SettingInfo& info) { return info.key == "keypoints.discard"; });
  if (discard == infos.end()) return fail("settingInfos() does not name keypoints.discard");

  sks::TrainingSample empty;
  empty.object = empty.source = "nothing";
  empty.load = [] { return sks::Cloud(); };
  sks::Stages stages;
  stages.keypoints = std::make_shared<OwnKeypoints>();
  try {
    sks::Detector(sks::train({empty}, {}, "nothing", {}, stages), {}, stages);
    return fail("an empty cloud was accepted");
  } catch (const sks::Error& error) {
    if (error.code() != sks::ErrorCode::bad_data) return fail(error.what());
  }
  try {
    sks::Settings settings;
    sks::setSetting(settings, "keypoints.discrad", "0.5");
  } catch (const sks::Error& error) {
    std::cout << infos.size() << " settings; " << error.what() << '\n';
    return error.code() == sks::ErrorCode::bad_usage ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  return fail("an unknown setting was accepted");
}
