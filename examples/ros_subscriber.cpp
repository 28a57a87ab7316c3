// SPDX-License-Identifier: BSD-3-Clause
// Prints name, score and position of what the detector node finds on /detector/detections.
// Build: cmake -S examples -B build/examples && cmake --build build/examples; run: build/examples/ros_subscriber
#include <cstdio>

#include <ros/ros.h>
#include <sks_detector/DetectionArray.h>

namespace {

void print(const sks_detector::DetectionArray& found) {
  for (const sks_detector::Detection& detection : found.detections) {
    const geometry_msgs::Point& p = detection.box_center.position;
    std::printf("%s, score %.2f, at %.3f %.3f %.3f m in %s\n", detection.object.c_str(), double(detection.score), p.x,
                p.y, p.z, found.header.frame_id.c_str());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "subscriber");
  ros::NodeHandle node;
  const ros::Subscriber subscriber = node.subscribe("/detector/detections", 10, print);
  ros::spin();
}
