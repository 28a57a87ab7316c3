// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/registered_truth.hpp"

#include <map>
#include <string>
#include <utility>

namespace sks {

DataSet registeredTruth(DataSet data_set, const Codebook& codebook) {
  std::map<std::pair<std::string, std::string>, const TrainingView*> registered;  // by object and source
  for (const TrainingView& view : codebook.views) {
    if (view.T_model_source) registered[{codebook.objects[view.object], view.source}] = &view;
  }
  for (Scene& scene : data_set.scenes) {
    for (GroundTruth& truth : scene.objects) {
      const auto found = registered.find({truth.object, truth.reference});
      if (found == registered.end() || !truth.T_scene_reference) continue;
      truth.model_frame = found->second->frameName();
      truth.T_scene_model = *truth.T_scene_reference * found->second->T_model_source->inverse();
    }
  }
  return data_set;
}

}  // namespace sks
