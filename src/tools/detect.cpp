// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>
#include <memory>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/codebook_file.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/thresholds.hpp>

#include "core/settings/value_text.hpp"
#include "drawing/palette.hpp"
#include "drawing/picture.hpp"
#include "tools/codebook_summary.hpp"
#include "tools/command.hpp"
#include "tools/detection_json.hpp"
#include "tools/progress_bar.hpp"
#include "tools/table.hpp"

namespace sks::tools {
namespace {

struct DetectOptions {
  std::string codebook;
  std::vector<std::string> clouds;
  double scale = 1;
  std::string image;
  SettingsOptions settings;
  JsonOption json;
};

/// out.png for the only cloud; out_1.png, out_2.png ... for several.
std::string imagePath(const DetectOptions& options, std::size_t index) {
  if (options.clouds.size() == 1) return options.image;
  const std::filesystem::path path(options.image);
  const std::string name = path.stem().string() + "_" + std::to_string(index + 1) + path.extension().string();
  return (path.parent_path() / name).string();
}

std::string resultTable(const std::string& path, const std::vector<Detection>& detections, const StageTimes& times) {
  std::string head =
      path + ": " + std::to_string(detections.size()) + " found in " + fixed(1000 * times.total, 0) + " ms\n";
  if (detections.empty()) return head;
  Table table({"<object", "score", "x [m]", "y [m]", "z [m]", "box [m]", "votes", "inliers"});
  for (const Detection& d : detections) {
    const Eigen::Vector3d position = d.position();
    table.add({d.object, fixed(d.score, 3), fixed(position.x(), 3), fixed(position.y(), 3), fixed(position.z(), 3),
               fixed(d.box_size.x(), 3) + " x " + fixed(d.box_size.y(), 3) + " x " + fixed(d.box_size.z(), 3),
               std::to_string(d.votes), std::to_string(d.inliers)});
  }
  return head + table.text();
}

void savePicture(const std::string& path, const Cloud& cloud, const std::vector<Detection>& detections,
                 const std::vector<std::string>& objects) {
  Picture picture(cloud);
  for (auto d = detections.rbegin(); d != detections.rend(); ++d) {  // the best on top
    picture.drawDetection(*d, objectColor(objects, d->object));
  }
  picture.save(path);
}

/// Detects in one file; errors name it.
DetectionResult detect(const Detector& detector, const std::string& path, const Cloud& cloud) {
  try {
    return detector.detect(cloud);
  } catch (const Error& error) {
    throw Error(error.code(), "cloud '" + path + "': " + error.what());
  }
}

void run(const DetectOptions& options) {
  const std::shared_ptr<const Codebook> codebook = readCodebook(options.codebook);
  Settings settings = codebook->settings;
  options.settings.apply(settings);
  const Detector detector(codebook, settings);
  for (const std::string& warning : thresholdWarnings(settings.detection, codebook->objects)) warn(warning);
  options.json.check();
  const std::size_t count = options.clouds.size();
  for (std::size_t i = 0; i < count && !options.image.empty(); ++i) checkPicturePath(imagePath(options, i));

  nlohmann::json results = nlohmann::json::array();
  ProgressBar bar;
  const Progress progress = bar.callback();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& path = options.clouds[i];
    report(progress, {"detecting", path, i, count});
    const Cloud cloud = readCloud(path, options.scale);
    const DetectionResult result = detect(detector, path, cloud);
    report(progress, {"detecting", path, i + 1, count});
    const std::vector<Detection> detections = result.above(Thresholds(settings.detection));
    nlohmann::json list = nlohmann::json::array();
    for (const Detection& detection : detections) list.push_back(detectionJson(detection));
    results.push_back({{"cloud", path},
                       {"detections", list},
                       {"time_ms", timesJson(result.times)},
                       {"counts", countsJson(result.counts)}});
    if (!options.image.empty()) savePicture(imagePath(options, i), cloud, detections, codebook->objects);
    bar.clear();
    if (!options.json.onStdout()) print(resultTable(path, detections, result.times));
  }
  options.json.write({{"codebook", {{"name", codebook->name}, {"checksum", checksumText(*codebook)}}},
                      {"threshold", settings.detection.threshold},
                      {"thresholds", Thresholds(settings.detection).ofSingleObjects()},
                      {"clouds", results}});
}

}  // namespace

void addDetect(CLI::App& app) {
  CLI::App* command = app.add_subcommand("detect", "finds the objects of a codebook in point clouds");
  const auto options = std::make_shared<DetectOptions>();
  command->add_option("--codebook,-b", options->codebook, "trained codebook (*.sks)")->required()->type_name("FILE");
  command->add_option("clouds", options->clouds, "PCD or PLY files")->required()->type_name("CLOUD");
  command->add_option("--scale", options->scale, "factor from the clouds' unit to metres: 0.001 for millimetres")
      ->check([](const std::string& text) {
        double scale = 0;
        const bool positive = fromText(text, scale) && scale > 0 && std::isfinite(scale);
        return positive ? std::string() : "'" + text + "' is not a positive number";
      });
  command
      ->add_option("--image", options->image,
                   "draw each cloud with what was found (PNG, JPEG); several clouds are numbered")
      ->type_name("FILE");
  options->settings.add(*command);
  options->json.add(*command);
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
