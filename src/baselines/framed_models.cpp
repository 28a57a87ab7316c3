// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/framed_models.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace sks::baselines {

void FramedKeypoints::add(const Eigen::Vector3f& position, const Eigen::Matrix3f& frame) {
  positions->push_back(pcl::PointXYZ(position.x(), position.y(), position.z()));
  pcl::ReferenceFrame axes;
  for (int i = 0; i < 3; ++i) {
    axes.x_axis[i] = frame(0, i);
    axes.y_axis[i] = frame(1, i);
    axes.z_axis[i] = frame(2, i);
  }
  frames->push_back(axes);
}

FramedModels::FramedModels(const Codebook& codebook) {
  std::map<std::pair<std::uint32_t, std::string_view>, std::uint32_t> shared;
  for (const TrainingView& view : codebook.views) {
    std::uint32_t model = std::uint32_t(count_);
    if (!view.frame.empty()) model = shared.emplace(std::make_pair(view.object, view.frame), model).first->second;
    model_of_view_.push_back(model);
    count_ = std::max(count_, std::size_t(model) + 1);
  }
}

std::vector<FramedModel> FramedModels::matched(const Codebook& codebook, const std::vector<Match>& matches) const {
  std::vector<FramedModel> models(count_);
  for (const Match& match : matches) {
    const Codeword& word = codebook.words[match.word];
    FramedModel& model = models[model_of_view_[word.view]];
    model.object = codebook.views[word.view].object;
    model.correspondences->push_back(
        pcl::Correspondence(int(model.words.size()), int(match.descriptor), match.distance));
    model.words.push_back(match.word);
    model.keypoints.add(word.position, word.frame);
  }
  const auto few = [](const FramedModel& model) { return model.words.size() < 3; };
  models.erase(std::remove_if(models.begin(), models.end(), few), models.end());
  return models;
}

FramedKeypoints describedKeypoints(const SceneDescription& scene) {
  FramedKeypoints keypoints;
  for (std::size_t row = 0; row < scene.descriptors.keypoints.size(); ++row) {
    keypoints.add(scene.keypoints.positions[scene.descriptors.keypoints[row]], scene.descriptors.frames[row]);
  }
  return keypoints;
}

}  // namespace sks::baselines
