// SPDX-License-Identifier: BSD-3-Clause
// make_seeds FOLDER: writes small good inputs for each fuzz target to FOLDER/<target>, so that fuzzing starts behind
// the first checks. Everything is synthetic.
#include <filesystem>
#include <iostream>
#include <string>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/codebook_file.hpp>
#include <sks_detector/settings_file.hpp>

#include "core/surface/color_space.hpp"
#include "io/file.hpp"
#include "io/image_file.hpp"
#include "seed_texts.hpp"
#include "small_codebook.hpp"
#if __has_include(<sensor_msgs/PointCloud2.h>)
#include "point_cloud_message.hpp"
#include "ros/cloud_message.hpp"
#endif

namespace {

namespace fs = std::filesystem;

/// Files of one target's first corpus.
class Corpus {
public:
  Corpus(const std::string& folder, const std::string& target) : folder_(fs::path(folder) / target) {
    fs::create_directories(folder_);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void add(const std::string& name, const std::string& content) const { sks::writeFileAtomically(path(name), content); }

private:
  fs::path folder_;
};

void clouds(const std::string& folder) {
  const Corpus pcd(folder, "pcd"), ply(folder, "ply"), mesh(folder, "mesh");
  sks::Cloud cloud =
      sks::test::view({{sks::test::cupShape(), Eigen::Isometry3f(Eigen::Translation3f(0, 0, 1))}}, 0.1f, 8, 6, true);
  sks::writeCloud(pcd.path("colour"), cloud);
  cloud.colors.clear();
  sks::writeCloud(pcd.path("plain"), cloud);
  pcd.add("ascii", sks::fuzz::ascii_pcd);
  pcd.add("compressed", sks::fuzz::compressedPcd());
  ply.add("ascii", sks::fuzz::ascii_ply);
  ply.add("binary", sks::fuzz::binaryPly());
  mesh.add("ply", "\x01" + sks::fuzz::ascii_ply);
  mesh.add("obj", std::string(1, '\0') + sks::fuzz::obj);
  mesh.add("stl", "\x02" + sks::fuzz::stl);
}

void images(const std::string& folder) {
  const Corpus corpus(folder, "image");
  sks::ColorImage color(9, 5, {200, 100, 50});
  color(2, 3) = {0, 255, 0};
  corpus.add("color", sks::encodePng(color));
  corpus.add("depth", sks::encodePng(sks::DepthImage(9, 5, 1000)));
  corpus.add("jpeg", sks::encodeJpeg(color));
}

void codebooks(const std::string& folder) {
  const Corpus corpus(folder, "codebook"), use(folder, "codebook_use");
  sks::Codebook codebook = sks::fuzz::smallCodebook();
  sks::writeCodebook(corpus.path("whole"), codebook);
  codebook.words.resize(2);
  const sks::QuantizedDescriptors all = codebook.descriptors;
  codebook.descriptors = sks::QuantizedDescriptors(all.levels(0), all.scales(), 2, all.cols(),
                                                   std::make_shared<const sks::QuantizedDescriptors>(all));
  for (sks::TrainingView& view : codebook.views) {
    view.surface_points.resize(3);
    view.surface_normals.resize(3);
    view.surface_colors.assign(3, Eigen::Vector3f::Constant(0.5f));
    view.frame = "common";
  }
  sks::writeCodebook(corpus.path("two_words"), codebook);
  sks::writeCodebook(use.path("two_words"), codebook);
  const auto gray = sks::toScaledLab({128, 128, 128});
  for (sks::TrainingView& view : codebook.views)
    view.surface_colors.assign(3, Eigen::Vector3f(gray[0], gray[1], gray[2]));
  sks::writeCodebook(corpus.path("color_levels"), codebook);
}

void texts(const std::string& folder) {
  const Corpus settings(folder, "settings"), data_set(folder, "data_set"), requests(folder, "requests");
  settings.add("all", sks::settingsToYaml({}));
  settings.add("flow", "{keypoints: {discard: 0.5}, voting.bandwidth: 0.03, threads: 2}\n");
  data_set.add("training", sks::fuzz::training_set);
  data_set.add("scenes", sks::fuzz::scene_set);
  const char* const texts[] = {
      "sub/a.sks", "../secret", "in/../sub//b.sks", "mug", "mugg", "voting.bandwidth=0.02", "max_input_age=0.5"};
  int number = 0;
  for (const char* text : texts) {
    for (char which = 0; which < 6; ++which) requests.add(std::to_string(number++), which + std::string(text));
  }
  requests.add("training", "\x06" + sks::fuzz::training_set);
}

void messages([[maybe_unused]] const std::string& folder) {
#if __has_include(<sensor_msgs/PointCloud2.h>)
  const Corpus conversion(folder, "cloud_message"), frames(folder, "frame");
  sensor_msgs::PointCloud2 message = sks_detector::toMessage(sks::fuzz::smallView(), {});
  frames.add("view", sks::fuzz::inputOf(message));
  sks::Cloud cloud = sks::test::sphere(0.1f, 0.03f, {0, 0, 0.5f});
  frames.add("sphere", sks::fuzz::inputOf(sks_detector::toMessage(cloud, {})));
  cloud.points.resize(4);
  cloud.colors.resize(4);
  cloud.width = cloud.height = 2;
  message = sks_detector::toMessage(cloud, {});
  conversion.add("colour", sks::fuzz::inputOf(message));
  message.fields.back().name = "rgba";
  message.fields.back().datatype = sensor_msgs::PointField::UINT32;
  conversion.add("rgba", sks::fuzz::inputOf(message));
#endif
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: make_seeds FOLDER\n";
    return 2;
  }
  const std::string folder = arguments[1];
  images(folder);
  clouds(folder);
  codebooks(folder);
  texts(folder);
  messages(folder);
}
