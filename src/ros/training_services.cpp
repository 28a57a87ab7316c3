// SPDX-License-Identifier: BSD-3-Clause
#include "ros/training_services.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <ros/console.h>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/registration.hpp>
#include <sks_detector/trainer.hpp>

#include "core/pipeline/stopwatch.hpp"
#include "core/settings/name_text.hpp"
#include "core/settings/shown_text.hpp"
#include "core/settings/value_text.hpp"
#include "io/file.hpp"
#include "ros/folders.hpp"
#include "ros/training_set.hpp"
#include "simulation/mesh_sampler.hpp"

namespace sks_detector {

void TrainingServices::train(const Train::Request& request, Train::Response& response,
                             const TrainingListener& listener) {
  const auto progressed = [&](const sks::ProgressState& state) {
    context_.board.trainingProgress(state);
    if (listener.progressed) listener.progressed(state);
  };
  std::vector<std::string> warnings;
  const auto do_work = [&](const sks::Progress& progress) {
    if (listener.started) listener.started();
    work(request, progress, response, warnings);
  };
  context_.training.run(do_work, progressed);
  response.message = "detecting with " + response.codebook + ": " + counted(response.objects, "object") + ", " +
                     counted(response.views, "view") + ", " + counted(response.words, "codeword") + ", trained in " +
                     sks::toText(std::round(10 * response.seconds) / 10) + " s" + asRemarks(warnings);
}

void TrainingServices::work(const Train::Request& request, const sks::Progress& progress, Train::Response& response,
                            std::vector<std::string>& warnings) {
  sks::Stopwatch stopwatch;
  context_.board.trainingStarted();
  const std::shared_ptr<void> at_end(nullptr, [this](void*) { context_.board.trainingEnded(); });

  if (!request.name.empty()) sks::checkName(request.name, "the codebook's name");
  const sks::Settings settings = settingsOf(request);
  std::string output;
  if (!request.output.empty()) {  // before training takes its time
    output = context_.codebookPath(request.output);
    context_.checkOverwriting(output, request.overwrite, nullptr);
    makeFolderOf(output);
    sks::checkWritable(output);
  }
  sks::MeshTraining mesh_training;
  mesh_training.threads = settings.threads;
  const auto warn = [](const std::string& warning) { ROS_WARN_STREAM(sks::shownMessage(warning)); };
  const std::string& folder = context_.dataset_directory;
  const TrainingSet set = gatherTrainingSet(request.dataset, request.captured, context_.captured, folder,
                                            sks::meshSampler(mesh_training, warn, folder));
  warnings = set.warnings;
  if (settings.training.register_views == sks::RegisterViews::automatic) {
    for (const std::string& object : set.without_planes) {
      warnings.push_back("object '" + object + "': its captured views keep frames of their own, for the plane that it" +
                         " stood on is not known: capture them again, or set training.register_views to true");
    }
  }
  for (const std::string& warning : warnings) warn(warning);

  const std::string name = request.name.empty() ? set.name : request.name;
  sks::RegisteredTraining trained = sks::trainRegistered(set.samples, settings, name, progress);
  const auto codebook = std::make_shared<const sks::Codebook>(std::move(trained.codebook));
  for (const std::string& warning : sks::registrationWarnings(trained.objects)) {
    warn(warning);
    warnings.push_back(warning);
  }
  for (const std::string& warning : sks::trainingWarnings(*codebook)) ROS_WARN_STREAM(warning);
  const std::size_t views = codebook->views.size();
  if (!output.empty()) context_.writeCodebook(output, request.overwrite, *codebook);
  sks::report(progress, {"sorting the codewords", "", views, views});
  {
    const std::lock_guard<std::mutex> lock(context_.codebook_change);
    context_.slot.setCodebook(codebook, output);
  }
  context_.updateStatus();
  response.codebook = nameWithChecksum(*codebook);
  response.objects = std::uint32_t(codebook->objects.size());
  response.views = std::uint32_t(views);
  response.words = std::uint32_t(codebook->words.size());
  response.seconds = stopwatch.lap();
}

sks::Settings TrainingServices::settingsOf(const Train::Request& request) const {
  sks::Settings settings = context_.slot.trainingSettings();
  std::vector<std::string> warnings;
  for (const std::string& text : request.settings) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      throw sks::Error(sks::ErrorCode::bad_usage, "settings: '" + sks::shown(text) + "' is not of the form key=value");
    }
    sks::setSetting(settings, text.substr(0, equals), text.substr(equals + 1), &warnings);
  }
  for (const std::string& warning : warnings) ROS_WARN_STREAM("settings of ~train: " << warning);
  const int wanted = sks::threadCount(settings), most = BackgroundJob::threads();
  settings.threads = std::min(wanted, most);
  sks::validate(settings);
  sks::validate(withBound(context_.slot.trainingSettings(), settings));  // with which the codebook will be used
  return settings;
}

void TrainingServices::cancel(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  if (!context_.training.cancel()) {
    throw sks::Error(sks::ErrorCode::bad_usage, "no training runs");
  }
  response.message = "the training ends after the cloud that it is at; the old codebook stays in use";
}

}  // namespace sks_detector
