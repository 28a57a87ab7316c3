// SPDX-License-Identifier: BSD-3-Clause
// Codebooks that name far more objects than they have codewords for: small files, and no more work than without these.
#include <chrono>

#include <gtest/gtest.h>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/detector.hpp>

#include "bumps.hpp"
#include "temporary_folder.hpp"
#include "training_samples.hpp"

namespace sks {
namespace {

Codebook bumpsAnd(int objects_without_words) {
  Codebook codebook = train({test::sampleOf("bumps", test::bumps())}, {}, "many");
  for (int i = 0; i < objects_without_words; ++i) {
    codebook.objects.push_back("empty" + std::to_string(i));
    TrainingView view;
    view.object = std::uint32_t(i + 1);
    view.source = "e";
    view.box_max = Eigen::Vector3f(0.1f, 0.1f, 0.1f);
    codebook.views.push_back(view);
  }
  return codebook;
}

double secondsOf(const Detector& detector, const Cloud& cloud, DetectionResult& result) {
  const auto start = std::chrono::steady_clock::now();
  result = detector.detect(cloud);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST(ManyObjects, WithoutCodewordsCostNothing) {
  const Cloud scene = test::bumps();
  DetectionResult few_result, many_result;
  const double few = secondsOf(Detector(bumpsAnd(0)), scene, few_result);
  const test::TemporaryFolder folder;
  writeCodebook(folder.path("many.sks"), bumpsAnd(10000));
  const Detector many(readCodebook(folder.path("many.sks")));
  ASSERT_EQ(many.codebook().objects.size(), 10001u);
  const double seconds = secondsOf(many, scene, many_result);
  EXPECT_LT(seconds, 3 * few + 0.5);
  RecordProperty("milliseconds", int(1000 * seconds));
  ASSERT_FALSE(few_result.detections.empty());
  ASSERT_EQ(many_result.detections.size(), few_result.detections.size());
  for (std::size_t i = 0; i < few_result.detections.size(); ++i) {
    EXPECT_EQ(many_result.detections[i].object, few_result.detections[i].object);
    EXPECT_EQ(many_result.detections[i].score, few_result.detections[i].score);
    EXPECT_TRUE(many_result.detections[i].T_scene_model.matrix() == few_result.detections[i].T_scene_model.matrix());
  }
}

}  // namespace sks
