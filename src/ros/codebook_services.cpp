// SPDX-License-Identifier: BSD-3-Clause
#include "ros/codebook_services.hpp"

#include <algorithm>
#include <memory>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/settings_file.hpp>

#include "core/pipeline/codebook_edit.hpp"
#include "core/settings/nearest_name.hpp"
#include "core/settings/shown_text.hpp"
#include "ros/folders.hpp"

namespace sks_detector {
namespace {

using sks::Error;
using sks::ErrorCode;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void CodebookServices::load(const LoadCodebook::Request& request, LoadCodebook::Response& response) {
  const std::string path = context_.codebookPath(request.path);
  const std::lock_guard<std::mutex> lock(context_.codebook_change);
  refuseWhileTraining();
  const auto codebook = sks::readCodebook(path);
  context_.slot.setCodebook(codebook, path);
  context_.updateStatus();
  response.codebook = nameWithChecksum(*codebook);
  response.objects = codebook->objects;
  response.views = std::uint32_t(codebook->views.size());
  response.words = std::uint32_t(codebook->words.size());
  response.message = "detecting with " + response.codebook + ": " + counted(codebook->objects.size(), "object") + ", " +
                     counted(codebook->views.size(), "view") + ", " + counted(codebook->words.size(), "codeword");
}

void CodebookServices::save(const SaveCodebook::Request& request, SaveCodebook::Response& response) {
  const std::string path = context_.codebookPath(request.path);
  const auto detector = context_.slot.detector();
  if (!detector) throw Error(ErrorCode::bad_usage, "there is no codebook to save: train or load one first");
  const sks::Codebook& codebook = detector->codebook();
  context_.checkOverwriting(path, request.overwrite, &codebook);
  makeFolderOf(path);
  context_.writeCodebook(path, request.overwrite, codebook);
  context_.slot.setCodebookFile(codebook, path);
  context_.updateStatus();
  response.path = path;
  response.message = "saved " + nameWithChecksum(codebook) + " to '" + path + "'";
}

void CodebookServices::removeObject(const RemoveObject::Request& request, RemoveObject::Response& response) {
  const std::lock_guard<std::mutex> lock(context_.codebook_change);
  refuseWhileTraining();
  const auto detector = context_.slot.detector();
  const sks::DataSet captured = context_.captured.read();
  std::vector<std::string> known = detector ? detector->codebook().objects : std::vector<std::string>();
  const bool is_trained = contains(known, request.object);
  std::size_t views = 0;
  for (const auto* entries : {&captured.training, &captured.missing}) {
    for (const sks::TrainingEntry& entry : *entries) {
      known.push_back(entry.object);
      views += std::size_t(entry.object == request.object);
    }
  }
  if (!contains(known, request.object)) {
    throw Error(ErrorCode::bad_usage, "there is no object '" + sks::shown(request.object) +
                                          "' in the codebook or among the captured views; " +
                                          sks::nearestNameHint(request.object, known));
  }
  if (!is_trained && !request.delete_views) {
    throw Error(ErrorCode::bad_usage, "'" + request.object + "' is not in the codebook, and its " +
                                          counted(views, "captured view") + (views == 1 ? " is" : " are") +
                                          " kept unless delete_views is true");
  }
  // what may fail comes before what cannot be undone
  const auto rest = is_trained ? sks::withoutObject(detector->codebook(), request.object) : nullptr;
  if (request.delete_views) response.views = std::uint32_t(context_.captured.remove(request.object));
  if (is_trained) {
    context_.slot.setCodebook(rest, "");
    response.words = std::uint32_t(detector->codebook().words.size() - (rest ? rest->words.size() : 0));
  }
  context_.updateStatus();
  response.message = "removed '" + request.object + "': " + counted(response.words, "codeword") + ", " +
                     counted(response.views, "captured view");
  if (is_trained) response.message += "; files of codebooks are left as they are";
  if (views > response.views) {
    response.message += "; " + counted(views, "captured view") + (views == 1 ? " is" : " are") +
                        " kept for the next training: set delete_views to delete them";
  }
}

void CodebookServices::info(const Info::Request&, Info::Response& response) {
  response.settings = sks::settingsToYaml(context_.slot.settings());
  const auto detector = context_.slot.detector();
  if (!detector) {
    response.message = "there is no codebook: train or load one";
    return;
  }
  const sks::Codebook& codebook = detector->codebook();
  response.codebook = nameWithChecksum(codebook);
  response.codebook_file = context_.slot.codebookFile();
  response.descriptor = sks::getSetting(codebook.settings, "descriptor.type");
  response.objects = codebook.objects;
  response.views.assign(codebook.objects.size(), 0);
  response.words.assign(codebook.objects.size(), 0);
  for (const sks::TrainingView& view : codebook.views) ++response.views[view.object];
  for (const sks::Codeword& word : codebook.words) ++response.words[codebook.views[word.view].object];
  response.message = response.codebook + ": " + counted(codebook.objects.size(), "object") + ", " +
                     counted(codebook.views.size(), "view") + ", " + counted(codebook.words.size(), "codeword");
}

void CodebookServices::refuseWhileTraining() const {
  if (!context_.training.running()) return;
  throw Error(ErrorCode::bad_usage,
              "a training runs, whose codebook will take the place of this one: wait for it, or end it by "
              "~cancel_training");
}

}  // namespace sks_detector
