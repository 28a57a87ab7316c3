// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/cloud_io.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "error_of.hpp"
#include "temporary_folder.hpp"

namespace {

using sks::test::TemporaryFolder;
using sks::test::writeFile;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

class CloudIo : public ::testing::Test {
protected:
  sks::Cloud read(const std::string& content, double scale = 1.0) {
    writeFile(path_, content);
    return sks::readCloud(path_, scale);
  }

  /// The reason of the error that reading `content` gives.
  std::string readError(const std::string& content) {
    const std::string message = sks::test::errorOf(sks::ErrorCode::bad_file, [&] { read(content); });
    const std::string start = "cannot read cloud '" + path_ + "': ";
    EXPECT_EQ(message.rfind(start, 0), 0u) << message;
    return message.substr(std::min(start.size(), message.size()));
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.path("cloud");
};

std::string pcdHeader(const std::string& fields, const std::string& sizes, const std::string& types, int width,
                      int height, const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " +
         types + "\nWIDTH " + std::to_string(width) + "\nHEIGHT " + std::to_string(height) +
         "\nVIEWPOINT 0.5 0 -1 1 0 0 0\nPOINTS " + std::to_string(width * height) + "\nDATA " + data + "\n";
}

std::string asciiPcd(int width, int height, const std::string& points) {
  return pcdHeader("x y z", "4 4 4", "F F F", width, height, "ascii") + points;
}

template <typename... Values>
std::string bytes(Values... values) {
  std::string result;
  const auto append = [&](auto value) { result.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  (append(values), ...);
  return result;
}

sks::Cloud randomCloud(std::uint32_t width, std::uint32_t height, bool color) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-1, 1);
  sks::Cloud cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.sensor_origin = {0.1f, -0.2f, 0.3f};
  for (std::uint32_t i = 0; i < width * height; ++i) {
    cloud.points.emplace_back(place(random), place(random), place(random));
    if (color) cloud.colors.push_back({std::uint8_t(random()), std::uint8_t(random()), std::uint8_t(random())});
  }
  return cloud;
}

}  // namespace

TEST_F(CloudIo, AsciiPcd) {
  const sks::Cloud cloud = read(asciiPcd(2, 1, "1 2 3\n-0.5 nan 1e-3\n"));
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_FALSE(cloud.organized());
  EXPECT_FALSE(cloud.hasColor());
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.points[1].x(), -0.5f);
  EXPECT_TRUE(std::isnan(cloud.points[1].y()));
  EXPECT_EQ(cloud.points[1].z(), 0.001f);
  EXPECT_EQ(cloud.sensor_origin, Eigen::Vector3f(0.5f, 0, -1));
}

TEST_F(CloudIo, ScaleTurnsMillimetresIntoMetres) {
  const sks::Cloud cloud = read(asciiPcd(1, 1, "1000 -500 1234\n"), 0.001);
  EXPECT_TRUE(cloud.points[0].isApprox(Eigen::Vector3f(1, -0.5f, 1.234f)));
  EXPECT_TRUE(cloud.sensor_origin.isApprox(Eigen::Vector3f(0.0005f, 0, -0.001f)));
}

TEST_F(CloudIo, BinaryPcdWithDoublesInAnyOrder) {
  const std::string header = pcdHeader("label z y x", "4 8 8 8", "U F F F", 2, 1, "binary");
  const sks::Cloud cloud = read(header + bytes(std::uint32_t(7), 3.0, 2.0, 1.0, std::uint32_t(8), 6.0, 5.0, 4.0));
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
}

TEST_F(CloudIo, CompressedPcd) {
  const std::string header = pcdHeader("x y z", "4 4 4", "F F F", 2, 1, "binary_compressed");
  const std::string fields = bytes(1.0f, 4.0f, 2.0f, 5.0f, 3.0f, 6.0f);  // x x y y z z
  const std::string packed = bytes(std::uint8_t(23)) + fields;           // one run of 24 bytes as they are
  const std::string whole = header + bytes(std::uint32_t(packed.size()), std::uint32_t(24)) + packed;
  const sks::Cloud cloud = read(whole);
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  for (std::size_t length = header.size(); length < whole.size(); ++length) readError(whole.substr(0, length));
  std::string damaged = whole;
  damaged[header.size() + 8] = 30;  // a run beyond the end
  EXPECT_EQ(readError(damaged), "its compressed data is damaged");
  EXPECT_EQ(readError(header + bytes(std::uint32_t(packed.size()), std::uint32_t(2400)) + packed),
            "its compressed data says 2400 bytes, its header 24");
}

