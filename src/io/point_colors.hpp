// SPDX-License-Identifier: BSD-3-Clause
// How the colours of points are called and what their numbers mean, in clouds and meshes of every format.
//
// Names (in any case): `rgb` or `rgba` for one packed value, else three channels: red green blue, diffuse_red
// diffuse_green diffuse_blue, or r g b. Values of 8 bits are what they are. For all others the largest value of the
// three channels decides what stands for full brightness: 1 for reals up to 1; 255 for what is up to 255; 65535 for
// what is up to 65535; more is refused. A picture of 16 bits with nothing above 255 would be black to the eye: it holds
// 8 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>

namespace sks {

/// Index of the field that packs a colour into one value; none where there is none.
std::optional<std::size_t> packedColorField(const std::vector<std::string>& names);

/// Indices of the fields for red, green and blue; none where one is missing.
std::optional<std::array<std::size_t, 3>> colorChannelFields(const std::vector<std::string>& names);

/// A colour of four bytes, as PCL packs it: 0xAARRGGBB.
Rgb unpackedColor(std::uint32_t packed);

/// Colours of points by the values of their channels. NaN is black, what is below 0 counts as 0.
/// @param types of the channels, PointField::Type
/// @throws Error(bad_data) where values are above 65535
std::vector<Rgb> colorsOfChannels(const std::vector<Eigen::Vector3f>& channels,
                                  const std::array<std::uint8_t, 3>& types);

/// The same for the surface of a mesh, which has colours only where its file states all of them.
/// @return none where a value is not finite
std::vector<Rgb> statedColors(const std::vector<Eigen::Vector3f>& channels, const std::array<std::uint8_t, 3>& types);

}  // namespace sks
