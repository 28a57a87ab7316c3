// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/background_words.hpp"

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/surface.hpp>

#include "core/descriptors/quantizer.hpp"
#include "core/matching/background_views.hpp"
#include "core/matching/chi_squared.hpp"
#include "core/settings/threads.hpp"

namespace sks {
namespace {

constexpr std::size_t most_of_view = 200;  // keypoints, also on the finest grid
constexpr float same_distance = 0.5f;      // chi squared; the same place seen twice by a sensor differs by 0.8 and more
constexpr int most_threads = 4;            // for a quarter of a second

/// Evenly spread ones.
Keypoints thinned(Keypoints keypoints) {
  const std::size_t stride = keypoints.size() / most_of_view + 1;
  Keypoints kept;
  for (std::size_t i = 0; i < keypoints.size(); i += stride) kept.positions.push_back(keypoints.positions[i]);
  return kept;
}

/// Adds descriptors that no other is near to.
void addDistinct(const DescriptorMatrix& rows, std::vector<float>& values) {
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    bool known = false;
    for (std::size_t other = 0; other < values.size() && !known; other += shot_size) {
      known = chiSquaredFast(rows.row(row), &values[other], shot_size) < same_distance;
    }
    if (!known) values.insert(values.end(), rows.row(row), rows.row(row) + shot_size);
  }
}

/// Of the views of one thing.
QuantizedDescriptors described(const std::vector<Cloud>& views, const Settings& settings) {
  std::vector<float> values;
  for (const Cloud& view : views) {
    const Surface surface = prepareSurface(view, settings.surface, Orientation::sensor, 1);
    const Keypoints keypoints = thinned(gridKeypoints(surface, settings.keypoints.grid_size));
    addDistinct(computeDescriptors(surface, keypoints, DescriptorType::shot, settings.descriptor, 1).values, values);
  }
  return QuantizedDescriptors(DescriptorMatrix(std::move(values), shot_size));
}

/// @throws like startableThreads()
int fewThreads(Settings settings) {
  settings.threads = std::min(threadCount(settings), most_threads);
  return startableThreads(settings);
}

QuantizedDescriptors describedThings(const Settings& settings, int threads) {
  std::vector<QuantizedDescriptors> of_things(backgroundThings());  // a quarter of the floats
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < of_things.size(); ++i) of_things[i] = described(backgroundViews(i), settings);
  Quantizer all(shot_size);
  for (const QuantizedDescriptors& one : of_things) {
    for (std::size_t row = 0; row < one.rows(); ++row) all.add(one, row);
  }
  return all.release();
}

/// The values of all settings that the words depend on.
std::string relevant(const Settings& settings) {
  std::string values;
  for (const SettingInfo& info : settingInfos()) {
    const std::string group = info.key.substr(0, info.key.find('.'));
    if (group != "surface" && group != "descriptor" && info.key != "keypoints.grid_size") continue;
    values += getSetting(settings, info.key) + " ";
  }
  return values;
}

}  // namespace

QuantizedDescriptors backgroundDescriptors(const Settings& settings) {
  static std::mutex mutex;
  static std::string last_settings;
  static QuantizedDescriptors last;
  std::string wanted = relevant(settings);
  const std::lock_guard<std::mutex> lock(mutex);
  if (wanted != last_settings) {
    last = describedThings(settings, fewThreads(settings));
    last_settings = std::move(wanted);
  }
  return last;
}

std::shared_ptr<const NearestWord> backgroundWords(const Codebook& codebook, const Settings& settings) {
  static std::mutex mutex;
  static std::shared_ptr<const NearestWord> last;
  static const std::uint8_t* last_levels = nullptr;  // which `last` keeps alive
  const bool keeps = codebook.background.rows() > 0 && codebook.background.cols() == shot_size &&
                     relevant(codebook.settings) == relevant(settings);
  const QuantizedDescriptors rows = keeps ? codebook.background : backgroundDescriptors(settings);
  if (rows.rows() == 0) return nullptr;
  const std::lock_guard<std::mutex> lock(mutex);
  if (last_levels != rows.levels(0)) {
    last = std::make_shared<const NearestWord>(rows, SearchEffort::glance());
    last_levels = rows.levels(0);
  }
  return last;
}

}  // namespace sks
