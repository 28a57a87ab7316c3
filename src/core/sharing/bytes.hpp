// SPDX-License-Identifier: BSD-3-Clause
// Values as bytes, from one process of this program to another on a machine of the same kind: numbers as they lie in
// memory, texts and lists with their length in front. A structure is stored by a function that names its fields,
//
//   template <typename Archive>
//   void fields(Archive& archive, Thing& thing) {
//     archive(thing.name, thing.sizes);
//   }
//
// which writes them with a ByteWriter and reads them with a ByteReader.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/error.hpp>

namespace sks {

/// What both directions have in common: takes values apart down to numbers, which `Raw` stores or loads.
template <typename Raw>
class ByteArchive {
public:
  template <typename... Values>
  void operator()(Values&... values) {
    (value(values), ...);
  }

private:
  template <typename Value>
  void value(Value& v) {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
      raw().bytes(&v, sizeof(v));
    } else {
      fields(*this, v);
    }
  }

  void value(std::string& text) {
    const std::size_t size = raw().length(text.size(), 1);
    text.resize(size);
    raw().bytes(text.data(), size);
  }

  template <typename Item>
  void value(std::vector<Item>& items) {
    constexpr std::size_t least = std::is_arithmetic_v<Item> ? sizeof(Item) : 1;  // bytes of an item
    items.resize(raw().length(items.size(), least));
    if constexpr (std::is_arithmetic_v<Item>) {
      raw().bytes(items.data(), items.size() * sizeof(Item));
    } else {
      for (Item& item : items) value(item);
    }
  }

  template <typename Item>
  void value(std::optional<Item>& item) {
    bool there = item.has_value();
    value(there);
    if (!there) {
      item.reset();
      return;
    }
    if (!item) item.emplace();
    value(*item);
  }

  template <typename Scalar, int rows, int cols, int options>
  void value(Eigen::Matrix<Scalar, rows, cols, options>& matrix) {
    static_assert(rows != Eigen::Dynamic && cols != Eigen::Dynamic, "of a fixed size");
    raw().bytes(matrix.data(), std::size_t(rows * cols) * sizeof(Scalar));
  }

  template <typename Scalar>
  void value(Eigen::Transform<Scalar, 3, Eigen::Isometry>& T) {
    value(T.matrix());
  }

  template <typename Scalar>
  void value(Eigen::AlignedBox<Scalar, 3>& box) {
    value(box.min());
    value(box.max());
  }

  Raw& raw() { return static_cast<Raw&>(*this); }
};

class ByteWriter : public ByteArchive<ByteWriter> {
public:
  std::string release() { return std::move(bytes_); }

private:
  friend class ByteArchive<ByteWriter>;

  void bytes(const void* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }
  std::size_t length(std::size_t size, std::size_t /*least*/) {
    const std::uint64_t stored = size;
    bytes(&stored, sizeof(stored));
    return size;
  }

  std::string bytes_;
};

/// Refers to the bytes. Its functions throw Error(bad_data) where these end too early.
class ByteReader : public ByteArchive<ByteReader> {
public:
  explicit ByteReader(const std::string& from) : from_(from) {}

private:
  friend class ByteArchive<ByteReader>;

  void bytes(void* data, std::size_t size) {
    if (size > from_.size() - at_) cutOff();
    if (size > 0) std::memcpy(data, from_.data() + at_, size);
    at_ += size;
  }
  std::size_t length(std::size_t /*size*/, std::size_t least) {
    std::uint64_t stored = 0;
    bytes(&stored, sizeof(stored));
    if (stored > (from_.size() - at_) / least) cutOff();
    return std::size_t(stored);
  }
  [[noreturn]] static void cutOff() {
    throw Error(ErrorCode::bad_data, "a result of another process is cut off; are all processes of the same build?");
  }

  const std::string& from_;
  std::size_t at_ = 0;
};

template <typename Value>
std::string bytesOf(Value value) {
  ByteWriter writer;
  writer(value);
  return writer.release();
}

/// @throws Error(bad_data) for bytes of something else
template <typename Value>
Value fromBytes(const std::string& bytes) {
  ByteReader reader(bytes);
  Value value;
  reader(value);
  return value;
}

}  // namespace sks
