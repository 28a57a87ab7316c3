// SPDX-License-Identifier: BSD-3-Clause
// End to end on synthetic clouds: training, then detection.
#include <sks_detector/detector.hpp>

#include <algorithm>
#include <thread>

#include <gmock/gmock.h>

#include "bumps.hpp"
#include "error_of.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

using sks::DescriptorType;
using sks::ErrorCode;
using sks::ViewKind;
using sks::test::asymmetricShape;
using sks::test::errorOf;
using sks::test::Placed;
using sks::test::poseOf;
using sks::test::roundedShape;
using sks::test::sampleOf;
using sks::test::transformed;
using testing::HasSubstr;

namespace {

/// How far from the camera training views are taken.
const Eigen::Vector3f distance(0, 0, 0.8f);

/// A camera's view of a turned shape, moved so that the turned shape is at the origin: a training view.
sks::Cloud viewOf(const sks::test::Shape& shape, float degrees = 35, bool color = false) {
  const sks::Cloud seen =
      sks::test::view({Placed{shape, poseOf(degrees, {1, 2, 0.5f}, distance)}}, 0.0025f, 160, 120, color);
  return transformed(seen, poseOf(0, {0, 0, 1}, -distance));
}

std::shared_ptr<const sks::Codebook> codebookOf(const std::vector<sks::TrainingSample>& samples,
                                                const sks::Settings& settings = {}) {
  return std::make_shared<const sks::Codebook>(sks::train(samples, settings, "synthetic"));
}

std::shared_ptr<const sks::Codebook> twoObjects() {
  static const auto codebook = codebookOf({sampleOf("thing", viewOf(asymmetricShape()), ViewKind::view, "thing.pcd"),
                                           sampleOf("round", viewOf(roundedShape()), ViewKind::view, "round.pcd")});
  return codebook;
}

void expectPose(const sks::Detection& detection, const Eigen::Isometry3f& T, double degrees, double metres) {
  const Eigen::Isometry3d expected = T.cast<double>();
  EXPECT_LT(sks::test::angleDegrees(detection.T_scene_model.linear(), expected.linear()), degrees);
  EXPECT_LT((detection.T_scene_model.translation() - expected.translation()).norm(), metres);
}

void expectSame(const std::vector<sks::Detection>& a, const std::vector<sks::Detection>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].object, b[i].object);
    EXPECT_EQ(a[i].view, b[i].view);
    EXPECT_EQ(a[i].score, b[i].score);
    EXPECT_EQ(a[i].votes, b[i].votes);
    EXPECT_EQ(a[i].inliers, b[i].inliers);
    EXPECT_EQ(a[i].T_scene_model.matrix(), b[i].T_scene_model.matrix());
    EXPECT_EQ(a[i].T_scene_box.matrix(), b[i].T_scene_box.matrix());
  }
}

/// Two different objects before a wall.
sks::Cloud clutteredScene() {
  const sks::test::Shape wall{{sks::test::Solid::Shape::box, {0, 0, 0}, {1, 1, 0.02f}}};
  return sks::test::view({Placed{asymmetricShape(), poseOf(55, {1, 2, 0.3f}, {-0.12f, 0.02f, 0.8f})},
                          Placed{roundedShape(), poseOf(20, {1, 2, 0.5f}, {0.12f, 0, 0.75f})},
                          Placed{wall, poseOf(10, {0, 1, 0}, {0, 0, 1.1f})}},
                         0.0025f, 240, 160);
}

}  // namespace

// Traps 5 and 6: the whole pose, for poses all around, the identity included.
TEST(Detector, FindsAMovedCopyWithItsPose) {
  const sks::Detector detector(twoObjects(), {});
  const sks::Cloud view = viewOf(asymmetricShape());
  for (const auto& T :
       {poseOf(0, {0, 0, 1}, {0, 0, 0}), poseOf(25, {0, 1, 0}, {0.1f, 0, 0.2f}), poseOf(90, {0, 0, 1}, {0, 0.2f, 0}),
        poseOf(180, {1, 1, 0}, {0.3f, -0.2f, 1.5f}), poseOf(120, {1, -1, 1}, {-0.5f, 0.1f, 0.4f})}) {
    const auto result = detector.detect(transformed(view, T));
    ASSERT_FALSE(result.detections.empty());
    const sks::Detection& best = result.detections.front();
    EXPECT_EQ(best.object, "thing");
    EXPECT_EQ(best.view, "thing.pcd");
    EXPECT_GT(best.score, 0.5);
    expectPose(best, T, 1, 0.002);
  }
}

