// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/background_words.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include <sks_detector/detector.hpp>
#include <sks_detector/trainer.hpp>

#include "core/matching/background_views.hpp"
#include "core/matching/object_matching.hpp"
#include "histograms.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

namespace sks::test {
namespace {

Eigen::AlignedBox3f boxAround(const Cloud& cloud) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : cloud.points) box.extend(p);
  return box;
}

TEST(BackgroundViews, AreThingsFromThreeToThirtyCentimetresBeforeTheCamera) {
  std::vector<Cloud> views;
  for (std::size_t thing = 0; thing < backgroundThings(); ++thing) {
    for (const Cloud& view : backgroundViews(thing)) views.push_back(view);
  }
  EXPECT_GT(views.size(), 80u);
  for (const Cloud& view : views) {
    EXPECT_GT(view.size(), 100u);
    EXPECT_FALSE(view.hasColor());
    EXPECT_EQ(view.sensor_origin, Eigen::Vector3f::Zero());
    const Eigen::AlignedBox3f box = boxAround(view);
    EXPECT_GT(box.min().z(), 0.5f);
    EXPECT_LT(box.max().z(), 1.2f);
    EXPECT_LT(box.center().head<2>().norm(), 0.15f);
    EXPECT_GT(box.sizes().maxCoeff(), 0.03f);
    EXPECT_LT(box.sizes().maxCoeff(), 0.7f);  // with the table around it
  }
}

TEST(BackgroundViews, FirstIsACubeOfThreeCentimetres) {
  const Cloud cube = backgroundViews(0).front();
  // From 20 degrees above: the nearest of its corners is nearer than its middle by less than half of the diagonal.
  const Eigen::AlignedBox3f box = boxAround(cube);
  EXPECT_NEAR(box.min().z(), 0.8f - 0.5f * 0.03f * std::sqrt(2.0f), 0.008f);
  EXPECT_NEAR(box.sizes().x(), 0.03f * (std::cos(0.4f) + std::sin(0.4f)), 0.005f);  // a pixel at each side
}

TEST(BackgroundWords, AreHistogramsAndRemembered) {
  const Settings settings;
  const Codebook codebook;
  const auto words = backgroundWords(codebook, settings);
  ASSERT_NE(words, nullptr);
  EXPECT_GT(words->words().rows(), 1000u);
  EXPECT_EQ(words->words().cols(), shot_size);
  std::vector<float> bins;
  for (std::size_t row = 0; row < words->words().rows(); row += 100) {
    double square = 0;
    for (std::size_t bin = 0; bin < shot_size; ++bin) square += std::pow(words->words().row(row, bins)[bin], 2);
    EXPECT_NEAR(square, 1, 0.01);
  }
  EXPECT_EQ(backgroundWords(codebook, settings), words);
  Settings larger;
  larger.descriptor.radius = 0.08;
  EXPECT_NE(backgroundWords(codebook, larger), words);
  Settings hopeless;
  hopeless.descriptor.radius = 0.002;
  EXPECT_EQ(backgroundWords(codebook, hopeless), nullptr);
}

TEST(BackgroundWords, OfACodebookAreTakenWhereItsSettingsAreTheSame) {
  Codebook codebook;
  codebook.background = quantized(histograms(40, shot_size, 7), shot_size);
  Settings settings;
  const auto kept = backgroundWords(codebook, settings);
  ASSERT_EQ(kept->words().rows(), 40u);
  EXPECT_EQ(backgroundWords(codebook, settings), kept);
  settings.voting.bandwidth *= 2;  // says nothing about descriptors
  EXPECT_EQ(backgroundWords(codebook, settings), kept);
  EXPECT_GT(backgroundWords(Codebook(), settings)->words().rows(), 1000u);  // of another one they are its own
  settings.descriptor.radius *= 1.5;
  EXPECT_GT(backgroundWords(codebook, settings)->words().rows(), 1000u);
}

TEST(BackgroundWords, AreTrainedWithACodebookThatNeedsThem) {
  Settings settings;
  const auto trained = [&] {
    const auto cloud =
        test::view({{test::asymmetricShape(), test::poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}}, 0.004f, 96, 72);
    return train({test::sampleOf("thing", cloud)}, settings, "one");
  };
  settings.descriptor.type = DescriptorType::shot;
  const QuantizedDescriptors kept = trained().background;
  ASSERT_GT(kept.rows(), 1000u);
  EXPECT_EQ(kept.rows(), backgroundDescriptors(settings).rows());
  settings.matching.background = false;
  EXPECT_EQ(trained().background.rows(), 0u);
}

