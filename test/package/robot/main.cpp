// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include <robot/Grasp.h>
#include <sks_detector/settings.hpp>

int main() {
  robot::Grasp grasp;
  grasp.target.object = "mug";
  std::cout << grasp.target.object << ", " << sks::settingInfos().size() << " settings\n";
}