TEST(Detector, FindsTheVeryTrainingViewExactly) {
  sks::Settings all_points;
  all_points.surface.spacing_at_1m = 0;
  const auto best = sks::Detector(twoObjects(), all_points).detect(viewOf(asymmetricShape())).detections.at(0);
  expectPose(best, Eigen::Isometry3f::Identity(), 1e-3, 1e-5);
  const auto of_thinned = sks::Detector(twoObjects(), {}).detect(viewOf(asymmetricShape())).detections.at(0);
  expectPose(of_thinned, Eigen::Isometry3f::Identity(), 0.3, 5e-4);
}

// Trap 12: the position is that of the box's centre, the pose that of the model's frame, however far apart.
TEST(Detector, OffCenterModelIsReportedAtItsBox) {
  const Eigen::Isometry3f away = poseOf(0, {0, 0, 1}, {3, -2, 1});
  const sks::Cloud view = transformed(viewOf(asymmetricShape()), away);
  const auto codebook = codebookOf({sampleOf("thing", view)});
  const sks::TrainingView& trained = codebook->views[0];
  const Eigen::Isometry3f T = poseOf(60, {0, 1, 1}, {0.4f, 0, 1}) * away.inverse();
  const auto best = sks::Detector(codebook, {}).detect(transformed(view, T)).detections.at(0);
  const Eigen::Vector3d center = (T * trained.center()).cast<double>();
  EXPECT_LT((best.position() - center).norm(), 0.005);
  EXPECT_LT(sks::test::angleDegrees(best.T_scene_model.linear(), T.linear().cast<double>()), 1);
  EXPECT_LT((best.T_scene_model * trained.center().cast<double>() - center).norm(), 0.005);
  EXPECT_LT((best.box_size - trained.extent().cast<double>()).norm(), 1e-5);
  EXPECT_LT((best.T_scene_box.linear() - best.T_scene_model.linear()).norm(), 1e-9);
}

// Trap 13: views between those that were trained, which are registered into one model frame.
TEST(Detector, FindsAnObjectInViewsThatItWasNotTrainedWith) {
  const auto turned = [](float degrees) {
    return poseOf(25, {1, 0, 0}, distance) * poseOf(degrees, {0, 1, 0}, {0, 0, 0});
  };
  std::vector<sks::TrainingSample> samples;
  for (int degrees = 0; degrees < 360; degrees += 30) {
    for (const auto& [name, shape] : {std::make_pair("thing", asymmetricShape()), {"round", roundedShape()}}) {
      const Eigen::Isometry3f T = turned(float(degrees));
      samples.push_back(sampleOf(name, transformed(sks::test::view({Placed{shape, T}}), T.inverse())));
    }
  }
  const sks::Detector detector(codebookOf(samples), {});
  for (int degrees = 15; degrees < 360; degrees += 60) {
    const Eigen::Isometry3f T = turned(float(degrees));
    const auto result = detector.detect(sks::test::view({Placed{asymmetricShape(), T}}));
    ASSERT_FALSE(result.detections.empty());
    EXPECT_EQ(result.detections[0].object, "thing") << degrees;
    expectPose(result.detections[0], T, 0.5, 0.001);
  }
}

TEST(Detector, ThreeCopiesAreThreeDetections) {
  const std::vector<Eigen::Isometry3f> poses{poseOf(35, {1, 2, 0.5f}, {-0.3f, 0, 0.8f}),
                                             poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f}),
                                             poseOf(35, {1, 2, 0.5f}, {0.3f, 0.05f, 0.85f})};
  std::vector<Placed> placed;
  for (const auto& T : poses) placed.push_back({asymmetricShape(), T});
  const sks::Cloud scene = sks::test::view(placed, 0.0025f, 480, 160);
  const auto result = sks::Detector(twoObjects(), {}).detect(scene);
  std::vector<sks::Detection> found;
  for (const auto& detection : result.above(0.5)) {
    if (detection.object == "thing") found.push_back(detection);
  }
  ASSERT_EQ(found.size(), 3u);
  const Eigen::Isometry3f trained = poseOf(35, {1, 2, 0.5f}, {0, 0, 0});
  const Eigen::Vector3f center = twoObjects()->views[0].center();
  for (const auto& T : poses) {
    const Eigen::Vector3d expected = (T * trained.inverse() * center).cast<double>();
    EXPECT_EQ(std::count_if(found.begin(), found.end(),
                            [&](const auto& d) { return (d.position() - expected).norm() < 0.02; }),
              1);
  }
}

