// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <vector>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/settings_file.hpp>

#include "codebook_generated.h"
#include "core/settings/value_text.hpp"
#include "core/surface/color_space.hpp"
#include "io/atomic_file.hpp"
#include "io/codebook_bytes.hpp"
#include "io/codebook_layout.hpp"
#include "io/crc32c.hpp"
#include "io/freed_memory.hpp"

namespace sks {
namespace {

using flatbuffers::Offset;
using Vectors = flatbuffers::Vector<const format::Vec3*>;
using Colors = flatbuffers::Vector<const format::Color*>;

format::Vec3 toFormat(const Eigen::Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}

format::Pose toFormat(const Eigen::Isometry3d& T) {
  const Eigen::Matrix4f m = T.matrix().cast<float>();
  const auto column = [&](int c) { return toFormat(Eigen::Vector3f(m.col(c).head<3>())); };
  return {column(0), column(1), column(2), column(3)};
}

Offset<Vectors> toFormat(flatbuffers::FlatBufferBuilder& builder, const std::vector<Eigen::Vector3f>& vectors) {
  std::vector<format::Vec3> structs;
  structs.reserve(vectors.size());
  for (const Eigen::Vector3f& v : vectors) structs.push_back(toFormat(v));
  return builder.CreateVectorOfStructs(structs);
}

Offset<Colors> toFormat(flatbuffers::FlatBufferBuilder& builder, const std::vector<Rgb>& colors) {
  std::vector<format::Color> structs;
  structs.reserve(colors.size());
  for (const Rgb& color : colors) structs.emplace_back(color.r, color.g, color.b);
  return builder.CreateVectorOfStructs(structs);
}

/// Colours of a surface as the camera or the texture had them; none where they were not made of such.
std::vector<Rgb> levelsOf(const std::vector<Eigen::Vector3f>& surface_colors) {
  std::vector<Rgb> levels;
  levels.reserve(surface_colors.size());
  for (const Eigen::Vector3f& color : surface_colors) {
    const std::array<float, 3> lab{color.x(), color.y(), color.z()};
    levels.push_back(fromScaledLab(lab));
    if (toScaledLab(levels.back()) != lab) return {};
  }
  return levels;
}

Offset<format::View> toFormat(flatbuffers::FlatBufferBuilder& builder, const TrainingView& view) {
  const auto source = builder.CreateString(view.source);
  const auto frame = view.frame.empty() ? Offset<flatbuffers::String>() : builder.CreateSharedString(view.frame);
  const auto points = toFormat(builder, view.surface_points);
  const auto normals = toFormat(builder, view.surface_normals);
  const std::vector<Rgb> levels = levelsOf(view.surface_colors);
  const bool has_levels = !levels.empty(), has_colors = !has_levels && !view.surface_colors.empty();
  const auto colors = has_colors ? toFormat(builder, view.surface_colors) : Offset<Vectors>();
  const auto color_levels = has_levels ? toFormat(builder, levels) : Offset<Colors>();
  const format::Vec3 origin = toFormat(view.sensor_origin), low = toFormat(view.box_min), high = toFormat(view.box_max);
  const format::Pose pose = view.T_model_source ? toFormat(*view.T_model_source) : format::Pose();
  return format::CreateView(builder, view.object, source, format::ViewKind(view.kind), &origin, &low, &high, points,
                            normals, frame, colors, view.T_model_source ? &pose : nullptr, color_levels);
}

Offset<format::Model> toFormat(flatbuffers::FlatBufferBuilder& builder, const RegisteredModel& model) {
  const FusedModel& surface = model.surface;
  const auto frame = builder.CreateSharedString(model.frame);
  const auto points = toFormat(builder, surface.points);
  const auto normals = toFormat(builder, surface.normals);
  const auto colors = surface.colors.empty() ? Offset<Colors>() : toFormat(builder, surface.colors);
  const format::Vec3 low = toFormat(surface.box.min()), high = toFormat(surface.box.max());
  const Symmetry symmetry = model.symmetry.value_or(Symmetry());
  const format::Vec3 axis = toFormat(symmetry.axis.cast<float>());
  return format::CreateModel(builder, model.object, frame, &low, &high, points, normals, colors,
                             model.symmetry ? &axis : nullptr, model.symmetry ? symmetry.order : 0);
}

/// What the metadata will take at most, known before FlatBuffers' own limit ends the process.
std::uint64_t metadataBound(const Codebook& codebook) {
  std::uint64_t bytes = 1 << 20;
  bytes += codebook.words.size() * sizeof(format::Word);
  for (const std::string& object : codebook.objects) bytes += object.size() + 32;
  for (const TrainingView& view : codebook.views) {
    bytes += 256 + view.source.size() + view.frame.size() + 3 * view.surface_points.size() * sizeof(format::Vec3);
  }
  for (const RegisteredModel& model : codebook.models) {
    bytes += 256 + model.frame.size() + 3 * model.surface.points.size() * sizeof(format::Vec3);
  }
  return bytes;
}

/// The number of threads is the affair of a machine: the same codebook results from any.
Settings portable(Settings settings) {
  settings.threads = Settings().threads;
  return settings;
}

/// Surfaces of views that were written. Memory of small pieces comes back only if it is asked for, now and then.
class ReleasedSurfaces {
public:
  void add(TrainingView& view) {
    for (auto* surface : {&view.surface_points, &view.surface_normals, &view.surface_colors}) {
      std::vector<Eigen::Vector3f>().swap(*surface);
    }
    if (++released_ % views_at_once == 0) returnFreedMemory();
  }

private:
  static constexpr int views_at_once = 32;
  int released_ = 0;
};

/// @param released where given, the same codebook: its surfaces are let go
void build(flatbuffers::FlatBufferBuilder& builder, const Codebook& codebook, Codebook* released) {
  const auto name = builder.CreateString(codebook.name);
  const auto type = builder.CreateString(descriptorText(codebook));
  const auto settings = builder.CreateString(settingsToYaml(portable(codebook.settings)));
  const auto objects = builder.CreateVectorOfStrings(codebook.objects);
  std::vector<Offset<format::View>> views;
  ReleasedSurfaces surfaces;
  for (std::size_t i = 0; i < codebook.views.size(); ++i) {
    views.push_back(toFormat(builder, codebook.views[i]));
    if (released != nullptr) surfaces.add(released->views[i]);
  }
  std::vector<format::Word> words;
  words.reserve(codebook.words.size());
  for (const Codeword& word : codebook.words) {
    words.emplace_back(word.view, toFormat(word.position), toFormat(word.frame.row(0)), toFormat(word.frame.row(1)),
                       toFormat(word.frame.row(2)));
  }
  const auto view_vector = builder.CreateVector(views);
  const auto word_vector = builder.CreateVectorOfStructs(words);
  std::vector<Offset<format::Model>> models;
  for (const RegisteredModel& model : codebook.models) models.push_back(toFormat(builder, model));
  const auto model_vector =
      models.empty() ? Offset<flatbuffers::Vector<Offset<format::Model>>>() : builder.CreateVector(models);
  const auto columns = std::uint32_t(codebook.descriptorSize());
  format::FinishCodebookBuffer(
      builder, format::CreateCodebook(builder, name, type, columns, settings, objects, view_vector, word_vector,
                                      model_vector, std::uint32_t(codebook.background.rows())));
}

/// What stands in a codebook file, but for the descriptors.
struct FileParts {
  explicit FileParts(std::uint64_t metadata_bound) : metadata(std::size_t(metadata_bound)) {}

