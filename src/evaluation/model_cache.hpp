// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

#include "evaluation/object_model.hpp"
#include "io/dataset.hpp"

namespace sks {

/// The model of a training cloud. May throw Error: then its object has no model, for the reason that is thrown.
using ModelLoader = std::function<ObjectModel(const TrainingEntry& entry)>;

/// The models of a data set, each loaded when it is first asked for. Keeps references to what it is made of.
class ModelCache {
public:
  ModelCache(const DataSet& data_set, const ModelLoader& loader) : data_set_(data_set), loader_(loader) {}

  /// Whether the data set has any mesh or full model.
  bool any() const;
  /// The model of a mesh or full model by its name, TrainingEntry::source; it stays where it is.
  /// @param reason why there is none
  const ObjectModel* find(const std::string& source, std::string& reason);

private:
  struct Entry {
    ObjectModel model;
    std::string fault;
  };

  void load(const std::string& source, Entry& entry) const;

  const DataSet& data_set_;
  const ModelLoader& loader_;
  std::map<std::string, Entry> models_;
};

}  // namespace sks
