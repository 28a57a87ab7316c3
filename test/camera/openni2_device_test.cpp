// SPDX-License-Identifier: BSD-3-Clause
// Through OpenNI2 itself, with the synthetic camera of the tests' own driver.
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/synthetic_view.hpp"
#include "error_of.hpp"
#include "points_of.hpp"
#include "ros/camera/openni2_device.hpp"

namespace sks_detector {
namespace {

using sks::test::pointsOf;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

CameraFrame readFrame(CameraDevice& device) {
  CameraFrame frame;
  device.start();
  for (int i = 0; i < 100; ++i) {
    if (device.read(frame, std::chrono::milliseconds(100)) == ReadResult::frame) return frame;
  }
  ADD_FAILURE() << "no frame";
  return frame;
}

CameraSettings settingsFor(const std::string& device, int width = 320, int height = 240) {
  CameraSettings settings;
  settings.device = device;
  settings.width = width;
  settings.height = height;
  return settings;
}

/// Number of pixels that differ from the synthetic view by more than rounding.
int countWrong(const CameraFrame& frame) {
  const sks::test::SyntheticView view{frame.depth.width, frame.depth.height};
  const auto points = pointsOf(frame);
  int wrong = 0;
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const OrganizedPoint& point = points[std::size_t(v * view.width + u)];
      const double z = 0.001 * view.depth(u, v);
      const auto color = view.color(u, v);
      const bool right_place = z == 0
                                   ? std::isnan(point.z)
                                   : std::abs(point.x - view.slopeX(u) * z) < 1e-4 &&
                                         std::abs(point.y - view.slopeY(v) * z) < 1e-4 && std::abs(point.z - z) < 1e-4;
      const bool right_color = point.rgb == std::uint32_t(color[0] << 16 | color[1] << 8 | color[2]);
      if (!right_place || !right_color) ++wrong;
    }
  }
  return wrong;
}

TEST(OpenNi2Device, GivesThePlacesAndColoursOfTheView) {
  OpenNi2Device device(settingsFor("sks-test://0", 640, 480));
  EXPECT_EQ(device.description().name, "SKS synthetic camera");
  EXPECT_EQ(device.description().serial, "SKS-0001");
  EXPECT_TRUE(device.description().registered);
  EXPECT_NEAR(device.description().intrinsics.fx, 525, 1e-3);
  EXPECT_THAT(device.description().remarks, IsEmpty());
  const CameraFrame frame = readFrame(device);
  ASSERT_EQ(frame.depth.width, 640);
  ASSERT_EQ(frame.color.width, 640);
  EXPECT_EQ(countWrong(frame), 0);
}

TEST(OpenNi2Device, TakesTheNearestModeAndSaysSo) {
  const OpenNi2Device device(settingsFor("", 600, 400));
  EXPECT_EQ(device.description().depth_mode.width, 640);
  EXPECT_THAT(device.description().remarks,
              ElementsAre("it has no mode of 600x400 at 30 Hz: the nearest, 640x480 at 30 Hz, is used (~width, "
                          "~height, ~rate)"));
}

TEST(OpenNi2Device, IsFoundByNumberAndBySerialNumber) {
  EXPECT_EQ(OpenNi2Device(settingsFor("#1")).description().uri, "sks-test://0");
  EXPECT_EQ(OpenNi2Device(settingsFor("SKS-0001")).description().uri, "sks-test://0");
}

TEST(OpenNi2Device, SaysWhichDevicesThereAre) {
  const auto open = [](const std::string& name) { OpenNi2Device device(settingsFor(name)); };
  EXPECT_THAT(sks::test::errorOf(sks::ErrorCode::bad_data, [&] { open("#2"); }),
              HasSubstr("no OpenNI2 camera '#2' (~device): connected: #1 sks-test://0"));
  EXPECT_THAT(sks::test::errorOf(sks::ErrorCode::bad_data, [&] { open("1d27/0601"); }),
              HasSubstr("'1d27/0601' (~device) cannot be opened"));
  EXPECT_THAT(sks::test::errorOf(sks::ErrorCode::bad_file, [&] { open("/nowhere/a.oni"); }),
              HasSubstr("/nowhere/a.oni (~device) cannot be read: No such file or directory"));
}

TEST(OpenNi2Device, IsNotRegisteredUnlessAskedTo) {
  CameraSettings settings = settingsFor("sks-test://0");
  settings.registration = false;
  OpenNi2Device device(settings);
  EXPECT_FALSE(device.description().registered);
  EXPECT_GT(countWrong(readFrame(device)), 1000);
}

TEST(OpenNi2Device, GivesDepthAloneWithoutColour) {
  CameraSettings settings = settingsFor("sks-test://0");
  settings.color = false;
  OpenNi2Device device(settings);
  const CameraFrame frame = readFrame(device);
  EXPECT_EQ(frame.depth.width, 320);
  EXPECT_TRUE(frame.color.pixels.empty());
}

TEST(OpenNi2Device, StopsAndStartsAgain) {
  OpenNi2Device device(settingsFor("sks-test://0"));
  readFrame(device);
  device.stop();
  CameraFrame frame;
  EXPECT_EQ(device.read(frame, std::chrono::milliseconds(100)), ReadResult::nothing_yet);
  EXPECT_EQ(countWrong(readFrame(device)), 0);
}

TEST(OpenNi2Device, DummyAssumesAFocalLength) {
  OpenNi2Device device(settingsFor("Dummy"));
  EXPECT_EQ(device.description().depth_mode.width, 320);
  EXPECT_THAT(device.description().remarks, ::testing::Contains(HasSubstr("focal length of 262.5 px is assumed")));
  const CameraFrame frame = readFrame(device);
  EXPECT_EQ(frame.depth.pixels[0], 2000);
  EXPECT_FALSE(frame.color.pixels.empty());
}

}  // namespace
}  // namespace sks_detector
