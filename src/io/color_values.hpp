// SPDX-License-Identifier: BSD-3-Clause
// How files write colours, for clouds and meshes alike.
#pragma once

#include <array>
#include <vector>

#include <sks_detector/cloud.hpp>

namespace sks {

using ChannelNames = std::array<const char*, 3>;

/// What red, green and blue are called in files, in the order in which they are looked for.
constexpr std::array<ChannelNames, 3> channel_names = {
    {{"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}}};

/// Colours from numbers as a file holds them, three for each. The largest one tells their range: [0, 1] (not of whole
/// numbers), [0, 255] or [0, 65535].
/// @return empty where a number is not finite: then the file states no colours
std::vector<Rgb> colorsOf(const std::vector<float>& channels, bool whole_numbers);

}  // namespace sks
