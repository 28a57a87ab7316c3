// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/word_codes.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr std::size_t leftover = code_size - 1;  // position of what the axes before it leave over
constexpr float quantization = 1e-3f;            // above the relative error that this leaves in an inner product
constexpr float code_rounding = 4e-6f;           // above that of sums in single precision

}  // namespace

WordCodes::WordCodes(const SearchedWords& words) : axes_(words, code_size), floor_(1e-3f * axes_.meanMass() + 1e-20f) {}

std::vector<CodedVector> WordCodes::encode(const SearchedWords& words) {
  std::vector<CodedVector> codes(words.rows());
  HellingerAxes::Projection projection;
  std::vector<float> buffer;
  for (std::size_t i = 0; i < words.rows(); ++i) {
    axes_.project(words.row(i, buffer), projection);
    encode(projection, codes[i]);
    longest_ = std::max(longest_, std::sqrt(codes[i].squares));
    largest_mass_ = std::max(largest_mass_, projection.mass);
  }
  return codes;
}

void WordCodes::encode(const HellingerAxes::Projection& projection, CodedVector& vector) const {
  vector.squares = projection.squares + floor_;
  const float length = std::sqrt(vector.squares);
  vector.unit = length / code_length;
  const auto rounded = [&](float value) {
    return std::int16_t(std::lrint(std::clamp(value / length, -1.0f, 1.0f) * code_length));
  };
  vector.code.fill(0);
  float left = projection.squares;
  for (Eigen::Index axis = 0; axis < std::min<Eigen::Index>(leftover, projection.coordinates.size()); ++axis) {
    const float coordinate = projection.coordinates[axis];
    vector.code[std::size_t(axis)] = rounded(coordinate);
    left -= coordinate * coordinate;
  }
  // The floor brings what is left over of two histograms nearer to each other, so bounds stay bounds; without it the
  // root of a rounding error would be taken for a distance where nothing is left over.
  vector.code[leftover] = rounded(std::sqrt(std::max(left, 0.0f) + floor_));
}

void WordCodes::encode(const float* histogram, HellingerAxes::Projection& projection, CodedQuery& query) const {
  axes_.project(histogram, projection);
  encode(projection, query.vector);
  const float length = std::sqrt(query.vector.squares);
  query.slack = quantization * length * longest_ +
                code_rounding * (projection.mass + largest_mass_) * (1 + (length + longest_) / std::sqrt(floor_));
}

}  // namespace sks
