// SPDX-License-Identifier: BSD-3-Clause
// Clouds as they come over the network, through conversion and the gate.
#include "cloud_file.hpp"
#include "point_cloud_message.hpp"
#include "ros/cloud_message.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const sensor_msgs::PointCloud2 message = sks::fuzz::messageOf(data, size);
  sks::fuzz::refused([&] {
    const sks::Cloud cloud = sks_detector::toCloud(message);
    sks::fuzz::requireSound(cloud);
    sks::fuzz::requireSound(sks::sanitize(cloud, {}));
  });
  return 0;
}
