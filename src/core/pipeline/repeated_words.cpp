// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/repeated_words.hpp"

#include <cmath>

#include "core/matching/chi_squared.hpp"

namespace sks {
namespace {

constexpr float same_distance = 0.5f;     // chi squared; the same place seen twice by a sensor differs by 0.8 and more
constexpr float same_rotation = 0.9659f;  // cosine of 15 degrees

float cosineBetween(const Eigen::Matrix3f& a, const Eigen::Matrix3f& b) {
  return 0.5f * (a.cwiseProduct(b).sum() - 1);
}

}  // namespace

RepeatedWords::Cell RepeatedWords::cellOf(const Codeword& word) const {
  const auto cell = [this](float coordinate) { return int(std::floor(coordinate / same_place_)); };
  return {cell(word.position.x()), cell(word.position.y()), cell(word.position.z())};
}

void RepeatedWords::beginView(const std::string& name) {
  if (name == model_) return;
  model_ = name;
  cells_.clear();
}

bool RepeatedWords::repeats(const Codeword& word, const float* bins, const Quantizer& rows) {
  buffer_.resize(rows.cols());
  const auto [x, y, z] = cellOf(word);
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        const auto cell = cells_.find({x + dx, y + dy, z + dz});
        if (cell == cells_.end()) continue;
        for (const Place& place : cell->second) {
          if ((place.word.position - word.position).squaredNorm() > same_place_ * same_place_) continue;
          if (cosineBetween(place.word.frame, word.frame) < same_rotation) continue;
          rows.read(place.index, buffer_.data());
          if (chiSquaredFast(bins, buffer_.data(), rows.cols()) < same_distance) return true;
        }
      }
    }
  }
  return false;
}

void RepeatedWords::add(const Codeword& word, std::uint32_t index) {
  cells_[cellOf(word)].push_back({word, index});
}

}  // namespace sks
