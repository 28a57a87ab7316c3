// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.hpp"

#include <gtest/gtest.h>

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes decompressed(const Bytes& packed, std::size_t size) {
  Bytes data;
  EXPECT_TRUE(sks::decompressLzf(packed, size, data));
  return data;
}

bool refuses(const Bytes& packed, std::size_t size) {
  Bytes data;
  return !sks::decompressLzf(packed, size, data);
}

}  // namespace

TEST(Lzf, LiteralsAndReferences) {
  EXPECT_EQ(decompressed({}, 0), Bytes{});
  EXPECT_EQ(decompressed({2, 'a', 'b', 'c'}, 3), (Bytes{'a', 'b', 'c'}));
  // 3 bytes from 3 back
  EXPECT_EQ(decompressed({2, 'a', 'b', 'c', 1 << 5, 2}, 6), (Bytes{'a', 'b', 'c', 'a', 'b', 'c'}));
  // a reference into its own output: 4 bytes from 1 back
  EXPECT_EQ(decompressed({0, 'a', 2 << 5, 0}, 5), Bytes(5, 'a'));
  // a long one: 7 + 255 + 2 bytes
  EXPECT_EQ(decompressed({0, 'a', 7 << 5, 255, 0}, 265), Bytes(265, 'a'));
  // a distance over two bytes: 3 bytes from 302 back, the first of all
  Bytes packed = {0, 'x', 7 << 5, 255, 0, 7 << 5, 25, 0, 2, '1', '2', '3', 1 << 5 | 301 >> 8, 301 & 255};
  const Bytes data = decompressed(packed, 305);
  EXPECT_EQ(Bytes(data.end() - 6, data.end()), (Bytes{'1', '2', '3', 'x', 'x', 'x'}));
}

TEST(Lzf, DamageIsRefused) {
  EXPECT_TRUE(refuses({2, 'a', 'b'}, 3)) << "literals beyond the end";
  EXPECT_TRUE(refuses({2, 'a', 'b', 'c'}, 2)) << "more than asked for";
  EXPECT_TRUE(refuses({2, 'a', 'b', 'c'}, 4)) << "less than asked for";
  EXPECT_TRUE(refuses({0, 'a', 1 << 5, 1}, 4)) << "a reference before the start";
  EXPECT_TRUE(refuses({0, 'a', 1 << 5}, 4)) << "a reference without its distance";
  EXPECT_TRUE(refuses({0, 'a', 7 << 5}, 4)) << "a reference without its length";
  EXPECT_TRUE(refuses({0, 'a', 2 << 5, 0}, 4)) << "a reference beyond the size";
}
