// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/model_cache.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

bool hasModel(const TrainingEntry& entry) {
  return entry.mesh || entry.kind == ViewKind::model;
}

}  // namespace

bool ModelCache::any() const {
  return std::any_of(data_set_.training.begin(), data_set_.training.end(), hasModel);
}

const ObjectModel* ModelCache::find(const std::string& source, std::string& reason) {
  const auto [found, is_new] = models_.try_emplace(source);
  if (is_new) load(source, found->second);
  reason = found->second.fault;
  return reason.empty() ? &found->second.model : nullptr;
}

void ModelCache::load(const std::string& source, Entry& entry) const {
  const auto trained = std::find_if(data_set_.training.begin(), data_set_.training.end(),
                                    [&](const TrainingEntry& candidate) { return candidate.source == source; });
  if (!any()) {
    entry.fault = "no mesh or full model is under 'training' in the data set";
  } else if (source.empty()) {
    entry.fault = "its ground truth has no pose with a 'reference'";
  } else if (trained == data_set_.training.end()) {
    entry.fault = "'" + source + "' is not under 'training' in the data set";
  } else if (!hasModel(*trained)) {
    entry.fault = "it is trained from views: a mesh or a full model is needed";
  } else {
    try {
      entry.model = loader_(*trained);
    } catch (const Error& error) {
      entry.fault = error.what();
    }
  }
}

}  // namespace sks
