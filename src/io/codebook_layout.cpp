// SPDX-License-Identifier: BSD-3-Clause
#include "io/codebook_layout.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>

#include "core/settings/name_text.hpp"
#include "core/settings/shown_text.hpp"
#include "core/settings/value_text.hpp"
#include "io/crc32c.hpp"

namespace sks {
namespace {

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::bad_file, message);
}

bool inside(std::uint64_t offset, std::uint64_t size, std::uint64_t file_size) {
  return offset >= sizeof(CodebookHeader) && offset % codebook_alignment == 0 && offset <= file_size &&
         size <= file_size - offset;
}

/// Whether numbers are finite and so far from overflow that what is computed of them is finite as well.
template <typename Numbers>
bool within(const Numbers& numbers, typename Numbers::Scalar largest) {
  return (numbers.array().abs() <= largest).all();
}

constexpr float largest_length = 1e6f;     // [m]
constexpr float largest_of_unit = 1.001f;  // of a unit vector's parts, with what rounding adds
constexpr float largest_color = 10;        // of scaled CIELab, which stays within about 1
constexpr int most_rotations = 1000;       // that look the same

bool allWithin(const std::vector<Eigen::Vector3f>& vectors, float largest) {
  return std::all_of(vectors.begin(), vectors.end(), [&](const auto& vector) { return within(vector, largest); });
}

/// Of a descriptor.
bool isScale(float scale) {
  return scale >= 0 && scale <= QuantizedDescriptors::largest_bin;
}

std::string viewFault(const Codebook& codebook, const TrainingView& view) {
  if (view.object >= codebook.objects.size()) return "belongs to an object that is not there";
  if (view.frame.size() > longest_frame) return "has a frame with a name of more than 4096 bytes";
  if (view.surface_points.size() != view.surface_normals.size()) return "has not one normal for each surface point";
  if (!view.surface_colors.empty() && view.surface_colors.size() != view.surface_points.size()) {
    return "has not one colour for each surface point";
  }
  if (!within(view.sensor_origin, largest_length)) return "has a sensor origin that is not within 1000 km";
  if (!within(view.box_min, largest_length) || !within(view.box_max, largest_length)) {
    return "has a box that is not within 1000 km";
  }
  if ((view.box_min.array() > view.box_max.array()).any()) return "has a box of negative size";
  if (view.T_model_source) {
    const Eigen::Matrix4f pose = view.T_model_source->matrix().cast<float>();
    if (!within(pose.topLeftCorner<3, 3>(), largest_of_unit) || !within(pose.col(3), largest_length)) {
      return "has a pose in its model that is none";
    }
  }
  if (!allWithin(view.surface_points, largest_length)) return "has a surface that is not within 1000 km";
  if (!allWithin(view.surface_normals, largest_of_unit)) return "has a surface normal that is no unit vector";
  if (!allWithin(view.surface_colors, largest_color)) return "has a surface colour that is none";
  return "";
}

std::string modelFault(const Codebook& codebook, const RegisteredModel& model) {
  const FusedModel& surface = model.surface;
  if (model.object >= codebook.objects.size()) return "belongs to an object that is not there";
  if (model.frame.empty() || model.frame.size() > longest_frame)
    return "has a frame without a name of at most 4096 bytes";
  if (surface.points.empty() || surface.points.size() != surface.normals.size()) {
    return "has not one normal for each of its points";
  }
  if (!surface.colors.empty() && surface.colors.size() != surface.points.size()) {
    return "has not one colour for each of its points";
  }
  if (!within(surface.box.min(), largest_length) || !within(surface.box.max(), largest_length)) {
    return "has a box that is not within 1000 km";
  }
  if (surface.box.isEmpty()) return "has a box of negative size";
  if (!allWithin(surface.points, largest_length)) return "does not lie within 1000 km";
  if (!allWithin(surface.normals, largest_of_unit)) return "has a normal that is no unit vector";
  if (model.symmetry && (!within(model.symmetry->axis, double(largest_of_unit)) || model.symmetry->order < 0 ||
                         model.symmetry->order > most_rotations)) {
    return "has a symmetry that is none";
  }
  return "";
}

}  // namespace

std::uint32_t CodebookHeader::ownChecksum() const {
  return crc32c(this, offsetof(CodebookHeader, header_checksum));
}