TEST(Detector, FindsTheSameInAThinnedImageWithEvidenceOfTheSameSize) {
  sks::Settings all_points, half_the_rows;
  all_points.surface.spacing_at_1m = 0;
  half_the_rows.surface.spacing_at_1m = 0.005;
  const auto all = sks::Detector(twoObjects(), all_points).detect(clutteredScene());
  const auto few = sks::Detector(twoObjects(), half_the_rows).detect(clutteredScene());
  EXPECT_NEAR(double(all.counts.points) / double(few.counts.points), 4, 0.2);
  const auto a = all.above(0.5), b = few.above(0.5);
  ASSERT_EQ(a.size(), 2u);
  ASSERT_EQ(b.size(), 2u);
  for (const auto& detection : b) {
    const auto same =
        std::find_if(a.begin(), a.end(), [&](const auto& other) { return other.object == detection.object; });
    ASSERT_NE(same, a.end());
    EXPECT_LT((same->position() - detection.position()).norm(), 0.003);
    EXPECT_NEAR(detection.evidence / same->evidence, 1, 0.35);
  }
}

// Trap 7: a score does not depend on what else there is in the scene, but for the width of the range image's cells.
TEST(Detector, ScoreIsTheSameWhateverElseIsInTheScene) {
  sks::Settings settings;
  settings.keypoints.discard = 0;
  const sks::Detector detector(twoObjects(), settings);
  const sks::Cloud alone = transformed(viewOf(asymmetricShape(), 50), poseOf(0, {0, 0, 1}, {-1, 0, 0}));
  const sks::Cloud scene =
      sks::test::merged({alone, transformed(viewOf(roundedShape(), 10), poseOf(0, {0, 0, 1}, {0.3f, 0, 0})),
                         transformed(viewOf(asymmetricShape(), 35), poseOf(0, {0, 0, 1}, {1.3f, 0, 0}))});
  const auto expected = detector.detect(alone).detections.at(0);
  const auto result = detector.detect(scene);
  std::size_t same = 0;
  for (const auto& detection : result.detections) {
    if ((detection.position() - expected.position()).norm() > 1e-4 || detection.object != "thing") continue;
    EXPECT_NEAR(detection.score, expected.score, 1e-3);
    ++same;
  }
  EXPECT_EQ(same, 1u);
  EXPECT_GT(result.detections.size(), 2u);
}

// Trap 9: run to run, instance to instance, and for any number of threads.
TEST(Detector, IsDeterministic) {
  const sks::Cloud scene = clutteredScene();
  sks::Settings settings;
  settings.threads = 1;
  const sks::Detector one(twoObjects(), settings);
  const auto expected = one.detect(scene).detections;
  ASSERT_GE(expected.size(), 2u);
  expectSame(one.detect(scene).detections, expected);
  for (const int threads : {1, 2, 5}) {
    settings.threads = threads;
    expectSame(sks::Detector(twoObjects(), settings).detect(scene).detections, expected);
  }
}

// Several threads that use one instance at the same time get what one gets.
TEST(Detector, IsSharedByThreads) {
  const sks::Cloud scene = clutteredScene();
  const sks::Cloud other = transformed(viewOf(asymmetricShape()), poseOf(25, {0, 1, 0}, {0.1f, 0, 0.2f}));
  for (const auto hypotheses : {sks::Hypotheses::verified, sks::Hypotheses::hough}) {
    for (const int threads : {1, 3}) {
      sks::Settings settings;
      settings.detection.hypotheses = hypotheses;
      settings.threads = threads;
      const sks::Detector detector(twoObjects(), settings);
      const auto expected = detector.detect(scene).detections, expected_of_other = detector.detect(other).detections;
      ASSERT_GE(expected.size(), 2u);
      ASSERT_GE(expected_of_other.size(), 1u);
      std::vector<std::vector<sks::Detection>> found(4 * 3);
      std::vector<std::thread> users;
      for (std::size_t user = 0; user < 4; ++user) {
        users.emplace_back([&, user] {
          for (std::size_t run = 0; run < 3; ++run) {
            found[3 * user + run] = detector.detect((user + run) % 2 == 0 ? scene : other).detections;
          }
        });
      }
      for (std::thread& user : users) user.join();
      for (std::size_t user = 0; user < 4; ++user) {
        for (std::size_t run = 0; run < 3; ++run) {
          expectSame(found[3 * user + run], (user + run) % 2 == 0 ? expected : expected_of_other);
        }
      }
    }
  }
}