  flatbuffers::FlatBufferBuilder metadata;  // of the size that it needs at most: to grow it would be to copy it
  CodebookHeader header;
};

std::size_t levelsSize(const QuantizedDescriptors& descriptors) {
  return descriptors.rows() * descriptors.cols();
}

/// Of the descriptor section, those of the words first.
std::size_t rowsOf(const Codebook& codebook) {
  return codebook.descriptors.rows() + codebook.background.rows();
}

/// Hands over what follows the header, piece by piece.
template <typename Function>
void forEachPiece(const FileParts& parts, const Codebook& codebook, Function&& take) {
  static constexpr std::array<char, codebook_alignment> zeros{};
  const QuantizedDescriptors &descriptors = codebook.descriptors, &background = codebook.background;
  const std::size_t rows = rowsOf(codebook);
  take(parts.metadata.GetBufferPointer(), parts.header.metadata_size);
  take(zeros.data(), parts.header.descriptors_offset - parts.header.metadata_offset - parts.header.metadata_size);
  take(descriptors.scales(), descriptors.rows() * sizeof(float));
  take(background.scales(), background.rows() * sizeof(float));
  take(zeros.data(), levelsOffset(rows) - rows * sizeof(float));
  take(descriptors.levels(0), levelsSize(descriptors));
  take(background.levels(0), levelsSize(background));
}

FileParts makeParts(const Codebook& codebook, const std::string& path, Codebook* released = nullptr) {
  const auto fail = [&](const std::string& reason) {
    throw Error(ErrorCode::bad_file, "cannot write codebook '" + path + "': " + reason);
  };
  const std::string fault = codebookFault(codebook);
  if (!fault.empty()) fail(fault);
  const std::uint64_t metadata_bound = metadataBound(codebook);
  if (metadata_bound > largest_metadata) {
    fail(
        "the surfaces and codewords of its training clouds exceed 2 GiB; raise training.surface_resolution or "
        "keypoints.grid_size");
  }
  FileParts parts(metadata_bound);
  build(parts.metadata, codebook, released);

  CodebookHeader& header = parts.header;
  header.version = codebook_file_version;
  header.metadata_offset = sizeof(header);
  header.metadata_size = parts.metadata.GetSize();
  const std::uint64_t metadata_end = header.metadata_offset + header.metadata_size;
  header.descriptors_offset = alignedOffset(metadata_end);
  header.descriptors_size =
      levelsOffset(rowsOf(codebook)) + levelsSize(codebook.descriptors) + levelsSize(codebook.background);
  header.file_size = header.descriptors_offset + header.descriptors_size;
  forEachPiece(parts, codebook, [&](const void* data, std::size_t size) {
    header.payload_checksum = crc32c(data, size, header.payload_checksum);
  });
  header.header_checksum = header.ownChecksum();
  return parts;
}

std::string bytesOf(const FileParts& parts, const Codebook& codebook) {
  std::string bytes;
  bytes.reserve(std::size_t(parts.header.file_size));
  const auto add = [&](const void* data, std::size_t size) {
    if (size > 0) bytes.append(static_cast<const char*>(data), size);
  };
  add(&parts.header, sizeof(parts.header));
  forEachPiece(parts, codebook, add);
  return bytes;
}

/// All but the name of the file.
void writeParts(const FileParts& parts, const Codebook& codebook, AtomicFile& file) {
  file.write(&parts.header, sizeof(parts.header));
  forEachPiece(parts, codebook, [&](const void* data, std::size_t size) { file.write(data, size); });
}

std::uint32_t writeWhole(const FileParts& parts, const std::string& path, const Codebook& codebook) {
  AtomicFile file(path);
  writeParts(parts, codebook, file);
  file.commit();
  codebook.checksum.set(parts.header.payload_checksum);
  return parts.header.payload_checksum;
}

}  // namespace

std::uint32_t codebookChecksum(const Codebook& codebook) {
  if (!codebook.checksum.get()) codebook.checksum.set(makeParts(codebook, codebook.name).header.payload_checksum);
  return *codebook.checksum.get();
}

std::uint32_t writeCodebook(const std::string& path, const Codebook& codebook) {
  return writeWhole(makeParts(codebook, path), path, codebook);
}

std::uint32_t writeAndRelease(const std::string& path, Codebook& codebook) {
  return writeWhole(makeParts(codebook, path, &codebook), path, codebook);
}

std::string codebookBytes(const Codebook& codebook) {
  return bytesOf(makeParts(codebook, codebook.name), codebook);
}

bool writeNewCodebook(const std::string& path, const Codebook& codebook) {
  const FileParts parts = makeParts(codebook, path);
  AtomicFile file(path);
  writeParts(parts, codebook, file);
  codebook.checksum.set(parts.header.payload_checksum);
  return file.commitNew();
}

}  // namespace sks
