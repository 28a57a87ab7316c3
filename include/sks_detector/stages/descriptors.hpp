// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Bins of SHOT: 32 volumes (8 azimuth x 2 elevation x 2 radial) of 11 cosine bins.
constexpr std::size_t shot_size = 352;
/// Bins of CSHOT: SHOT, then the same 32 volumes of 31 colour distance bins.
constexpr std::size_t cshot_size = 1344;

/// Number of bins of a descriptor type; `automatic` has none (0).
std::size_t descriptorSize(DescriptorType type);

/// Read-only matrix of descriptors, one a row, row-major; shares its storage (a vector or a mapped file).
class DescriptorMatrix {
public:
  DescriptorMatrix() = default;
  /// Takes over `values`, whose size must be a multiple of `cols`.
  DescriptorMatrix(std::vector<float> values, std::size_t cols);
  /// Refers to `data`, which stays alive as long as `owner`.
  DescriptorMatrix(const float* data, std::size_t rows, std::size_t cols, std::shared_ptr<const void> owner);

  std::size_t rows() const { return rows_; }
  std::size_t cols() const { return cols_; }
  const float* row(std::size_t i) const { return data_ + i * cols_; }
  const float* data() const { return data_; }

private:
  const float* data_ = nullptr;
  std::size_t rows_ = 0;
  std::size_t cols_ = 0;
  std::shared_ptr<const void> owner_;
};

/// Descriptors of those keypoints at which one could be computed.
struct Descriptors {
  std::vector<std::uint32_t> keypoints;  ///< index of the keypoint of each row, ascending
  std::vector<Eigen::Matrix3f> frames;   ///< local reference frame of each row; its rows are the axes x, y, z
  DescriptorMatrix values;               ///< L2-normalised
};

/// SHOT or CSHOT with its local reference frame at each keypoint (Tombari, Salti, Di Stefano 2010, 2011).
/// A keypoint without enough neighbours, or without a unique frame, gets none.
/// Deterministic for any number of threads.
/// @param type shot or cshot (cshot needs a surface with colour)
/// @throws Error(incompatible) for cshot on a surface without colour
Descriptors computeDescriptors(const Surface& surface, const Keypoints& keypoints, DescriptorType type,
                               const DescriptorSettings& settings, int threads);

}  // namespace sks