TEST_F(CloudIo, AsciiColourAndIntegers) {
  const std::string header = pcdHeader("label x y z rgb", "1 4 4 4 4", "I F F F U", 1, 1, "ascii");
  const sks::Cloud cloud = read(header + "-3 1 2 3 660510\n");
  ASSERT_TRUE(cloud.hasColor());
  EXPECT_EQ(int(cloud.colors[0].r), 10);
  EXPECT_EQ(int(cloud.colors[0].g), 20);
  EXPECT_EQ(int(cloud.colors[0].b), 30);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(readError(header + "-3 1 2 3,5 660510\n"), "point 0 holds '3,5', no number");
}

TEST_F(CloudIo, PackedColour) {
  for (const std::string& field : {std::string("rgb"), std::string("rgba")}) {
    const std::string header = pcdHeader("x y z " + field, "4 4 4 4", "F F F U", 1, 1, "binary");
    const sks::Cloud cloud = read(header + bytes(1.0f, 2.0f, 3.0f, std::uint32_t(0xff0a141e)));
    ASSERT_TRUE(cloud.hasColor());
    EXPECT_EQ(int(cloud.colors[0].r), 10);
    EXPECT_EQ(int(cloud.colors[0].g), 20);
    EXPECT_EQ(int(cloud.colors[0].b), 30);
  }
}

TEST_F(CloudIo, RoundTripKeepsEverything) {
  for (const bool color : {false, true}) {
    sks::Cloud cloud = randomCloud(7, 5, color);
    cloud.points[3] = {nan_value, nan_value, nan_value};
    sks::writeCloud(path_, cloud);
    const sks::Cloud back = sks::readCloud(path_);
    EXPECT_EQ(back.width, 7u);
    EXPECT_EQ(back.height, 5u);
    EXPECT_EQ(back.sensor_origin, cloud.sensor_origin);
    ASSERT_EQ(back.size(), cloud.size());
    ASSERT_EQ(back.colors.size(), cloud.colors.size());
    EXPECT_EQ(std::memcmp(back.points.data(), cloud.points.data(), cloud.size() * sizeof(Eigen::Vector3f)), 0);
    for (std::size_t i = 0; i < cloud.colors.size(); ++i) {
      EXPECT_EQ(std::memcmp(&back.colors[i], &cloud.colors[i], sizeof(sks::Rgb)), 0) << i;
    }
  }
  EXPECT_EQ(folder_.fileCount(), 1u);
}

TEST_F(CloudIo, EmptyCloud) {
  EXPECT_EQ(read(asciiPcd(0, 1, "")).size(), 0u);
  sks::writeCloud(path_, sks::Cloud());
  EXPECT_EQ(sks::readCloud(path_).size(), 0u);
}

TEST_F(CloudIo, AsciiPlyWithDoublesColourAndFaces) {
  const sks::Cloud cloud = read(
      "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n1 2 3 10 20 30\n4 5 6 40 50 60\n7 8 9 70 80 90\n3 0 1 2\n");
  ASSERT_EQ(cloud.size(), 3u);
  EXPECT_EQ(cloud.points[2], Eigen::Vector3f(7, 8, 9));
  ASSERT_TRUE(cloud.hasColor());
  EXPECT_EQ(int(cloud.colors[1].r), 40);
  EXPECT_EQ(int(cloud.colors[1].g), 50);
  EXPECT_EQ(int(cloud.colors[1].b), 60);
}

TEST_F(CloudIo, BinaryPly) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty double quality\nend_header\n";
  const sks::Cloud cloud = read(header + bytes(1.0f, 2.0f, 3.0f, 0.0f, 0.5, 4.0f, 5.0f, 6.0f, 0.0f, 0.5));
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_FALSE(cloud.hasColor());
  EXPECT_EQ(cloud.sensor_origin, Eigen::Vector3f::Zero());
}

