// SPDX-License-Identifier: BSD-3-Clause
#include "tools/codebook_summary.hpp"

#include <cstdio>
#include <filesystem>
#include <vector>

#include <sks_detector/codebook_file.hpp>

#include "core/settings/value_text.hpp"
#include "tools/detection_json.hpp"
#include "tools/settings_json.hpp"
#include "tools/table.hpp"

namespace sks::tools {
namespace {

struct ObjectSummary {
  std::size_t views = 0;
  std::size_t words = 0;
  Eigen::Vector3f largest = Eigen::Vector3f::Zero();  // extents over its training clouds [m]
  const RegisteredModel* model = nullptr;             // none: no views of it were registered
};

std::vector<ObjectSummary> summarize(const Codebook& codebook) {
  std::vector<ObjectSummary> objects(codebook.objects.size());
  for (const TrainingView& view : codebook.views) {
    ObjectSummary& object = objects[view.object];
    ++object.views;
    object.largest = object.largest.cwiseMax(view.extent());
  }
  for (const RegisteredModel& model : codebook.models) objects[model.object].model = &model;
  for (const Codeword& word : codebook.words) ++objects[codebook.views[word.view].object].words;
  return objects;
}

nlohmann::json modelJson(const RegisteredModel* model) {
  if (model == nullptr) return {};
  nlohmann::json json = {{"frame", model->frame},
                         {"points", model->surface.points.size()},
                         {"colors", !model->surface.colors.empty()},
                         {"box_min", vectorJson(model->surface.box.min().cast<double>())},
                         {"box_max", vectorJson(model->surface.box.max().cast<double>())}};
  if (model->symmetry) {
    json["symmetry"] = {{"axis", vectorJson(model->symmetry->axis)}, {"order", model->symmetry->order}};
  }
  return json;
}

std::uintmax_t fileSize(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

}  // namespace

std::string codebookTable(const std::string& path, const Codebook& codebook) {
  Table table({"<object", "training clouds", "codewords", "model points", "largest extents [m]"});
  const std::vector<ObjectSummary> objects = summarize(codebook);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ObjectSummary& object = objects[i];
    table.add(
        {codebook.objects[i], std::to_string(object.views), std::to_string(object.words),
         object.model != nullptr ? std::to_string(object.model->surface.points.size()) : "-",
         fixed(object.largest.x(), 3) + " x " + fixed(object.largest.y(), 3) + " x " + fixed(object.largest.z(), 3)});
  }
  table.add({"all", std::to_string(codebook.views.size()), std::to_string(codebook.words.size()), "", ""});
  return path + ": codebook '" + codebook.name + "', " + codebook.descriptorName() + ", checksum " +
         checksumText(codebook) + ", " + fixed(double(fileSize(path)) / 1e6, 1) + " MB\n" + table.text();
}

nlohmann::json codebookJson(const std::string& path, const Codebook& codebook) {
  nlohmann::json list = nlohmann::json::array();
  const std::vector<ObjectSummary> objects = summarize(codebook);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Eigen::Vector3f& largest = objects[i].largest;
    list.push_back({{"name", codebook.objects[i]},
                    {"training_clouds", objects[i].views},
                    {"codewords", objects[i].words},
                    {"model", modelJson(objects[i].model)},
                    {"largest_extents", {largest.x(), largest.y(), largest.z()}}});
  }
  return {{"file", path},
          {"name", codebook.name},
          {"checksum", checksumText(codebook)},
          {"bytes", fileSize(path)},
          {"descriptor_type", codebook.descriptorName()},
          {"descriptor_size", codebook.descriptorSize()},
          {"training_clouds", codebook.views.size()},
          {"codewords", codebook.words.size()},
          {"objects", list},
          {"settings", settingsJson(codebook.settings)}};
}

std::string checksumText(const Codebook& codebook) {
  char text[9];
  std::snprintf(text, sizeof(text), "%08x", codebookChecksum(codebook));
  return text;
}

}  // namespace sks::tools
