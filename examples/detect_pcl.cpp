// SPDX-License-Identifier: BSD-3-Clause
// Finds the objects of a codebook in a PCD file that PCL reads, and prints name, score and pose of each.
// Build: cmake -S examples -B build/examples && cmake --build build/examples; run: detect_pcl toys.sks scene.pcd
#include <cstdlib>
#include <iostream>
#include <string>

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/pcl.hpp>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: detect_pcl CODEBOOK CLOUD\n";
    return 2;
  }
  try {
    pcl::PointCloud<pcl::PointXYZRGB> cloud;
    if (pcl::io::loadPCDFile(argv[2], cloud) != 0) {
      throw sks::Error(sks::ErrorCode::bad_file, std::string("cannot read cloud '") + argv[2] + "'");
    }
    const sks::Detector detector(sks::readCodebook(argv[1]));  // settings from the codebook
    for (const sks::Detection& d : detector.detect(sks::fromPcl(cloud)).above(0.5)) {
      std::cout << d.object << " " << d.score << "\n" << d.T_scene_model.matrix() << "\n";
    }
  } catch (const sks::Error& error) {
    std::cerr << "detect_pcl: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
