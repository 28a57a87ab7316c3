// SPDX-License-Identifier: BSD-3-Clause
#include "ros/capture_models.hpp"

#include <algorithm>
#include <vector>

#include <sks_detector/settings_file.hpp>

namespace sks_detector {
namespace {

constexpr std::size_t most_objects = 20;  // whose views are kept in memory; of others they are read and compared anew

}  // namespace

CaptureResult CaptureModels::update(const std::string& object, const sks::DataSet& captured,
                                    const sks::Settings& settings) {
  std::vector<sks::TrainingSample> samples = sks::trainingSamples(captured);
  samples.erase(
      std::remove_if(samples.begin(), samples.end(), [&](const sks::TrainingSample& s) { return s.object != object; }),
      samples.end());

  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string text = sks::settingsToYaml(settings);
  const auto found = objects_.find(object);
  if (found != objects_.end() && found->second.settings != text) {
    objects_.erase(found);
  } else if (found == objects_.end() && objects_.size() >= most_objects) {
    objects_.clear();
  }
  sks::ObjectRegistrar& registrar =
      objects_.try_emplace(object, Known{text, sks::ObjectRegistrar(object, settings)}).first->second.registrar;
  std::size_t kept = 0;
  const std::vector<std::string>& known = registrar.sources();
  while (kept < known.size() && kept < samples.size() && known[kept] == samples[kept].source) ++kept;
  registrar.resize(kept);
  for (std::size_t i = kept; i < samples.size(); ++i) registrar.add(samples[i]);
  CaptureResult result;
  result.model = registrar.result();
  result.coverage = sks::coverageOf(result.model);
  if (!samples.empty()) result.same = registrar.sameAs(samples.size() - 1);
  return result;
}

}  // namespace sks_detector