TEST_F(CloudIo, BinaryPlyWithDoubles) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
      "property double z\nend_header\n";
  const sks::Cloud cloud = read(header + bytes(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
}

TEST_F(CloudIo, PlyListsAndOtherElementsArePassedOver) {
  const sks::Cloud cloud = read(
      "ply\nformat ascii 1.0\nobj_info by hand\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element vertex 2\nproperty float z\nproperty list uchar float links\nproperty float y\nproperty float x\n"
      "element camera 1\nproperty float view_px\nproperty float view_py\nproperty float view_pz\nend_header\n"
      "2 0 1\n3 0 2 1\n6 2 0.5 0.5 5 4\n7 8 9\n");
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(cloud.sensor_origin, Eigen::Vector3f(7, 8, 9));
}

TEST_F(CloudIo, BigEndianPly) {
  std::string body;
  for (const float value : {1.0f, 2.0f, 3.0f}) {
    const std::string little = bytes(value);
    body.append(little.rbegin(), little.rend());
  }
  const sks::Cloud cloud = read(
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n" +
      body);
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
}

TEST_F(CloudIo, PlyHeadersThatCannotBeUsed) {
  const auto error = [&](const std::string& properties) {
    return readError("ply\nformat ascii 1.0\nelement vertex 1\n" + properties + "end_header\n1 2 3 4 5 6\n");
  };
  EXPECT_EQ(error("property float x\nproperty float y\n"), "its vertices have no property 'z'");
  EXPECT_EQ(error("property int x\nproperty float y\nproperty float z\n"),
            "property 'x' of its vertices holds integers; coordinates must be float or double");
  EXPECT_EQ(error("property half x\n"), "its PLY header has a property of the unknown type 'half'");
  EXPECT_EQ(error("property float\n"), "its PLY header has a property without a type or name");
  const std::string position = "property float x\nproperty float y\nproperty float z\n";
  for (const char* word : {"nan", "inf", "-inf"}) {
    EXPECT_EQ(readError("ply\nformat ascii 1.0\nelement vertex 1\n" + position +
                        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n1 2 3 4 5 " + word +
                        "\n"),
              std::string("it holds '") + word + "' for a whole number");
  }
  EXPECT_EQ(readError("ply\nformat ascii 1.0\nelement face 0\nend_header\n"), "its PLY header has no element vertex");
  EXPECT_EQ(readError("ply\nelement vertex 1\n" + position + "end_header\n1 2 3\n"),
            "its PLY header has no line format");
  EXPECT_EQ(readError("ply\nformat text 1.0\nend_header\n"), "its PLY header has the unknown format 'text'");
}

TEST_F(CloudIo, MissingFilesAndFolders) {
  EXPECT_EQ(sks::test::errorOf(sks::ErrorCode::bad_file, [&] { sks::readCloud(folder_.path("none.pcd")); }),
            "cannot read cloud '" + folder_.path("none.pcd") + "': No such file or directory");
  EXPECT_EQ(sks::test::errorOf(sks::ErrorCode::bad_file, [&] { sks::readCloud(folder_.path()); }),
            "cannot read cloud '" + folder_.path() + "': it is a folder; give the name of a PCD or PLY file");
}

TEST_F(CloudIo, ForeignContent) {
  EXPECT_EQ(readError(""), "it is empty");
  EXPECT_EQ(readError("hello world\n"), "it is neither a PCD nor a PLY file");
  EXPECT_EQ(readError(std::string(100000, '\0')), "it is neither a PCD nor a PLY file");
  EXPECT_EQ(readError("# a shell script\necho\n"), "its PCD header has no line DATA");
}

TEST_F(CloudIo, FieldsThatCannotBeUsed) {
  EXPECT_EQ(readError(pcdHeader("x y", "4 4", "F F", 1, 1, "ascii") + "1 2\n"),
            "there is no field 'z'; its fields are x, y");
  EXPECT_EQ(readError(pcdHeader("x y z", "4 4 4", "F I F", 1, 1, "ascii") + "1 2 3\n"),
            "field 'y' holds integers; coordinates must be float or double");
  EXPECT_EQ(readError(pcdHeader("x y z rgb", "4 4 4 1", "F F F U", 1, 1, "ascii") + "1 2 3 4\n"),
            "field 'rgb' must pack a colour into four bytes (float or uint32)");
  EXPECT_EQ(readError(pcdHeader("x y z", "4 4 3", "F F F", 1, 1, "ascii") + "1 2 3\n"),
            "its PCD header says TYPE F of SIZE 3 for field 'z'");
  EXPECT_EQ(readError(pcdHeader("x y z", "4 4", "F F F", 1, 1, "ascii") + "1 2 3\n"),
            "its PCD header has lines FIELDS, SIZE, TYPE and COUNT of different lengths");
}

TEST_F(CloudIo, LengthsOnAFilesWordAreNotBelieved) {
  std::string huge = pcdHeader("x y z", "4 4 4", "F F F", 1, 1, "binary") + bytes(1.0f, 2.0f, 3.0f);
  huge.replace(huge.find("WIDTH 1"), 7, "WIDTH 300000000");
  huge.replace(huge.find("POINTS 1"), 8, "POINTS 300000000");
  EXPECT_EQ(readError(huge),
            "it is truncated or its header is wrong: 300000000 points need 3600000000 bytes, but 12 are there");
  huge.replace(huge.find("POINTS 300000000"), 16, "POINTS 5");
  EXPECT_EQ(readError(huge), "its PCD header says WIDTH 300000000, HEIGHT 1 and POINTS 5, which do not fit");
  EXPECT_EQ(readError("ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
                      "property float z\nend_header\n1 2 3\n"),
            "2000000000 points are more than can be read (4 GiB)");
}

TEST_F(CloudIo, RowsOfNothingTakeNoTime) {
  std::string empty = pcdHeader("x y z", "4 4 4", "F F F", 0, 1, "binary");
  empty.replace(empty.find("HEIGHT 1"), 8, "HEIGHT 4294967295");
  EXPECT_EQ(read(empty).size(), 0u);  // a loop over the rows would take half a minute
}

TEST_F(CloudIo, EveryTruncationOfABinaryPcdIsRefused) {
  const std::string whole = pcdHeader("x y z", "4 4 4", "F F F", 2, 1, "binary") + bytes(1.f, 2.f, 3.f, 4.f, 5.f, 6.f);
  ASSERT_EQ(read(whole).size(), 2u);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    writeFile(path_, whole.substr(0, length));
    EXPECT_THROW(sks::readCloud(path_), sks::Error) << length << " bytes";
  }
}

