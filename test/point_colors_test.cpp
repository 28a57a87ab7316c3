// SPDX-License-Identifier: BSD-3-Clause
// Clouds as other programs write them: names and types of colours, ends of lines, words for no number.
#include "io/point_colors.hpp"

#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>

#include "error_of.hpp"
#include "io/point_fields.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<int> numbers(const Rgb& color) {
  return {color.r, color.g, color.b};
}

template <typename T>
std::string bytesOf(std::initializer_list<T> values) {
  std::string result;
  for (const T value : values) result.append(reinterpret_cast<const char*>(&value), sizeof(value));
  return result;
}

class CloudVariants : public ::testing::Test {
protected:
  Cloud read(const std::string& content) const {
    test::writeFile(path(), content);
    return readCloud(path());
  }
  std::string path() const { return folder_.path("cloud"); }

  /// Two points in a PLY file whose colours are 255 0 51 and 0 102 255, in the numbers and names of the caller.
  Cloud ply(const std::string& type, const std::vector<std::string>& names, const std::string& first,
            const std::string& second) const {
    std::string header =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
    for (const std::string& name : names) header += "property " + type + " " + name + "\n";
    return read(header + "end_header\n1 2 3 " + first + "\n4 5 6 " + second + "\n");
  }
  static void expectColors(const Cloud& cloud) {
    ASSERT_EQ(cloud.colors.size(), 2u);
    EXPECT_THAT(numbers(cloud.colors[0]), ElementsAre(255, 0, 51));
    EXPECT_THAT(numbers(cloud.colors[1]), ElementsAre(0, 102, 255));
    EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  }

  test::TemporaryFolder folder_;
};

const std::vector<std::string> rgb_names{"red", "green", "blue"};

TEST_F(CloudVariants, NamesOfColours) {
  for (const auto& names : {rgb_names,
                            {"diffuse_red", "diffuse_green", "diffuse_blue"},
                            {"r", "g", "b"},
                            {"R", "G", "B"},
                            {"Red", "Green", "Blue"}}) {
    SCOPED_TRACE(names[0]);
    expectColors(ply("uchar", names, "255 0 51", "0 102 255"));
  }
  EXPECT_FALSE(ply("uchar", {"red", "green", "quality"}, "255 0 51", "0 102 255").hasColor());
}

TEST_F(CloudVariants, TypesOfColours) {
  for (const char* type : {"uchar", "uint8", "char", "short", "ushort", "int", "uint", "float", "double"}) {
    SCOPED_TRACE(type);
    expectColors(ply(type, rgb_names, "255 0 51", "0 102 255"));  // whole numbers up to 255, whatever their type
  }
  for (const char* type : {"float", "double"}) expectColors(ply(type, rgb_names, "1 0 0.2", "0 0.4 1"));
  for (const char* type : {"ushort", "int", "float"})
    expectColors(ply(type, rgb_names, "65535 0 13107", "0 26214 65535"));
  const auto message = test::errorOf(ErrorCode::bad_file, [&] { ply("int", rgb_names, "70000 0 0", "0 0 0"); });
  EXPECT_THAT(message, HasSubstr("its colours go up to 70000; full brightness must be 1 (reals), 255 or 65535"));
  const Cloud odd = ply("float", rgb_names, "nan -1 0.5", "1 1 inf");
  EXPECT_THAT(numbers(odd.colors[0]), ElementsAre(0, 0, 128));
  EXPECT_THAT(numbers(odd.colors[1]), ElementsAre(255, 255, 255));
}

TEST_F(CloudVariants, ColoursInBinaryPlyOfBothByteOrders) {
  const std::string header =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "property ushort red\nproperty ushort green\nproperty ushort blue\nend_header\n";
  const auto point = [](std::initializer_list<float> place, std::initializer_list<std::uint16_t> color, bool swapped) {
    std::string result;
    const auto add = [&](const std::string& value) {
      result += swapped ? std::string(value.rbegin(), value.rend()) : value;
    };
    for (const float v : place) add(bytesOf({v}));
    for (const std::uint16_t v : color) add(bytesOf({v}));
    return result;
  };
  for (const bool swapped : {false, true}) {
    expectColors(read(std::string("ply\nformat binary_") + (swapped ? "big" : "little") + "_endian 1.0\n" + header +
                      point({1, 2, 3}, {65535, 0, 13107}, swapped) + point({4, 5, 6}, {0, 26214, 65535}, swapped)));
  }
}

TEST_F(CloudVariants, PackedColoursInPly) {
  expectColors(ply("uint", {"rgba"}, std::to_string(0xffff0033u), std::to_string(0xff0066ffu)));
}

