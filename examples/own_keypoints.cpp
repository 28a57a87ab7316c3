// SPDX-License-Identifier: BSD-3-Clause
// Trains and detects with keypoints of one's own: every n-th point of the surface in place of the grid.
// Build: cmake -S examples -B build/examples && cmake --build build/examples; run: own_keypoints view.pcd scene.pcd
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/trainer.hpp>

namespace {

class EveryNthPoint : public sks::KeypointStage {
public:
  explicit EveryNthPoint(std::size_t n) : n_(n) {}

  sks::Keypoints detect(const sks::Surface& surface, const sks::Settings& /*settings*/) const override {
    sks::Keypoints keypoints;
    for (std::size_t i = 0; i < surface.size(); i += n_) keypoints.positions.push_back(surface.point(i));
    return keypoints;
  }

private:
  std::size_t n_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: own_keypoints TRAINING_VIEW SCENE\n";
    return 2;
  }
  const std::string view = argv[1], scene = argv[2];
  try {
    sks::Stages stages;
    stages.keypoints = std::make_shared<EveryNthPoint>(20);

    sks::TrainingSample sample;
    sample.object = "object";
    sample.source = view;
    sample.load = [&] { return sks::readCloud(view); };
    const sks::Detector detector(sks::train({sample}, {}, "own keypoints", {}, stages), {}, stages);
    for (const sks::Detection& found : detector.detect(sks::readCloud(scene)).above(0.5)) {
      std::cout << found.object << ", score " << found.score << ", at " << found.position().transpose() << " m\n";
    }
  } catch (const sks::Error& error) {
    std::cerr << "own_keypoints: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
