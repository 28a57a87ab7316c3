// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/codebook_edit.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/descriptors/quantizer.hpp"
#include "core/settings/nearest_name.hpp"
#include "core/settings/shown_text.hpp"

namespace sks {

std::shared_ptr<Codebook> withoutObject(const Codebook& codebook, const std::string& object) {
  const auto found = std::find(codebook.objects.begin(), codebook.objects.end(), object);
  if (found == codebook.objects.end()) {
    throw Error(ErrorCode::bad_usage, "the codebook '" + codebook.name + "' holds no object '" + shown(object) + "'; " +
                                          nearestNameHint(object, codebook.objects));
  }
  if (codebook.objects.size() == 1) return nullptr;
  const auto removed = std::uint32_t(found - codebook.objects.begin());

  auto rest = std::make_shared<Codebook>();
  rest->name = codebook.name;
  rest->descriptor_type = codebook.descriptor_type;
  rest->own_descriptor = codebook.own_descriptor;
  rest->settings = codebook.settings;
  rest->objects = codebook.objects;
  rest->objects.erase(rest->objects.begin() + removed);
  std::vector<std::uint32_t> new_index(codebook.views.size());
  for (std::size_t i = 0; i < codebook.views.size(); ++i) {
    if (codebook.views[i].object == removed) continue;
    new_index[i] = std::uint32_t(rest->views.size());
    rest->views.push_back(codebook.views[i]);
    if (rest->views.back().object > removed) --rest->views.back().object;
  }
  for (const RegisteredModel& model : codebook.models) {
    if (model.object == removed) continue;
    rest->models.push_back(model);
    if (rest->models.back().object > removed) --rest->models.back().object;
  }
  Quantizer rows(codebook.descriptors.cols());
  for (std::size_t i = 0; i < codebook.words.size(); ++i) {
    Codeword word = codebook.words[i];
    if (codebook.views[word.view].object == removed) continue;
    word.view = new_index[word.view];
    rest->words.push_back(word);
    rows.add(codebook.descriptors, i);
  }
  rest->descriptors = rows.release();
  rest->background = codebook.background;
  return rest;
}

}  // namespace sks
