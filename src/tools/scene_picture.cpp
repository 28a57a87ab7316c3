// SPDX-License-Identifier: BSD-3-Clause
#include "tools/scene_picture.hpp"

#include <vector>

#include "drawing/picture.hpp"

namespace sks::tools {
namespace {

constexpr Rgb right{60, 220, 60}, wrong{255, 60, 60}, neither{170, 170, 170}, missed{255, 170, 0};

Rgb colorOf(Outcome outcome) {
  return outcome == Outcome::true_positive ? right : (outcome == Outcome::false_positive ? wrong : neither);
}

}  // namespace

void saveScenePicture(const std::string& path, const Cloud& cloud, const SceneResult& result,
                      const Evaluation& evaluation) {
  Picture picture(cloud);
  std::vector<bool> found(result.scene.objects.size(), false);
  for (auto matched = result.detections.rbegin(); matched != result.detections.rend(); ++matched) {  // the best on top
    if (!counts(evaluation, matched->detection)) continue;
    if (matched->ground_truth) found[*matched->ground_truth] = true;
    picture.drawDetection(matched->detection, colorOf(matched->outcome));
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const GroundTruth& truth = result.scene.objects[i];
    const bool ignored = isIgnored(result.scene, truth.object);
    picture.drawCross(truth.position, ignored ? neither : (found[i] ? right : missed));
    if (found[i] || ignored) continue;
    Eigen::Isometry3d T_scene_truth = Eigen::Isometry3d::Identity();
    T_scene_truth.translation() = truth.position;
    const Eigen::Vector3d clear_of_cross = Eigen::Vector3d::Constant(0.02);  // [m]
    picture.drawLabel(T_scene_truth, clear_of_cross, truth.object + " missed", missed);
  }
  picture.save(path);
}

}  // namespace sks::tools