CodebookHeader checkCodebookHeader(const std::uint8_t* file, std::size_t size) {
  CodebookHeader header;
  const CodebookHeader model;
  if (size == 0) fail("it is empty; train it again");
  if (std::memcmp(file, model.magic, std::min(size, sizeof(model.magic))) != 0) fail("it is no codebook");
  if (size < sizeof(header)) fail("it is truncated: " + std::to_string(size) + " bytes; copy it again");
  std::memcpy(&header, file, sizeof(header));
  if (header.ownChecksum() != header.header_checksum) fail("its header is damaged; copy or train it again");
  if (header.version > codebook_file_version) {
    fail("it was written by a newer version (file format " + std::to_string(header.version) +
         ", this build reads up to " + std::to_string(codebook_file_version) + "): update sks_detector");
  }
  if (size < header.file_size) {
    fail("it is truncated: " + std::to_string(size) + " of " + std::to_string(header.file_size) +
         " bytes; copy it again");
  }
  const bool fits = header.version > 0 && header.header_size == sizeof(header) && size == header.file_size &&
                    header.metadata_size <= largest_metadata &&
                    inside(header.metadata_offset, header.metadata_size, size) &&
                    inside(header.descriptors_offset, header.descriptors_size, size);
  if (!fits || crc32c(file + sizeof(header), size - sizeof(header)) != header.payload_checksum) {
    fail("it is damaged (its checksum does not match); copy or train it again");
  }
  return header;
}

void checkCodebookName(const std::string& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  const bool special = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (special || std::filesystem::path(path).extension() == ".sks") return;
  throw Error(ErrorCode::bad_usage, "'" + shown(path) + "' is not called like a codebook; let its name end with .sks");
}

std::string descriptorText(const Codebook& codebook) {
  return codebook.own_descriptor.empty() ? toText(codebook.descriptor_type) : own_prefix + codebook.own_descriptor;
}

bool readDescriptorText(const std::string& text, Codebook& codebook) {
  const std::size_t prefix = std::strlen(own_prefix);
  if (text.compare(0, prefix, own_prefix) != 0) return fromText(text, codebook.descriptor_type);
  codebook.descriptor_type = DescriptorType::automatic;
  codebook.own_descriptor = text.substr(prefix);
  return !codebook.own_descriptor.empty();
}

std::string codebookFault(const Codebook& codebook) {
  const std::size_t columns = codebook.descriptorSize();
  const QuantizedDescriptors& descriptors = codebook.descriptors;
  if (columns == 0) return "its descriptor type is not decided";
  if (descriptors.rows() != codebook.words.size() || (descriptors.rows() > 0 && descriptors.cols() != columns)) {
    return "its " + std::to_string(codebook.words.size()) + " codewords have " + std::to_string(descriptors.rows()) +
           " descriptors of " + std::to_string(descriptors.cols()) + " bins";
  }
  const QuantizedDescriptors& background = codebook.background;
  if (background.rows() > 0 && background.cols() != columns) {
    return "the descriptors of its background have " + std::to_string(background.cols()) + " bins, not " +
           std::to_string(columns);
  }
  for (std::size_t i = 0; i < background.rows(); ++i) {
    if (!isScale(background.scale(i))) return "descriptor " + std::to_string(i) + " of its background is none";
  }
  if (!codebook.name.empty() && !nameFault(codebook.name).empty()) {
    return "its name '" + shown(codebook.name, 60) + "' cannot be used: " + nameFault(codebook.name);
  }
  for (const std::string& object : codebook.objects) {
    const std::string fault = nameFault(object);
    if (!fault.empty()) return "the name '" + shown(object, 60) + "' of an object cannot be used: " + fault;
  }
  for (const TrainingView& view : codebook.views) {
    const std::string fault = viewFault(codebook, view);
    if (!fault.empty()) return "its training cloud '" + shown(view.source) + "' " + fault;
  }
  for (const RegisteredModel& model : codebook.models) {
    const std::string fault = modelFault(codebook, model);
    if (!fault.empty()) return "its model '" + shown(model.frame) + "' " + fault;
  }
  for (std::size_t i = 0; i < codebook.words.size(); ++i) {
    const Codeword& word = codebook.words[i];
    const std::string name = "its codeword " + std::to_string(i);
    if (word.view >= codebook.views.size()) return name + " belongs to a training cloud that is not there";
    if (!within(word.position, largest_length)) return name + " does not lie within 1000 km";
    if (!within(word.frame, largest_of_unit)) return name + " has a reference frame whose axes are no unit vectors";
    if (!isScale(descriptors.scale(i))) return name + " has a descriptor that is none";
  }
  return "";
}

}  // namespace sks