TEST(Detector, TakesWhatTrainingGivesWithItsSettings) {
  sks::Settings settings;
  settings.detection.threshold = 0.61;
  settings.keypoints.discard = 0.25;
  settings.surface.normal_radius = 0.011;
  const auto samples = std::vector<sks::TrainingSample>{sampleOf("thing", viewOf(asymmetricShape()))};
  const sks::Detector detector(sks::train(samples, settings, "toys"));
  EXPECT_EQ(detector.codebook().name, "toys");
  EXPECT_EQ(detector.settings().detection.threshold, 0.61);
  EXPECT_EQ(detector.settings().surface.normal_radius, 0.011);
  const auto found = detector.detect(viewOf(asymmetricShape())).detections;
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].object, "thing");

  const auto shared = std::make_shared<const sks::Codebook>(sks::train(samples, settings, "toys"));
  expectSame(sks::Detector(shared).detect(viewOf(asymmetricShape())).detections, found);
  settings.keypoints.discard = 0;
  EXPECT_EQ(sks::Detector(sks::train(samples, settings, "toys"), settings).settings().keypoints.discard, 0);
}

TEST(Detector, ACloudOfNothingButPointsIsEnough) {
  const sks::Cloud whole = clutteredScene();
  sks::Cloud unorganized = whole;
  unorganized.width = std::uint32_t(whole.size());
  unorganized.height = 1;
  sks::Cloud points;
  points.points = whole.points;
  EXPECT_FALSE(points.organized());
  const sks::Detector detector(twoObjects(), {});
  const auto found = detector.detect(points).detections;
  ASSERT_GE(found.size(), 2u);
  expectSame(found, detector.detect(unorganized).detections);
  const auto samples = std::vector<sks::TrainingSample>{sampleOf("scene", points)};
  EXPECT_GT(sks::train(samples, {}, "points").words.size(), 10u);
}

TEST(Detector, CountsAndOrdersWhatItDoes) {
  sks::Settings settings;
  settings.keypoints.discard = 0.25;
  settings.keypoints.skip_planes = false;
  settings.matching.background = false;
  const sks::Cloud scene = clutteredScene();
  EXPECT_GT(sks::Detector(twoObjects(), settings).detect(scene).counts.votes,
            sks::Detector(twoObjects(), settings).detect(scene).counts.descriptors);  // of other objects too
  settings.matching.ambiguity = 1;
  const auto result = sks::Detector(twoObjects(), settings).detect(scene);
  const sks::StageCounts& counts = result.counts;
  EXPECT_EQ(counts.input_points, scene.size());
  EXPECT_GT(counts.points, 5000u);
  EXPECT_LE(counts.points, scene.size());
  EXPECT_EQ(counts.keypoints, counts.grid_keypoints - counts.grid_keypoints / 4);
  EXPECT_LE(counts.descriptors, counts.keypoints);
  EXPECT_EQ(counts.votes, counts.descriptors);  // trap 3: each descriptor votes
  EXPECT_EQ(counts.hypotheses, result.detections.size());
  for (std::size_t i = 0; i < result.detections.size(); ++i) {
    EXPECT_GE(result.detections[i].score, 0);
    EXPECT_LT(result.detections[i].score, 1);
    EXPECT_LE(result.detections[i].score, result.detections[i > 0 ? i - 1 : 0].score);
    EXPECT_LE(result.detections[i].inliers, result.detections[i].votes);
  }
  EXPECT_GE(result.times.total, result.times.descriptors);
  EXPECT_GT(result.times.descriptors, 0);
  const double threshold = result.detections.at(1).score;
  for (const auto& detection : result.above(threshold)) EXPECT_GE(detection.score, threshold);
  EXPECT_GE(result.above(threshold).size(), 2u);
  EXPECT_TRUE(result.above(1).empty());
}

TEST(Detector, FindsTheSameWithoutTheKeypointsOfTheWall) {
  std::vector<Placed> placed{{asymmetricShape(), poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}};
  placed.push_back(
      {{{sks::test::Solid::Shape::box, {0, 0, 0}, {0.8f, 0.8f, 0.01f}}}, poseOf(0, {0, 0, 1}, {0, 0, 1.2f})});
  const sks::Cloud scene = sks::test::view(placed, 0.0025f, 320, 240);
  const auto codebook = std::make_shared<const sks::Codebook>(
      sks::train({sampleOf("thing", sks::test::view({placed.front()}))}, sks::Settings(), "synthetic"));
  sks::Settings settings;
  const auto without = sks::Detector(codebook, settings).detect(scene);
  settings.keypoints.skip_planes = false;
  const auto with = sks::Detector(codebook, settings).detect(scene);
  EXPECT_LT(without.counts.keypoints, with.counts.keypoints / 2);
  EXPECT_EQ(without.counts.grid_keypoints, with.counts.grid_keypoints);
  ASSERT_EQ(without.above(0.5).size(), 1u);
  ASSERT_EQ(with.above(0.5).size(), 1u);
  EXPECT_LT((without.detections[0].position() - with.detections[0].position()).norm(), 0.001);
}

