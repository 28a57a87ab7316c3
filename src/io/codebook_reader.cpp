// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <vector>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/settings_file.hpp>

#include "codebook_generated.h"
#include "core/settings/shown_text.hpp"
#include "core/settings/value_text.hpp"
#include "core/surface/color_space.hpp"
#include "io/codebook_bytes.hpp"
#include "io/codebook_layout.hpp"
#include "io/file_content.hpp"

namespace sks {
namespace {

[[noreturn]] void badCodebook(const std::string& message) {
  throw Error(ErrorCode::bad_file, message);
}

Eigen::Vector3f fromFormat(const format::Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Rgb fromFormat(const format::Color& color) {
  return {color.r(), color.g(), color.b()};
}

Eigen::Isometry3d fromFormat(const format::Pose& from) {
  Eigen::Matrix3d axes;
  axes << fromFormat(from.x_axis()).cast<double>(), fromFormat(from.y_axis()).cast<double>(),
      fromFormat(from.z_axis()).cast<double>();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = axes;
  T.translation() = fromFormat(from.translation()).cast<double>();
  return T;
}

std::vector<Eigen::Vector3f> fromFormat(const flatbuffers::Vector<const format::Vec3*>& vectors) {
  std::vector<Eigen::Vector3f> result;
  result.reserve(vectors.size());
  for (const format::Vec3* v : vectors) result.push_back(fromFormat(*v));
  return result;
}

TrainingView fromFormat(const format::View& from) {
  TrainingView view;
  view.object = from.object();
  view.source = from.source()->str();
  if (from.kind() > format::ViewKind_MAX)
    badCodebook("its training cloud '" + shown(view.source) + "' is of an unknown kind");
  view.kind = ViewKind(from.kind());
  if (from.frame() != nullptr) view.frame = from.frame()->str();
  view.sensor_origin = fromFormat(*from.sensor_origin());
  view.box_min = fromFormat(*from.box_min());
  view.box_max = fromFormat(*from.box_max());
  view.surface_points = fromFormat(*from.surface_points());
  view.surface_normals = fromFormat(*from.surface_normals());
  if (from.source_pose() != nullptr) view.T_model_source = fromFormat(*from.source_pose());
  if (from.surface_colors() != nullptr) view.surface_colors = fromFormat(*from.surface_colors());
  if (from.surface_levels() != nullptr) {
    if (!view.surface_colors.empty())
      badCodebook("its training cloud '" + shown(view.source) + "' has colours twice; train it again");
    view.surface_colors.reserve(from.surface_levels()->size());
    for (const format::Color* color : *from.surface_levels()) {
      const std::array<float, 3> lab = toScaledLab(fromFormat(*color));
      view.surface_colors.emplace_back(lab[0], lab[1], lab[2]);
    }
  }
  return view;
}

RegisteredModel fromFormat(const format::Model& from) {
  RegisteredModel model;
  model.object = from.object();
  model.frame = from.frame()->str();
  model.surface.box = {fromFormat(*from.box_min()), fromFormat(*from.box_max())};
  model.surface.points = fromFormat(*from.points());
  model.surface.normals = fromFormat(*from.normals());
  if (from.symmetry_axis() != nullptr) {
    model.symmetry = {fromFormat(*from.symmetry_axis()).cast<double>(), from.symmetry_order()};
  }
  if (from.colors() != nullptr) {
    for (const format::Color* color : *from.colors()) model.surface.colors.push_back(fromFormat(*color));
  }
  return model;
}

Codeword fromFormat(const format::Word& from) {
  Codeword word;
  word.view = from.view();
  word.position = fromFormat(from.position());
  word.frame.row(0) = fromFormat(from.x_axis());
  word.frame.row(1) = fromFormat(from.y_axis());
  word.frame.row(2) = fromFormat(from.z_axis());
  return word;
}

Settings readSettings(const std::string& yaml) {
  Settings settings;
  try {
    parseSettings(yaml, "settings", settings);
    validate(settings);
  } catch (const Error& error) {
    badCodebook(std::string("it was trained with settings that this version does not know: ") + error.what() +
                "; train it again");
  }
  return settings;
}

constexpr std::size_t least_view = 48;   // bytes that a view takes besides its texts and surface
constexpr std::size_t least_model = 36;  // the same of a model

/// FlatBuffers lets any number of entries refer to one text or vector: copied for each, they would fill the memory from
/// a small file. What the writer leaves takes no more memory than it takes in the file, but for colours: four times
/// that.
bool takesWhatItStores(const format::Codebook& from, std::uint64_t stored) {
  std::uint64_t bytes = 0;
  for (const auto* object : *from.objects()) bytes += object->size();
  for (const auto* view : *from.views()) {
    if (view->frame() != nullptr && view->frame()->size() > longest_frame) return false;
    const std::uint64_t colors = view->surface_colors() != nullptr ? view->surface_colors()->size() : 0;
    const std::uint64_t vectors = view->surface_points()->size() + view->surface_normals()->size() + colors;
    const std::uint64_t levels = view->surface_levels() != nullptr ? view->surface_levels()->size() : 0;
    bytes += least_view + view->source()->size() + vectors * sizeof(format::Vec3) + levels * sizeof(format::Color);
  }
  if (from.models() != nullptr) {
    for (const auto* model : *from.models()) {
      const std::uint64_t colors = model->colors() != nullptr ? model->colors()->size() : 0;
      bytes += least_model + model->frame()->size() + colors * sizeof(format::Color) +
               (model->points()->size() + model->normals()->size()) * sizeof(format::Vec3);
    }
  }
  return bytes <= stored;
}

/// Descriptors of the first version, rounded.
QuantizedDescriptors floatDescriptors(const std::shared_ptr<const FileContent>& file, const CodebookHeader& header,
                                      std::size_t columns) {
  const std::uint64_t row = columns * sizeof(float);
  if (header.descriptors_size % row != 0) badCodebook("its descriptors have no whole rows; train it again");
  const auto* data = reinterpret_cast<const float*>(file->data() + header.descriptors_offset);
  try {
    return QuantizedDescriptors(DescriptorMatrix(data, std::size_t(header.descriptors_size / row), columns, file));
  } catch (const Error& error) {
    badCodebook(std::string(error.what()) + "; train it again");
  }
}

/// The descriptor section, in place: the rows of the words, and behind them those of the background.
void takeDescriptors(const std::shared_ptr<const FileContent>& file, const CodebookHeader& header,
                     std::uint32_t background, std::size_t columns, Codebook& codebook) {
  const std::size_t words = codebook.words.size();
  const std::uint64_t rows = std::uint64_t(words) + background, levels = levelsOffset(rows);
  if (header.descriptors_size < levels || header.descriptors_size - levels != rows * columns) {
    badCodebook("its " + std::to_string(words) + " codewords" +
                (background > 0 ? " and " + std::to_string(background) + " descriptors of the background" : "") +
                " have not one descriptor each; train it again");
  }
  const std::uint8_t* section = file->data() + header.descriptors_offset;
  const auto* scales = static_cast<const float*>(static_cast<const void*>(section));  // sections are aligned
  codebook.descriptors = {section + levels, scales, words, columns, file};
  if (background == 0) return;
  codebook.background = {section + levels + words * columns, scales + words, background, columns, file};
}

std::shared_ptr<const Codebook> read(const std::shared_ptr<FileContent>& file) {
  const CodebookHeader header = checkCodebookHeader(file->data(), file->size());
  flatbuffers::Verifier verifier(file->data() + header.metadata_offset, header.metadata_size);
  if (!format::VerifyCodebookBuffer(verifier)) badCodebook("its metadata is damaged; train it again");
  const format::Codebook& from = *format::GetCodebook(file->data() + header.metadata_offset);
  if (!takesWhatItStores(from, header.metadata_size)) badCodebook("its metadata is damaged; train it again");

  const auto codebook = std::make_shared<Codebook>();
  codebook->name = from.name()->str();
  const std::string type = from.descriptor_type()->str();
  if (!readDescriptorText(type, *codebook) ||
      (codebook->own_descriptor.empty() && codebook->descriptorSize() != from.descriptor_size())) {
    badCodebook("it holds descriptors of the unknown type '" + shown(type) + "' with " +
                std::to_string(from.descriptor_size()) + " bins: update sks_detector");
  }
  if (from.descriptor_size() == 0) badCodebook("its descriptor type is not decided; train it again");
  codebook->settings = readSettings(from.settings()->str());
  for (const auto* object : *from.objects()) codebook->objects.push_back(object->str());
  for (const auto* view : *from.views()) codebook->views.push_back(fromFormat(*view));
  codebook->words.reserve(from.words()->size());
  for (const auto* word : *from.words()) codebook->words.push_back(fromFormat(*word));
  if (from.models() != nullptr) {
    for (const auto* model : *from.models()) codebook->models.push_back(fromFormat(*model));
  }
  if (header.version < first_quantized_version) {
    codebook->descriptors = floatDescriptors(file, header, from.descriptor_size());
  } else {
    takeDescriptors(file, header, from.background(), from.descriptor_size(), *codebook);
  }
  codebook->checksum.set(header.payload_checksum);
  const std::string fault = codebookFault(*codebook);
  if (!fault.empty()) badCodebook(fault + "; train it again");
  file->release(header.metadata_offset, header.metadata_size);  // all of it was copied
  return codebook;
}

}  // namespace

std::shared_ptr<const Codebook> codebookFromBytes(const std::string& bytes) {
  return read(std::make_shared<FileContent>(bytes.data(), bytes.size()));
}

std::shared_ptr<const Codebook> readCodebook(const std::string& path) {
  try {
    const CodebookHeader model;
    return read(std::make_shared<FileContent>(path, std::string(model.magic, sizeof(model.magic))));
  } catch (const Error& error) {
    throw Error(error.code(), "cannot read codebook '" + path + "': " + error.what());
  }
}

}  // namespace sks
