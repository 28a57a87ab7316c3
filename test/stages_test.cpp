// SPDX-License-Identifier: BSD-3-Clause
// Stages of a user's own in place of the package's.
#include <sks_detector/stages/stages.hpp>

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/error.hpp>

#include "core/pipeline/classifier.hpp"
#include "core/pipeline/codebook_edit.hpp"
#include "error_of.hpp"
#include "synthetic.hpp"
#include "temporary_folder.hpp"
#include "training_samples.hpp"

namespace sks {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Every 25th point; in scenes only those on the right.
class SomePoints : public KeypointStage {
public:
  Keypoints detect(const Surface& surface, const Settings& /*settings*/) const override {
    Keypoints keypoints;
    for (std::size_t i = 0; i < surface.size(); i += 25) keypoints.positions.push_back(surface.point(i));
    return keypoints;
  }
  Keypoints select(const Surface& /*surface*/, Keypoints keypoints, const Settings& /*settings*/) const override {
    auto& positions = keypoints.positions;
    positions.erase(std::remove_if(positions.begin(), positions.end(), [](const auto& p) { return p.x() < 0; }),
                    positions.end());
    return keypoints;
  }
};

/// SHOT of half as many volumes: pairs of bins are added up.
class HalfShot : public DescriptorStage {
public:
  explicit HalfShot(std::string name = "half") : name_(std::move(name)) {}

  std::string name() const override { return name_; }
  std::size_t size() const override { return shot_size / 2; }
  Descriptors describe(const Surface& surface, const Keypoints& keypoints, const Settings& settings) const override {
    Descriptors descriptors =
        computeDescriptors(surface, keypoints, DescriptorType::shot, settings.descriptor, threadCount(settings));
    std::vector<float> values;
    for (std::size_t row = 0; row < descriptors.values.rows(); ++row) {
      const float* bins = descriptors.values.row(row);
      for (std::size_t bin = 0; bin < shot_size; bin += 2) values.push_back(bins[bin] + bins[bin + 1]);
    }
    descriptors.values = DescriptorMatrix(std::move(values), size());
    return descriptors;
  }

private:
  std::string name_;
};

/// Says 32 and gives 16.
class Liar : public HalfShot {
public:
  std::size_t size() const override { return 32; }
  Descriptors describe(const Surface& /*surface*/, const Keypoints& keypoints, const Settings& /*s*/) const override {
    Descriptors descriptors;
    descriptors.keypoints = {0};
    descriptors.frames.resize(1);
    descriptors.values = DescriptorMatrix(std::vector<float>(16, 1.0f), 16);
    return keypoints.size() > 0 ? descriptors : Descriptors();
  }
};

/// Believes everything on the left, by 0.75.
class LeftOnly : public VerifierStage {
public:
  std::vector<Hypothesis> verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                 const Codebook& codebook, const Settings& /*settings*/) const override {
    EXPECT_GT(scene.surface.size(), 0u);
    EXPECT_EQ(scene.votes.size(), codebook.objects.size());
    std::vector<Hypothesis> believed;
    for (const Hypothesis& h : proposed) {
      if (h.T_scene_box.translation().x() < 0) believed.push_back(h);
    }
    return believed;
  }
  double score(const Hypothesis& hypothesis, const Settings& /*settings*/) const override {
    return hypothesis.density > 0 ? 0.75 : 0;
  }
};

Cloud viewAt(const test::Shape& shape, float x) {
  return test::view({test::Placed{shape, test::poseOf(35, {1, 2, 0.5f}, {x, 0, 0.8f})}}, 0.0025f, 240, 120);
}

std::vector<TrainingSample> samples() {
  return {test::sampleOf("thing", viewAt(test::asymmetricShape(), 0.1f), ViewKind::view, "thing.pcd"),
          test::sampleOf("round", viewAt(test::roundedShape(), 0.1f), ViewKind::view, "round.pcd")};
}

Cloud scene() {
  return test::view({test::Placed{test::asymmetricShape(), test::poseOf(45, {1, 2, 0.5f}, {-0.12f, 0, 0.8f})},
                     test::Placed{test::roundedShape(), test::poseOf(30, {1, 2, 0.5f}, {0.12f, 0, 0.8f})}},
                    0.0025f, 240, 120);
}

TEST(Stages, OwnKeypointsAreTrainedAndDetectedWith) {
  Stages stages;
  stages.keypoints = std::make_shared<SomePoints>();
  const Codebook codebook = train(samples(), {}, "toys", {}, stages);
  const Surface surface = [] {
    const Settings settings;
    Cloud cloud = viewAt(test::asymmetricShape(), 0.1f);
    cloud.points.erase(
        std::remove_if(cloud.points.begin(), cloud.points.end(), [](const auto& p) { return !p.allFinite(); }),
        cloud.points.end());
    cloud.width = 0;
    return prepareSurface(cloud, settings.surface, Orientation::sensor, 1);
  }();
  std::size_t words = 0;
  for (const Codeword& word : codebook.words) words += word.view == 0;
  EXPECT_NEAR(double(words), double(surface.size()) / 25, 0.1 * double(surface.size()) / 25);

  Settings settings;
  settings.keypoints.skip_planes = false;
  Inspection inspection;
  const DetectionResult result = Detector(codebook, settings, stages).detect(scene(), &inspection);
  EXPECT_EQ(result.counts.grid_keypoints, (result.counts.points + 24) / 25);
  EXPECT_EQ(result.counts.keypoints, inspection.keypoints.size());
  for (const Eigen::Vector3f& keypoint : inspection.keypoints) EXPECT_GE(keypoint.x(), 0);
  ASSERT_EQ(result.above(0.5).size(), 1u);
  EXPECT_EQ(result.detections[0].object, "round");
}

