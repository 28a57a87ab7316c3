// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_exposure.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr int darkest = 8, brightest = 247;  // levels between which a camera answers to light
constexpr int rounds = 100;                  // a difference travels from neighbour to neighbour all around the object

struct Observation {
  std::size_t place = 0, view = 0;
  Eigen::Array3f logarithm;
};

bool tells(const Rgb& color) {
  const auto [low, high] = std::minmax({color.r, color.g, color.b});
  return low >= darkest && high <= brightest;
}

}  // namespace

std::vector<Eigen::Array3f> exposureFactors(const std::vector<SeenColor>& seen, std::size_t views) {
  std::vector<Observation> all;
  for (const SeenColor& s : seen) {
    if (!tells(s.color)) continue;
    all.push_back({s.place, s.view, Eigen::Array3f(s.color.r, s.color.g, s.color.b).log()});
  }
  std::vector<Eigen::Array3f> shifts(views, Eigen::Array3f::Zero());
  for (int round = 0; round < rounds; ++round) {
    std::vector<Eigen::Array3f> sums(views, Eigen::Array3f::Zero());
    std::vector<float> counts(views, 0);
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      Eigen::Array3f mean = Eigen::Array3f::Zero();
      bool shared = false;
      for (end = begin; end < all.size() && all[end].place == all[begin].place; ++end) {
        mean += all[end].logarithm + shifts[all[end].view];
        shared = shared || all[end].view != all[begin].view;
      }
      if (!shared) continue;
      mean /= float(end - begin);
      for (std::size_t i = begin; i < end; ++i) {
        sums[all[i].view] += mean - all[i].logarithm - shifts[all[i].view];
        counts[all[i].view] += 1;
      }
    }
    Eigen::Array3f mean = Eigen::Array3f::Zero();
    for (std::size_t v = 0; v < views; ++v) {
      if (counts[v] > 0) shifts[v] += sums[v] / counts[v];
      mean += shifts[v] / float(views);
    }
    for (Eigen::Array3f& shift : shifts) shift -= mean;
  }
  for (Eigen::Array3f& shift : shifts) shift = shift.exp();
  return shifts;
}

Rgb exposed(const Rgb& color, const Eigen::Array3f& factors) {
  const Eigen::Array3f levels = (Eigen::Array3f(color.r, color.g, color.b) * factors).round().min(255.0f);
  return {std::uint8_t(levels[0]), std::uint8_t(levels[1]), std::uint8_t(levels[2])};
}

}  // namespace sks
