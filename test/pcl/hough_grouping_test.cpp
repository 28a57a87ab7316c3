// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/hough_grouping.hpp"

#include <random>
#include <utility>

#include <gtest/gtest.h>
#include <pcl/recognition/cg/hough_3d.h>

#include "synthetic.hpp"

namespace sks::baselines {
namespace {

using Pairs = std::vector<std::vector<std::pair<int, int>>>;

Pairs pairsIn(const std::vector<pcl::Correspondences>& clusters) {
  Pairs pairs;
  for (const pcl::Correspondences& cluster : clusters) {
    pairs.emplace_back();
    for (const pcl::Correspondence& pair : cluster) pairs.back().emplace_back(pair.index_query, pair.index_match);
  }
  return pairs;
}

std::vector<pcl::Correspondences> clustersOfPcl(const FramedModel& model, const FramedKeypoints& scene,
                                                const HoughParameters& parameters) {
  pcl::Hough3DGrouping<pcl::PointXYZ, pcl::PointXYZ, pcl::ReferenceFrame, pcl::ReferenceFrame> hough;
  hough.setHoughBinSize(parameters.bin_size);
  hough.setHoughThreshold(parameters.threshold);
  hough.setUseInterpolation(parameters.interpolate);
  hough.setUseDistanceWeight(parameters.weigh);
  hough.setInputCloud(model.keypoints.positions);
  hough.setInputRf(model.keypoints.frames);
  hough.setSceneCloud(scene.positions);
  hough.setSceneRf(scene.frames);
  hough.setModelSceneCorrespondences(model.correspondences);
  std::vector<Eigen::Matrix4f, Eigen::aligned_allocator<Eigen::Matrix4f>> transforms;
  std::vector<pcl::Correspondences> clusters;
  hough.recognize(transforms, clusters);
  return clusters;
}

/// A model that stands twice in a scene, among as many wrong correspondences.
struct Example {
  FramedModel model;
  FramedKeypoints scene;

  explicit Example(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto vector = [&] { return Eigen::Vector3f(uniform(random), uniform(random), uniform(random)); };
    const auto rotation = [&] { return Eigen::Quaternionf(uniform(random), uniform(random), uniform(random), 1); };
    const auto add = [&](const Eigen::Vector3f& p, const Eigen::Matrix3f& frame, const Eigen::Vector3f& q,
                         const Eigen::Matrix3f& scene_frame) {
      const int i = int(scene.positions->size());
      model.keypoints.add(p, frame);
      scene.add(q, scene_frame);
      model.correspondences->push_back(pcl::Correspondence(i, i, 0.5f + 0.5f * uniform(random)));
    };
    for (int instance = 0; instance < 2; ++instance) {
      const Eigen::Isometry3f T = test::poseOf(70.0f * float(instance), vector(), 0.3f * vector());
      for (int i = 0; i < 40; ++i) {
        const Eigen::Vector3f p = 0.1f * vector();
        const Eigen::Matrix3f frame = rotation().normalized().toRotationMatrix();  // axes are rows
        const Eigen::Vector3f noise = 0.002f * vector();
        add(p, frame, T * p + noise, frame * T.linear().transpose());
      }
    }
    for (int i = 0; i < 80; ++i) {
      add(0.1f * vector(), rotation().normalized().toRotationMatrix(), 0.4f * vector(),
          rotation().normalized().toRotationMatrix());
    }
  }
};

TEST(HoughGrouping, FindsTheClustersOfPcl) {
  std::size_t found = 0;
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Example example(seed);
    for (const double threshold : {3.0, 8.0, -0.5, -1.0}) {
      for (const bool interpolate : {false, true}) {
        for (const bool weigh : {false, true}) {
          const HoughParameters parameters{0.03, threshold, interpolate, weigh};
          const Pairs ours = pairsIn(houghClusters(example.model, example.scene, parameters));
          found += ours.size();
          EXPECT_EQ(ours, pairsIn(clustersOfPcl(example.model, example.scene, parameters)))
              << seed << " " << threshold << " " << interpolate << " " << weigh;
        }
      }
    }
  }
  EXPECT_GT(found, 100u);
}

TEST(HoughGrouping, OfNoCorrespondencesIsNone) {
  EXPECT_TRUE(houghClusters(FramedModel(), FramedKeypoints(), {0.03, 3, true, false}).empty());
}

}  // namespace
}  // namespace sks::baselines
