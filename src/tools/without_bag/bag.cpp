// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag.hpp"

#include <sks_detector/error.hpp>

namespace sks::tools {
namespace {

[[noreturn]] void refuse() {
  throw Error(ErrorCode::bad_usage,
              "this program was built without ROS, which bags need: run scripts/install_dependencies and build it in a "
              "catkin workspace (scripts/build)");
}

}  // namespace

void addBag(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bag", "not in this build: needs ROS");
  command->allow_extras();
  command->callback([] { refuse(); });
}

struct BagRecorder::Impl {};

BagRecorder::BagRecorder(const std::string&, const CameraModel&, double) {
  refuse();
}

BagRecorder::~BagRecorder() = default;

void BagRecorder::add(const Cloud&, const Eigen::Isometry3d&, const std::vector<Detection>&) {}

void BagRecorder::finish() {}

}  // namespace sks::tools
