// SPDX-License-Identifier: BSD-3-Clause
// Every text that a service request or a parameter carries, given to the functions behind the services. The first byte
// of an input picks the request, the rest is its text.
#include <algorithm>
#include <filesystem>
#include <string>

#include <sks_detector/settings.hpp>

#include "core/pipeline/codebook_edit.hpp"
#include "io/captured_views.hpp"
#include "io/confined_path.hpp"
#include "refused.hpp"
#include "ros/configuration.hpp"
#include "ros/training_set.hpp"
#include "temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using sks::fuzz::refused;
using sks::fuzz::require;

/// A folder of the node: with links that lead out, nowhere, in a circle, and one that stays inside.
class NodeFolder {
public:
  NodeFolder() {
    fs::create_directory(folder_.path("root"));
    fs::create_directory(folder_.path("root/sub"));
    sks::test::writeFile(folder_.path("root/sub/a.sks"), "no codebook");
    sks::test::writeFile(folder_.path("secret"), "outside");
    fs::create_symlink("..", folder_.path("root/out"));
    fs::create_symlink("nothing", folder_.path("root/dangling"));
    fs::create_symlink("circle", folder_.path("root/circle"));
    fs::create_symlink("sub", folder_.path("root/in"));
  }
  std::string path() const { return fs::canonical(folder_.path("root")).string(); }

private:
  sks::test::TemporaryFolder folder_;
};

void path(const std::string& text, const std::string& folder) {
  const std::string file = sks::confinedPath(text, folder);
  require(file.rfind(folder + "/", 0) == 0, "a confined path lies in its folder");
  const fs::path parts(file);
  require(std::none_of(parts.begin(), parts.end(), [](const fs::path& part) { return part == ".." || part == "."; }),
          "a confined path is free of dots");
  require(fs::weakly_canonical(file) == file, "a confined path is free of links");
}

void captureAndRemove(const std::string& name, const std::string& folder) {
  sks::CapturedViews views(folder + "/captured");
  sks::Cloud cloud;
  cloud.points.emplace_back(0, 0, 1);
  cloud.width = 1;
  const std::string file = views.add(name, cloud).file;
  require(file.rfind(folder + "/captured/", 0) == 0, "a captured view lies in its folder");
  require(views.objects() == std::vector<std::string>{name}, "an object keeps its name");
  require(views.remove(name) == 1 && views.objects().empty(), "an object can be removed again");
}

void removeObject(const std::string& name) {
  sks::Codebook codebook;
  codebook.objects = {"mug", "teddy bear", "mario"};
  codebook.descriptor_type = sks::DescriptorType::shot;
  sks::withoutObject(codebook, name);
}

void trainingSettings(const std::string& text) {
  sks::Settings settings;
  const std::size_t equals = std::min(text.find('='), text.size());
  sks::setSetting(settings, text.substr(0, equals), text.substr(std::min(equals + 1, text.size())));
  sks::validate(settings);
}

void parameters(const std::string& text) {
  sks_detector::Configuration configuration, again;
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string key = text.substr(0, equals), value = text.substr(std::min(equals + 1, text.size()));
  sks::SettingsOverlay(bound(configuration)).set(key, value);
  sks::SettingsOverlay back(bound(again));
  for (const sks::SettingInfo& info : sks_detector::parameterInfos()) {
    const std::string kept = sks_detector::getParameter(configuration, info.key);
    back.set(info.key, kept);
    require(sks_detector::getParameter(again, info.key) == kept, "a parameter is taken back unchanged");
  }
}

void trainFrom(const std::string& data_set, const std::string& folder) {
  sks::test::writeFile(folder + "/set.yaml", data_set);
  const auto no_sampler = [](const sks::TrainingEntry&, double) { return std::vector<sks::TrainingSample>(); };
  sks_detector::gatherTrainingSet("set.yaml", false, sks::CapturedViews(folder + "/captured"), folder, no_sampler);
}

void request(std::uint8_t which, const std::string& text, const std::string& folder) {
  switch (which % 7) {
    case 0:
      return path(text, folder);
    case 1:
      return sks::checkFileName(text, "the object's name");
    case 2:
      return captureAndRemove(text, folder);
    case 3:
      return removeObject(text);
    case 4:
      return trainingSettings(text);
    case 5:
      return parameters(text);
    default:
      return trainFrom(text, folder);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const NodeFolder folder;
  if (size == 0) return 0;
  refused([&] { request(data[0], {reinterpret_cast<const char*>(data) + 1, size - 1}, folder.path()); });
  return 0;
}
