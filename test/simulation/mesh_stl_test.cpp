// SPDX-License-Identifier: BSD-3-Clause
#include <cctype>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/box_files.hpp"
#include "simulation/mesh_file.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class StlMesh : public test::MeshFileTest {};

std::string textStl(const std::string& indent = "  ") {
  std::string text = "solid box\n";
  const auto corners = test::boxCorners();
  for (const auto& triangle : test::boxTriangles()) {
    text += indent + "facet normal 0 0 0\n" + indent + indent + "outer loop\n";
    for (const int corner : triangle) {
      text += indent + indent + indent + "vertex";
      for (int axis = 0; axis < 3; ++axis) text += " " + std::to_string(corners[std::size_t(corner)][axis]);
      text += "\n";
    }
    text += indent + indent + "endloop\n" + indent + "endfacet\n";
  }
  return text + "endsolid box\n";
}

/// @param color of the two bytes behind each triangle
std::string binaryStl(std::string head, std::uint16_t color) {
  head.resize(80, ' ');
  const auto append = [&](auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    head.append(raw, sizeof(value));
  };
  append(std::uint32_t(12));
  const auto corners = test::boxCorners();
  for (const auto& triangle : test::boxTriangles()) {
    for (int i = 0; i < 3; ++i) append(0.0f);
    for (const int corner : triangle) {
      for (int axis = 0; axis < 3; ++axis) append(corners[std::size_t(corner)][axis]);
    }
    append(color);
  }
  return head;
}

TEST_F(StlMesh, TextIsReadHoweverItIsWritten) {
  std::string upper = textStl();
  for (char& c : upper) c = char(std::toupper(static_cast<unsigned char>(c)));
  std::string returns = textStl(), both;
  for (const char c : returns) both += c == '\n' ? "\r\n" : std::string(1, c);
  std::replace(returns.begin(), returns.end(), '\n', '\r');
  std::string named = textStl("");
  named.replace(0, 9, "solid vertex facet 1 2");
  for (const std::string& text : {textStl(), upper, returns, both, textStl("\t"), textStl(""), " \n\n" + textStl(),
                                  "\xef\xbb\xbf" + textStl(), named}) {
    SCOPED_TRACE(text.substr(0, 60));
    const LoadedMesh loaded = loadMesh(write("a.stl", text));
    test::expectPlainBox(loaded.mesh);
    EXPECT_EQ(loaded.mesh.vertices.size(), 8u);
    EXPECT_THAT(loaded.warnings, IsEmpty());
  }
}

TEST_F(StlMesh, SeveralSolidsAreOneMesh) {
  const std::string text = textStl();
  const std::size_t half = text.find("  facet", text.size() / 2);
  test::expectPlainBox(
      loadMesh(write("a.stl", text.substr(0, half) + "endsolid\nsolid two\n" + text.substr(half))).mesh);
}

TEST_F(StlMesh, BinaryIsReadWhateverItsHeaderSays) {
  for (const char* head : {"", "solid box", "COLOR=\xff\x80\x40\xff", "solid facet vertex"}) {
    const LoadedMesh loaded = loadMesh(write("a.stl", binaryStl(head, 0xffff)));
    test::expectPlainBox(loaded.mesh);
    EXPECT_THAT(loaded.warnings, IsEmpty());
  }
  test::expectPlainBox(loadMesh(write("b.STL", binaryStl("solid", 0) + "\n")).mesh);  // bytes too many
}

TEST_F(StlMesh, WhatIsCutOffIsRefused) {
  const std::string binary = binaryStl("", 0), text = textStl();
  EXPECT_THAT(refusal(write("a.stl", binary.substr(0, binary.size() - 60))),
              HasSubstr("it is cut off: it says 12 triangles, but holds 10"));
  EXPECT_THAT(refusal(write("b.stl", binary.substr(0, 40))), HasSubstr("neither a text nor a binary STL file"));
  EXPECT_THAT(refusal(write("c.stl", "")), HasSubstr("neither a text nor a binary STL file"));
  EXPECT_THAT(refusal(write("d.stl", text.substr(0, text.rfind("vertex") + 12))), HasSubstr("it is cut off within"));
  const LoadedMesh loaded = loadMesh(write("e.stl", text.substr(0, text.find("endsolid"))));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("does not end with 'endsolid'"));
}

}  // namespace
}  // namespace sks
