// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/quantized_descriptors.hpp>
#include <sks_detector/stages/surface.hpp>
#include <sks_detector/symmetry.hpp>

namespace sks {

/// What a training cloud shows.
enum class ViewKind : std::uint8_t {
  view,  ///< 2.5-D, seen from its sensor origin
  model  ///< full 3-D
};

/// Which way the normals of such a cloud point.
constexpr Orientation orientationOf(ViewKind kind) {
  return kind == ViewKind::model ? Orientation::outward : Orientation::sensor;
}

/// One training cloud: its frame is the model frame of the poses that its codewords lead to. Views of one object with
/// the same `frame` are registered to each other: they speak for one pose together.
struct TrainingView {
  std::uint32_t object = 0;  ///< index into Codebook::objects
  std::string source;        ///< where it came from, e.g. the path of the cloud in the data set file
  std::string frame;         ///< name of the model frame that it shares with other views; empty: its own
  ViewKind kind = ViewKind::view;
  Eigen::Vector3f sensor_origin = Eigen::Vector3f::Zero();  ///< [m], model frame
  Eigen::Vector3f box_min = Eigen::Vector3f::Zero();        ///< corners of the axis-aligned bounding box [m]
  Eigen::Vector3f box_max = Eigen::Vector3f::Zero();
  /// Of a captured view that was registered: pose of the frame of its cloud in the model frame.
  std::optional<Eigen::Isometry3d> T_model_source;
  std::vector<Eigen::Vector3f> surface_points;   ///< thinned surface [m], model frame
  std::vector<Eigen::Vector3f> surface_normals;  ///< its unit normals
  std::vector<Eigen::Vector3f> surface_colors;   ///< its colours, as in Surface; empty without colour

  const std::string& frameName() const { return frame.empty() ? source : frame; }
  /// What the centre vectors of its codewords point to, and what a detection reports as its position.
  Eigen::Vector3f center() const { return 0.5f * (box_min + box_max); }
  Eigen::Vector3f extent() const { return box_max - box_min; }
};

/// Where a codeword was seen; its descriptor is the row of the same index in Codebook::descriptors.
struct Codeword {
  std::uint32_t view = 0;                               ///< index into Codebook::views
  Eigen::Vector3f position = Eigen::Vector3f::Zero();   ///< keypoint p_t [m], model frame
  Eigen::Matrix3f frame = Eigen::Matrix3f::Identity();  ///< local reference frame R_t; rows are the axes
};

/// What was seen of an object in all of its registered views: one point for each part of the surface, averaged over the
/// views. In the model frame [m].
struct FusedModel {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;  ///< unit, outwards
  std::vector<Rgb> colors;               ///< empty without colour
  Eigen::AlignedBox3f box;               ///< of the whole object; down to the supporting plane where that is known
};

/// The whole surface of an object whose captured views were registered, for display and planning.
struct RegisteredModel {
  std::uint32_t object = 0;          ///< index into Codebook::objects
  std::string frame;                 ///< its model frame: TrainingView::frame of the views that it was made of
  FusedModel surface;                ///< about one point for each cube of `training.surface_resolution`
  std::optional<Symmetry> symmetry;  ///< as in RegisteredObject
};

/// What the checksum of a codebook is, once it is known: see codebookChecksum(). A copy may be changed: it does not
/// know it. Thread-safe.
class RememberedChecksum {
public:
  RememberedChecksum() = default;
  RememberedChecksum(const RememberedChecksum& /*other*/) {}
  RememberedChecksum(RememberedChecksum&& other) noexcept : value_(other.value_.load()) {}
  RememberedChecksum& operator=(const RememberedChecksum& /*other*/) {
    value_ = unknown;
    return *this;
  }
  RememberedChecksum& operator=(RememberedChecksum&& other) noexcept {
    value_ = other.value_.load();
    return *this;
  }

  std::optional<std::uint32_t> get() const {
    const std::uint64_t value = value_;
    return value == unknown ? std::nullopt : std::optional<std::uint32_t>(std::uint32_t(value));
  }
  void set(std::uint32_t checksum) const { value_ = checksum; }

private:
  static constexpr std::uint64_t unknown = ~std::uint64_t(0);
  mutable std::atomic<std::uint64_t> value_{unknown};
};

/// All that training leaves behind (section 3.1: every codeword is kept). Immutable once built: share it as
/// `std::shared_ptr<const Codebook>` between threads.
struct Codebook {
  std::string name;                                       ///< for people: the name of the data set, or as given
  DescriptorType descriptor_type = DescriptorType::shot;  ///< what the descriptors are; `automatic` only if foreign
  std::string own_descriptor;                             ///< name of the user's DescriptorStage; empty: SHOT or CSHOT
  Settings settings;                                      ///< what it was trained with
  std::vector<std::string> objects;                       ///< names, in order of their first training cloud
  std::vector<TrainingView> views;
  std::vector<Codeword> words;
  QuantizedDescriptors descriptors;  ///< words.size() rows
  /// Of what stands about in rooms, which competes with the codewords; no rows: a detector makes them where it needs
  /// them.
  QuantizedDescriptors background;
  std::vector<RegisteredModel> models;  ///< of objects whose captured views were registered
  RememberedChecksum checksum;          ///< for codebookChecksum()

  const std::string& objectOf(const Codeword& word) const { return objects[views[word.view].object]; }
  /// "shot", "cshot" or the name of the user's DescriptorStage.
  std::string descriptorName() const;
  /// Values of one descriptor.
  std::size_t descriptorSize() const;
  /// The model in whose frame the poses of a view are; null if it has none.
  const RegisteredModel* modelOf(const TrainingView& view) const;
  /// Of any view along an axis of its box [m].
  float largestExtent() const;
};

}  // namespace sks