TEST(BackgroundWords, TakeVotesOfWhatResemblesThemMore) {
  const std::size_t size = 32;
  const Rows rows = rounded(histograms(4, size, 3)), queries = histograms(60, size, 4),
             background = histograms(30, size, 5);
  Codebook codebook;
  codebook.objects = {"a"};
  codebook.views.resize(1);
  codebook.words.resize(rows.size());
  codebook.descriptors = quantized(rows, size);
  const NearestWord competing(matrix(background, size), SearchEffort::exact());
  const auto matches = ObjectMatcher(codebook).match(matrix(queries, size), 1.3, 2, &competing);

  std::vector<Match> expected;
  for (std::uint32_t q = 0; q < queries.size(); ++q) {
    std::pair<double, std::uint32_t> nearest(1e9, 0);
    for (std::uint32_t w = 0; w < rows.size(); ++w)
      nearest = std::min(nearest, {plainChiSquared(queries[q], rows[w]), w});
    double other = 1e9;
    for (const auto& row : background) other = std::min(other, plainChiSquared(queries[q], row));
    const double smallest = std::min(nearest.first, other);
    if (nearest.first > 1.3 * smallest) continue;
    expected.push_back({q, nearest.second, float(nearest.first), float(std::pow(smallest / nearest.first, 10))});
  }
  ASSERT_EQ(matches.size(), expected.size());
  EXPECT_LT(matches.size(), queries.size());
  std::size_t lighter = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    EXPECT_EQ(matches[i].descriptor, expected[i].descriptor);
    EXPECT_EQ(matches[i].word, expected[i].word);
    EXPECT_NEAR(matches[i].weight, expected[i].weight, 1e-3);
    lighter += matches[i].weight < 1;
  }
  EXPECT_GT(lighter, 0u);
}

TEST(NearestWord, OfALimitedDistanceIsThatOfAllOrNone) {
  const std::size_t size = 64;
  const Rows rows = histograms(700, size, 7), queries = histograms(50, size, 8);
  const NearestWord words(matrix(rows, size), SearchEffort::exact());
  const auto all = words.find(matrix(queries, size), 1, 2);
  std::vector<float> limits;
  for (std::size_t q = 0; q < queries.size(); ++q) limits.push_back(all[q].distance * (q % 2 == 0 ? 1.01f : 0.99f));
  const auto limited = words.find(matrix(queries, size), 1, 2, limits.data());
  ASSERT_EQ(limited.size(), all.size());
  for (std::size_t q = 0; q < queries.size(); ++q) {
    if (q % 2 == 0) {
      EXPECT_EQ(limited[q].word, all[q].word);
      EXPECT_EQ(limited[q].distance, all[q].distance);
    } else {
      EXPECT_GT(limited[q].distance, 1e9f);
    }
  }
}

TEST(BackgroundWords, LeaveAnObjectItsVotesAndTakeThoseOfBoxesAndBalls) {
  using Sort = Solid::Shape;
  const Eigen::Isometry3f T_camera_object = poseOf(35, {1, 2, 0.5f}, {-0.15f, 0, 0.8f});
  const Eigen::Isometry3f T_camera_things = poseOf(25, {1, 0, 0}, {0.15f, 0, 0.8f});
  const Shape things{{Sort::box, {0, 0, 0}, {0.05f, 0.035f, 0.015f}},
                     {Sort::ellipsoid, {0, 0.1f, 0}, {0.035f, 0.035f, 0.035f}}};
  const Cloud scene = view({{asymmetricShape(), T_camera_object}, {things, T_camera_things}}, 0.0025f, 320, 200);
  Settings settings;
  const auto codebook = std::make_shared<const Codebook>(
      train({sampleOf("thing", view({{asymmetricShape(), poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}}))}, settings, "one"));

  const auto votesFor = [&](bool background) {
    settings.matching.background = background;
    Inspection inspection;
    const DetectionResult result = Detector(codebook, settings).detect(scene, &inspection);
    EXPECT_FALSE(result.detections.empty());
    if (!result.detections.empty()) {
      EXPECT_GT(result.detections[0].score, 0.9);
      EXPECT_NEAR(result.detections[0].position().x(), -0.15, 0.02);
    }
    return std::make_pair(result.counts.votes, result.detections.empty() ? 0 : result.detections[0].votes);
  };
  const auto [all, of_object] = votesFor(false);
  const auto [left, left_of_object] = votesFor(true);
  EXPECT_LT(left, 0.8 * double(all));
  EXPECT_GT(left_of_object, 0.8 * double(of_object));
}

}  // namespace
}  // namespace sks::test
