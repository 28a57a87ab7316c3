// SPDX-License-Identifier: BSD-3-Clause
#include "ros/capture_models.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include <sks_detector/settings_file.hpp>

namespace sks_detector {
namespace {

constexpr std::size_t most_objects = 20;  // whose views are kept in memory; of others they are read and compared anew

/// Tells a view from one that had its name before, as after ~undo_capture.
std::string identityOf(const sks::TrainingEntry& entry) {
  std::error_code ignored;
  const auto written = std::filesystem::last_write_time(entry.path, ignored).time_since_epoch().count();
  const auto size = std::filesystem::file_size(entry.path, ignored);
  return entry.source + "\n" + std::to_string(written) + "\n" + std::to_string(size);
}

}  // namespace

CaptureResult CaptureModels::update(const std::string& object, const sks::DataSet& captured,
                                    const sks::Settings& settings) {
  sks::DataSet of_object = captured;
  std::vector<sks::TrainingEntry>& entries = of_object.training;
  entries.erase(std::remove_if(entries.begin(), entries.end(), [&](const auto& e) { return e.object != object; }),
                entries.end());
  const std::vector<sks::TrainingSample> samples = sks::trainingSamples(of_object);
  std::vector<std::string> identities;
  std::transform(entries.begin(), entries.end(), std::back_inserter(identities), identityOf);

  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string text = sks::settingsToYaml(settings);
  const auto found = objects_.find(object);
  if (found != objects_.end() && found->second.settings != text) {
    objects_.erase(found);
  } else if (found == objects_.end() && objects_.size() >= most_objects) {
    objects_.clear();
  }
  Known& known = objects_.try_emplace(object, Known{text, sks::ObjectRegistrar(object, settings), {}}).first->second;
  sks::ObjectRegistrar& registrar = known.registrar;
  std::size_t kept = 0;
  while (kept < known.views.size() && kept < samples.size() && known.views[kept] == identities[kept]) ++kept;
  registrar.resize(kept);
  known.views.resize(kept);
  for (std::size_t i = kept; i < samples.size(); ++i) {
    registrar.add(samples[i]);
    known.views.push_back(identities[i]);
  }
  CaptureResult result;
  result.model = registrar.result();
  result.coverage = sks::coverageOf(result.model);
  if (!samples.empty()) result.same = registrar.sameAs(samples.size() - 1);
  return result;
}

}  // namespace sks_detector