std::string pcdOf(const std::string& fields, const std::string& sizes, const std::string& types,
                  const std::string& counts, const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z " + fields + "\nSIZE 4 4 4 " + sizes + "\nTYPE F F F " + types +
         "\nCOUNT 1 1 1 " + counts + "\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA " + data;
}

TEST_F(CloudVariants, ColoursInPcd) {
  for (const char* type : {"U 1", "U 2", "U 4", "I 4", "F 4", "F 8"}) {
    const std::string t(1, type[0]), s(1, type[2]);
    expectColors(read(pcdOf("r g b", s + " " + s + " " + s, t + " " + t + " " + t, "1 1 1",
                            "ascii\n1 2 3 255 0 51\n4 5 6 0 102 255\n")));
  }
  expectColors(read(pcdOf("rgb", "4", "F", "3", "ascii\n1 2 3 1 0 0.2\n4 5 6 0 0.4 1\n")));
  expectColors(read(pcdOf("rgb", "1", "U", "3", "ascii\n1 2 3 255 0 51\n4 5 6 0 102 255\n")));
  const std::string first = std::to_string(0xff0033), second = std::to_string(0x0066ff);
  for (const char* type : {"U", "I", "F"}) {  // whole numbers are packed colours, also in a field that says F
    expectColors(read(pcdOf("rgb", "4", type, "1", "ascii\n1 2 3 " + first + "\n4 5 6 " + second + "\n")));
  }
  float packed[2];
  const std::uint32_t colors[] = {0xff0033, 0x0066ff};
  std::memcpy(packed, colors, sizeof(packed));
  char text[128];
  std::snprintf(text, sizeof(text), "ascii\n1 2 3 %.9g\n4 5 6 %.9g\n", double(packed[0]), double(packed[1]));
  expectColors(read(pcdOf("rgb", "4", "F", "1", text)));
  expectColors(read(pcdOf("rgba", "4", "U", "1",
                          "binary\n" + bytesOf({1.f, 2.f, 3.f}) + bytesOf({0xffff0033u}) + bytesOf({4.f, 5.f, 6.f}) +
                              bytesOf({0xff0066ffu}))));
}

TEST_F(CloudVariants, EndsOfLines) {
  const std::string ascii =
      "ply\nformat ascii 1.0\ncomment x\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
      "1 2 3 255 0 51\n4 5 6 0 102 255\n";
  const std::string pcd = pcdOf("rgb", "4", "U", "1", "ascii\n1 2 3 16711731\n4 5 6 26367\n");
  for (const std::string& whole : {ascii, pcd}) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      std::string text;
      for (const char c : whole) text += c == '\n' ? end : std::string(1, c);
      expectColors(read(text));
      expectColors(read("\xef\xbb\xbf" + text));
    }
    std::string mixed;
    int line = 0;
    for (const char c : whole)
      mixed += c != '\n' ? std::string(1, c) : ++line % 3 == 0 ? "\r" : line % 3 == 1 ? "\r\n" : "\n";
    expectColors(read(mixed));
  }
}

TEST_F(CloudVariants, BinaryDataMayBeginLikeTheEndOfALine) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar a\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  const std::string data = "\n" + bytesOf({1.f, 2.f, 3.f});
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : header) text += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(read(text + data).points.at(0), Eigen::Vector3f(1, 2, 3));
  }
}

TEST_F(CloudVariants, WordsForNoNumber) {
  for (const char* word : {"nan", "1.#QNAN", "-1.#IND", "nan(ind)", "-nan", "1.#INF", "-inf", "Infinity"}) {
    const std::string points = std::string("1 2 3\n") + word + " 5 6\n";
    const Cloud pcd =
        read("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n" + points);
    const Cloud from_ply = read(
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n" +
        points);
    for (const Cloud& cloud : {pcd, from_ply}) {
      ASSERT_EQ(cloud.size(), 2u);
      EXPECT_TRUE(cloud.points[0].allFinite());
      EXPECT_FALSE(std::isfinite(cloud.points[1].x())) << word;
    }
  }
}

TEST_F(CloudVariants, LongNamesAreShortened) {
  const std::string huge(1000, 'x');
  const auto message = test::errorOf(ErrorCode::bad_file, [&] {
    read("VERSION .7\nFIELDS y z " + huge +
         "\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n");
  });
  EXPECT_LT(message.size(), 400u);
  EXPECT_THAT(message, HasSubstr("(1000 bytes)"));
}

}  // namespace
}  // namespace sks
