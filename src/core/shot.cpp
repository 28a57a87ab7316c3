// SPDX-License-Identifier: BSD-3-Clause
// SHOT and CSHOT histograms (Tombari, Salti, Di Stefano 2010, 2011). Weights and neighbouring bins are those of PCL's
// implementation, so that descriptors of both agree.
#include "core/shot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sks {
namespace {

constexpr int sector_step = 4, husk_step = 2, half_step = 1;  // in the numbering of ShotSupport::volume
constexpr int volumes = 32;

/// Adds one neighbour whose value lies at `position` in 0 to `steps`, interpolated linearly to the adjacent value bin,
/// husk, half and sector. A value histogram has steps + 1 bins.
void addInterpolated(const ShotSupport& support, std::size_t i, float position, int steps, float* histogram) {
  const int bins = steps + 1;
  const int bin = int(position + 0.5f), volume = support.volume[i];
  float* own = histogram + volume * bins;
  const float offset = position - float(bin);
  const float azimuth = support.azimuth[i], husk = support.husk[i], elevation = support.elevation[i];

  // PCL wraps at `steps`, not at `bins`; kept for equal descriptors.
  if (offset > 0) {
    own[(bin + 1) % steps] += offset;
  } else {
    own[(bin - 1 + steps) % steps] -= offset;
  }
  float weight = 1.0f - std::abs(offset);

  // Towards the rim, the centre and the poles there is no further volume: the neighbour keeps the full weight's decay.
  weight += 1.0f - std::abs(husk);
  const bool outer = volume & husk_step;
  if (outer && husk < 0) own[-husk_step * bins + bin] -= husk;
  if (!outer && husk > 0) own[husk_step * bins + bin] += husk;

  weight += 1.0f - std::abs(elevation);
  const bool upper = volume & half_step;
  if (upper && elevation > 0) own[-half_step * bins + bin] += elevation;
  if (!upper && elevation < 0) own[half_step * bins + bin] -= elevation;

  weight += 1.0f - std::abs(azimuth);
  const int next = (volume + (azimuth > 0 ? sector_step : volumes - sector_step)) % volumes;
  histogram[next * bins + bin] += std::abs(azimuth);

  own[bin] += weight;
}

}  // namespace

void addShapeHistogram(const Neighborhood& n, const ShotSupport& support, float* histogram) {
  constexpr int steps = 10;
  for (std::size_t i = 0; i < n.size; ++i) {
    const float cosine = support.cosine[i];
    if (std::isnan(cosine) || n.distance[i] == 0) continue;
    addInterpolated(support, i, 0.5f * steps * (1.0f + std::clamp(cosine, -1.0f, 1.0f)), steps, histogram);
  }
}

void addColorHistogram(const Surface& surface, const Neighborhood& n, const ShotSupport& support, float core_radius,
                       float* histogram) {
  constexpr int steps = 30;
  std::array<float, 3> own{};
  std::size_t count = 0, nearest = 0;
  for (std::size_t i = 0; i < n.size; ++i) {
    if (n.distance[i] < n.distance[nearest]) nearest = i;
    if (n.distance[i] > core_radius) continue;
    ++count;
    for (int k = 0; k < 3; ++k) own[k] += surface.color[n.index[i]][k];
  }
  for (int k = 0; k < 3; ++k) own[k] = count > 0 ? own[k] / float(count) : surface.color[n.index[nearest]][k];

  for (std::size_t i = 0; i < n.size; ++i) {
    if (n.distance[i] == 0) continue;
    const auto& color = surface.color[n.index[i]];
    const float difference =
        (std::abs(own[0] - color[0]) + 0.5f * (std::abs(own[1] - color[1]) + std::abs(own[2] - color[2]))) / 3.0f;
    addInterpolated(support, i, steps * std::clamp(difference, 0.0f, 1.0f), steps, histogram);
  }
}

bool normalize(float* histogram, std::size_t size) {
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += double(histogram[i]) * histogram[i];
  if (!(sum > 0)) return false;
  const float scale = float(1.0 / std::sqrt(sum));
  for (std::size_t i = 0; i < size; ++i) histogram[i] *= scale;
  return true;
}

}  // namespace sks