TEST(Detector, EmptyResultWhereNothingCanBeDescribed) {
  const auto result = sks::Detector(twoObjects(), {}).detect(sks::test::randomCloud(50, 5, 3));
  EXPECT_TRUE(result.detections.empty());
  EXPECT_EQ(result.counts.descriptors, 0u);
}

TEST(Detector, SettingsThatDifferFromTheCodebooksAreNamedWithBothValues) {
  sks::Settings settings;
  settings.descriptor.radius = 0.06;
  settings.surface.normal_radius = 0.015;
  settings.keypoints.discard = 0.25;  // free
  const std::string message = errorOf(ErrorCode::incompatible, [&] { sks::Detector(twoObjects(), settings); });
  EXPECT_THAT(message, HasSubstr("the codebook 'synthetic' was trained with"));
  EXPECT_THAT(message, HasSubstr("descriptor.radius = 0.05 (not 0.06)"));
  EXPECT_THAT(message, HasSubstr("surface.normal_radius = 0.01 (not 0.015)"));
  EXPECT_THAT(message, Not(HasSubstr("discard")));
  EXPECT_THAT(message, HasSubstr("train again"));

  settings = {};
  settings.descriptor.type = DescriptorType::cshot;
  EXPECT_THAT(errorOf(ErrorCode::incompatible, [&] { sks::Detector(twoObjects(), settings); }),
              HasSubstr("descriptor.type = shot (not cshot)"));
  settings = {};
  settings.keypoints.discard = 2;
  EXPECT_THAT(errorOf(ErrorCode::bad_usage, [&] { sks::Detector(twoObjects(), settings); }),
              HasSubstr("keypoints.discard"));
}

TEST(Detector, ColorTellsEqualShapesApart) {
  sks::Cloud red = viewOf(asymmetricShape(), 35, true), blue = red;
  for (auto& color : red.colors) color = {std::uint8_t(color.r / 2 + 120), color.g, 20};
  for (auto& color : blue.colors) color = {color.g, 20, color.r};
  const auto codebook = codebookOf({sampleOf("red", red), sampleOf("blue", blue)});
  EXPECT_EQ(codebook->descriptor_type, DescriptorType::cshot);
  const sks::Detector detector(codebook, {});
  const Eigen::Isometry3f T = poseOf(40, {0, 1, 1}, {0.1f, 0, 0});
  EXPECT_EQ(detector.detect(transformed(red, T)).detections.at(0).object, "red");
  EXPECT_EQ(detector.detect(transformed(blue, T)).detections.at(0).object, "blue");

  const std::string message = errorOf(ErrorCode::incompatible, [&] { detector.detect(viewOf(asymmetricShape())); });
  EXPECT_THAT(message, HasSubstr("the codebook 'synthetic' describes colour (CSHOT), but the cloud has none"));
  EXPECT_THAT(message, HasSubstr("descriptor.type=shot"));
}

TEST(Detector, UnusableCloudsAreRefused) {
  const sks::Detector detector(twoObjects(), {});
  EXPECT_EQ(errorOf(ErrorCode::bad_data, [&] { detector.detect({}); }), "the cloud is empty (0 points)");
}

TEST(Detector, WithIssKeypointsAndEverySelectionFindsTheObject) {
  const Eigen::Isometry3f T = poseOf(25, {0, 1, 0}, {0.1f, 0, 0.2f});
  const sks::Cloud scene = transformed(viewOf(asymmetricShape()), T);
  sks::Settings settings;
  settings.keypoints.selection = sks::SelectionRule::histogram;
  EXPECT_EQ(sks::Detector(twoObjects(), settings).detect(scene).detections.at(0).object, "thing");
  settings.keypoints.selection = sks::SelectionRule::threshold;
  EXPECT_EQ(sks::Detector(twoObjects(), settings).detect(scene).detections.at(0).object, "thing");
  settings.keypoints.detector = sks::KeypointDetector::iss;
  const auto codebook =
      codebookOf({sampleOf("thing", viewOf(asymmetricShape())), sampleOf("round", viewOf(roundedShape()))}, settings);
  EXPECT_EQ(sks::Detector(codebook, settings).detect(scene).detections.at(0).object, "thing");
}