TEST(Stages, OwnDescriptorsAreTrainedStoredAndDetectedWith) {
  Stages stages;
  stages.descriptors = std::make_shared<HalfShot>();
  const Codebook trained = train(samples(), {}, "toys", {}, stages);
  EXPECT_EQ(trained.descriptorName(), "half");
  EXPECT_EQ(trained.descriptorSize(), shot_size / 2);
  EXPECT_EQ(trained.descriptors.cols(), shot_size / 2);

  const test::TemporaryFolder folder;
  writeCodebook(folder.path("toys.sks"), trained);
  const auto codebook = readCodebook(folder.path("toys.sks"));
  EXPECT_EQ(codebook->descriptorName(), "half");
  EXPECT_EQ(codebook->descriptorSize(), shot_size / 2);
  EXPECT_EQ(codebookChecksum(*codebook), codebookChecksum(trained));
  const auto found = Detector(codebook, codebook->settings, stages).detect(scene()).above(0.5);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found[0].object, found[1].object);
  EXPECT_EQ(withoutObject(*codebook, "thing")->descriptorName(), "half");
}

TEST(Stages, ACodebookOfOtherDescriptorsIsRefused) {
  Stages stages;
  stages.descriptors = std::make_shared<HalfShot>();
  const auto foreign = std::make_shared<const Codebook>(train(samples(), {}, "toys", {}, stages));
  const auto shot = std::make_shared<const Codebook>(train(samples(), {}, "toys"));
  EXPECT_EQ(
      test::errorOf(ErrorCode::incompatible, [&] { Detector{foreign}; }),
      "the codebook 'toys' holds descriptors 'half' of 176 values, which are of a stage that is not there: use the "
      "stages that it was trained with, or train again");
  EXPECT_THAT(test::errorOf(ErrorCode::incompatible, [&] { Detector(shot, {}, stages); }),
              AllOf(HasSubstr("holds descriptors 'shot' of 352 values, but scenes are described by 'half' of 176")));
  stages.descriptors = std::make_shared<HalfShot>("other");
  EXPECT_THAT(test::errorOf(ErrorCode::incompatible, [&] { Detector(foreign, {}, stages); }),
              HasSubstr("'half' of 176 values, but scenes are described by 'other' of 176 values"));
  EXPECT_THAT(test::errorOf(ErrorCode::incompatible, [&] { Classifier(foreign, {}, ClassBalance::none); }),
              HasSubstr("holds descriptors 'half' of 176 values"));
}

TEST(Stages, DescriptorStagesThatBreakTheirPromiseAreRefused) {
  Stages stages;
  for (const char* name : {"", "shot", "cshot"}) {
    stages.descriptors = std::make_shared<HalfShot>(name);
    EXPECT_THAT(test::errorOf(ErrorCode::bad_usage, [&] { train(samples(), {}, "toys", {}, stages); }),
                HasSubstr(std::string("'") + name + "' of 176 values is none"));
  }
  stages.descriptors = std::make_shared<Liar>();
  EXPECT_THAT(test::errorOf(ErrorCode::bad_data, [&] { train(samples(), {}, "toys", {}, stages); }),
              AllOf(HasSubstr("thing.pcd: the descriptor stage 'half' gave 1 descriptors of 16 values"),
                    HasSubstr("it says that a descriptor has 32")));
}

TEST(Stages, OwnVerifierChoosesAndScores) {
  const auto codebook = std::make_shared<const Codebook>(train(samples(), {}, "toys"));
  Stages stages;
  stages.verifier = std::make_shared<LeftOnly>();
  const Detector detector(codebook, {}, stages);
  for (const Detector& used : {detector, detector.withSettings({})}) {
    const auto found = used.detect(scene()).detections;
    ASSERT_GE(found.size(), 1u);
    for (const Detection& detection : found) {
      EXPECT_LT(detection.position().x(), 0);
      EXPECT_EQ(detection.score, 0.75);
    }
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const auto& d) { return d.object == "thing"; }));
  }
}

/// Gives what the codebook does not hold.
class Confused : public LeftOnly {
public:
  std::vector<Hypothesis> verify(std::vector<Hypothesis> /*proposed*/, const SceneDescription& /*scene*/,
                                 const Codebook& /*codebook*/, const Settings& /*settings*/) const override {
    Hypothesis hypothesis;
    hypothesis.object = 7;
    return {hypothesis};
  }
};

TEST(Stages, VerifiersThatGiveUnknownObjectsAreRefused) {
  Stages stages;
  stages.verifier = std::make_shared<Confused>();
  const Detector detector(train(samples(), {}, "toys"), {}, stages);
  EXPECT_THAT(test::errorOf(ErrorCode::bad_data, [&] { detector.detect(scene()); }),
              HasSubstr("a hypothesis of object 7, view 0, which the codebook 'toys' does not hold"));
}

}  // namespace
}  // namespace sks
