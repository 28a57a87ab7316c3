// SPDX-License-Identifier: BSD-3-Clause
// Messages as drivers and filters publish them.
#include "ros/cloud_message.hpp"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "made_up_bag.hpp"

namespace sks {
namespace {

using sks_detector::toCloud;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::string refusalOf(const sensor_msgs::PointCloud2& message) {
  return test::errorOf(ErrorCode::bad_data, [&] { toCloud(message); });
}

void expectWall(const sensor_msgs::PointCloud2& message) {
  const Cloud cloud = toCloud(message), wall = test::wall();
  EXPECT_EQ(cloud.width, 16u);
  EXPECT_EQ(cloud.height, 12u);
  ASSERT_EQ(cloud.size(), wall.size());
  for (std::size_t i = 4; i < wall.size(); ++i) EXPECT_EQ(cloud.points[i], wall.points[i]) << i;
  ASSERT_TRUE(cloud.hasColor());
  EXPECT_EQ(int(cloud.colors.back().g), 100);
}

/// The wall with rows that are longer than their points.
sensor_msgs::PointCloud2 paddedWall(std::size_t padding) {
  sensor_msgs::PointCloud2 message = test::wallMessage(0);
  const std::vector<std::uint8_t> data = message.data;
  const std::size_t row = message.row_step;
  message.data.clear();
  for (std::size_t i = 0; i < message.height; ++i) {
    message.data.insert(message.data.end(), data.begin() + std::ptrdiff_t(i * row),
                        data.begin() + std::ptrdiff_t((i + 1) * row));
    message.data.insert(message.data.end(), padding, 0xff);
  }
  message.row_step = std::uint32_t(row + padding);
  return message;
}

TEST(CloudMessage, PointsThatFillTheDataAreReadWhateverTheRowStep) {
  for (const std::uint32_t step : {0u, 1u, 16u, 16u * 16 * 12, 4294967295u}) {
    sensor_msgs::PointCloud2 message = test::wallMessage(0);
    message.row_step = step;
    SCOPED_TRACE(step);
    expectWall(message);
  }
}

TEST(CloudMessage, RowsMayBePadded) {
  for (const std::size_t padding : {1u, 16u, 100u}) {
    sensor_msgs::PointCloud2 message = paddedWall(padding);
    SCOPED_TRACE(padding);
    expectWall(message);
    message.data.resize(message.data.size() - padding);  // that of the last row is often left out
    expectWall(message);
  }
}

TEST(CloudMessage, RefusalsSayWhatDoesNotFit) {
  sensor_msgs::PointCloud2 message = test::wallMessage(0);
  message.data.pop_back();
  EXPECT_EQ(refusalOf(message),
            "it says 16 x 12 points of 16 bytes (3072 bytes in all) in rows of 256 bytes (3072 bytes), but holds 3071 "
            "bytes, which is neither");
  message = paddedWall(8);
  message.row_step -= 9;  // 255, shorter than its points
  message.data.resize(std::size_t(message.row_step) * message.height);
  EXPECT_THAT(refusalOf(message), HasSubstr("its rows are shorter than their points"));
  message = test::wallMessage(0);
  message.point_step = 0;
  EXPECT_THAT(refusalOf(message), HasSubstr("its point_step is 0"));
  message.width = message.height = message.row_step = message.point_step = 4294967295u;  // products that overflow
  EXPECT_THAT(refusalOf(message), HasSubstr("but holds 3072 bytes"));
}

TEST(CloudMessage, TextOfFieldsIsShortenedAndCleaned) {
  sensor_msgs::PointCloud2 message = test::wallMessage(0);
  message.fields[0].name = "a\n\x1b[31m" + std::string(20000000, 'x');
  const std::string refusal = refusalOf(message);
  EXPECT_LT(refusal.size(), 500u);
  EXPECT_THAT(refusal, HasSubstr("there is no field 'x'; its fields are a\\n\\x1b[31mxxx"));
  message.fields.assign(100000, message.fields[1]);
  EXPECT_LT(refusalOf(message).size(), 500u);
}

/// A point with colours in three fields of one type.
template <typename T>
sensor_msgs::PointCloud2 channelMessage(std::uint8_t type, const std::vector<std::string>& names,
                                        const std::vector<T>& rgb) {
  sensor_msgs::PointCloud2 message = sks_detector::toMessage(test::wall(false), test::header(0));
  message.width = message.height = 1;
  message.data.resize(12);
  for (std::size_t i = 0; i < 3; ++i) {
    sensor_msgs::PointField field;
    field.name = names[i];
    field.offset = std::uint32_t(12 + i * sizeof(T));
    field.datatype = type;
    field.count = i == 0 ? 0 : 1;  // 0 is written by some
    message.fields.push_back(field);
    message.data.resize(message.data.size() + sizeof(T));
    std::memcpy(&message.data[12 + i * sizeof(T)], &rgb[i], sizeof(T));
  }
  message.point_step = message.row_step = std::uint32_t(message.data.size());
  return message;
}

TEST(CloudMessage, ColoursOfAllNamesAndTypes) {
  using F = sensor_msgs::PointField;
  const auto color = [](const sensor_msgs::PointCloud2& message) {
    const Rgb c = toCloud(message).colors.at(0);
    return std::vector<int>{c.r, c.g, c.b};
  };
  for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{
           {"r", "g", "b"}, {"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}}) {
    EXPECT_THAT(color(channelMessage<std::uint8_t>(F::UINT8, names, {255, 102, 0})), ElementsAre(255, 102, 0));
    EXPECT_THAT(color(channelMessage<std::uint16_t>(F::UINT16, names, {65535, 26214, 0})), ElementsAre(255, 102, 0));
    EXPECT_THAT(color(channelMessage<std::uint16_t>(F::UINT16, names, {255, 102, 0})), ElementsAre(255, 102, 0));
    EXPECT_THAT(color(channelMessage<float>(F::FLOAT32, names, {1, 0.4f, 0})), ElementsAre(255, 102, 0));
    EXPECT_THAT(color(channelMessage<float>(F::FLOAT32, names, {255, 102, 0})), ElementsAre(255, 102, 0));
    EXPECT_THAT(color(channelMessage<double>(F::FLOAT64, names, {1, 0.4, 0})), ElementsAre(255, 102, 0));
    EXPECT_THAT(color(channelMessage<std::int32_t>(F::INT32, names, {255, 102, 0})), ElementsAre(255, 102, 0));
  }
  sensor_msgs::PointCloud2 packed = test::wallMessage(0);
  for (const char* name : {"rgb", "rgba"}) {
    for (const std::uint8_t type : {F::FLOAT32, F::UINT32, F::INT32}) {
      packed.fields[3].name = name;
      packed.fields[3].datatype = type;
      EXPECT_THAT(color(packed), ElementsAre(200, 100, 50));
    }
  }
}

TEST(CloudMessage, TheNodesLimitComesFirst) {
  EXPECT_THAT(test::errorOf(ErrorCode::bad_data, [] { sks_detector::receivedCloud(test::wallMessage(0), 100); }),
              HasSubstr("it has 192 points, more than ~max_points = 100"));
  EXPECT_EQ(sks_detector::receivedCloud(test::wallMessage(0), 192).size(), 192u);
}

}  // namespace
}  // namespace sks
