// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluation_plots.hpp"

#include <cctype>
#include <filesystem>

#include "io/file.hpp"
#include "tools/plot_script.hpp"
#include "tools/scene_picture.hpp"

namespace sks::tools {
namespace {

constexpr const char* script = "scripts/plot_evaluation.py";

/// The name of a scene's picture; names that cannot stand in a file name are numbered so that no two meet.
std::string pictureName(const std::string& scene, std::size_t index) {
  std::string name = scene;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.' && c != '_') c = '_';
  }
  return name + (name == scene ? "" : "_" + std::to_string(index + 1)) + ".png";
}

}  // namespace

void preparePlots(const std::string& folder) {
  makeFolder(folder);
  checkWritable((std::filesystem::path(folder) / "evaluation.json").string());
  runPlotScript(script, {"--check"});
}

void writePlots(const std::string& folder, const SceneClouds& clouds, const Evaluation& evaluation,
                const nlohmann::json& json, const Progress& progress) {
  const std::filesystem::path plots(folder);
  const std::string file = (plots / "evaluation.json").string();
  writeFileAtomically(file, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  runPlotScript(script, {file, folder});
  const std::filesystem::path pictures = plots / "scenes";
  makeFolder(pictures.string());
  const std::size_t count = evaluation.scenes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SceneResult& result = evaluation.scenes[i];
    report(progress, {"drawing", result.scene.name, i, count});
    const Cloud cloud = clouds(i);
    if (cloud.size() == 0) continue;
    saveScenePicture((pictures / pictureName(result.scene.name, i)).string(), cloud, result, evaluation);
  }
  report(progress, {"drawing", "", count, count});
}

}  // namespace sks::tools