TEST_F(CloudIo, TruncatedAsciiIsRefused) {
  EXPECT_EQ(readError(asciiPcd(4, 1, "1.0 2 3\n1 2 3\n1 2 3.125\n")), "it is truncated: 3 of its points are there");
  EXPECT_FALSE(readError("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                         "property float z\nend_header\n1.0 2.0 3.0\n4.0 5.0 6.0\n")
                   .empty());
}

TEST_F(CloudIo, TruncatedBinaryPlyIsRefused) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n";
  const std::string message = readError(header + bytes(1.0f, 2.0f, 3.0f, 4.0f, 5.0f));
  EXPECT_EQ(message, "it is truncated or its header is wrong: 2 points need 24 bytes, but 20 are there");
}

/// Whatever a bit flip does to a cloud, reading it ends with a cloud or an Error.
TEST_F(CloudIo, ACloudOfNothingButPointsIsWritten) {
  sks::Cloud cloud;
  cloud.points = randomCloud(6, 1, false).points;
  sks::writeCloud(path_, cloud);
  const sks::Cloud back = sks::readCloud(path_);
  EXPECT_EQ(back.width, 6u);
  EXPECT_EQ(back.height, 1u);
  EXPECT_EQ(back.points, cloud.points);
}

TEST_F(CloudIo, DamagedFilesDoNotCrash) {
  const std::string files[] = {
      pcdHeader("x y z rgb", "4 4 4 4", "F F F U", 2, 2, "binary") + std::string(64, 'a'),
      asciiPcd(2, 1, "1 2 3\n4 5 6\n"),
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
          std::string(32, 'a') + bytes(std::uint8_t(1), 0),
  };
  for (const std::string& whole : files) {
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      std::string damaged = whole;
      damaged[bit / 8] = char(damaged[bit / 8] ^ (1 << (bit % 8)));
      writeFile(path_, damaged);
      try {
        const sks::Cloud cloud = sks::readCloud(path_);
        EXPECT_EQ(cloud.size(), std::size_t(cloud.width) * cloud.height);
      } catch (const sks::Error& error) {
        EXPECT_EQ(error.code(), sks::ErrorCode::bad_file);
      }
    }
  }
}
