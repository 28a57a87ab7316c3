// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "io/image_codec.hpp"

namespace sks {

/// Numbers at places of a picture file, lowest byte first; what lies behind its end is refused.
class LittleEndian {
public:
  explicit LittleEndian(const std::string& bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  /// @throws CodecError
  std::uint8_t u8(std::size_t at) const {
    if (at >= bytes_.size()) throw CodecError("it is cut off");
    return static_cast<std::uint8_t>(bytes_[at]);
  }
  std::uint32_t u16(std::size_t at) const { return u8(at) | std::uint32_t(u8(at + 1)) << 8; }
  std::uint32_t u32(std::size_t at) const { return u16(at) | u16(at + 2) << 16; }

private:
  const std::string& bytes_;
};

}  // namespace sks
