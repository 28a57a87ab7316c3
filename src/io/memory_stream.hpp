// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <istream>
#include <streambuf>

namespace sks {

/// Lets a stream read memory that belongs to somebody else.
class MemoryBuffer : public std::streambuf {
public:
  MemoryBuffer(const void* data, std::size_t size) {
    char* const begin = static_cast<char*>(const_cast<void*>(data));
    setg(begin, begin, begin + size);
  }

protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const char* const base = from == std::ios_base::beg ? eback() : from == std::ios_base::cur ? gptr() : egptr();
    const off_type target = base - eback() + offset;
    if (target < 0 || target > egptr() - eback()) return pos_type(off_type(-1));
    setg(eback(), eback() + target, egptr());
    return pos_type(target);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }
};

/// A stream over memory, which must outlive it.
class MemoryStream : private MemoryBuffer, public std::istream {
public:
  MemoryStream(const void* data, std::size_t size) : MemoryBuffer(data, size), std::istream(this) {}
};

}  // namespace sks
