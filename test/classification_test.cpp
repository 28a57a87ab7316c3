// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/classification.hpp"

#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/cloud_io.hpp>

#include "error_of.hpp"
#include "synthetic.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::errorOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr float class_spacing = 0.006f;

Settings classSettings() {
  Settings settings;
  settings.surface.normal_radius = 0.015;
  settings.keypoints.grid_size = 0.03;
  settings.keypoints.discard = 0;
  settings.descriptor.radius = 0.08;
  settings.voting.min_votes = 1;
  settings.matching.ambiguity = 1;
  return settings;
}

std::shared_ptr<const Codebook> classes(ViewKind kind = ViewKind::model) {
  const auto sample = [&](const std::string& name, const test::Shape& shape) {
    const Eigen::Isometry3f T = test::poseOf(0, Eigen::Vector3f::UnitX(), {0, 0, 1});
    const auto load = [=] {
      return kind == ViewKind::model ? test::model(shape, class_spacing) : test::view({{shape, T}});
    };
    return TrainingSample{name, name + ".pcd", kind, load, {}, {}};
  };
  return std::make_shared<Codebook>(train({sample("blocks", test::asymmetricShape()),
                                           sample("potato", test::roundedShape()), sample("cup", test::cupShape())},
                                          classSettings(), "shapes"));
}

/// A shape turned and moved; nearer to the origin than a sensor would measure, as models are.
Cloud turned(const test::Shape& shape) {
  return test::transformed(test::model(shape, class_spacing), test::poseOf(70, {1, 2, -1}, {0.03f, 0.01f, -0.02f}));
}

TEST(Classifier, NamesTurnedModels) {
  const Classifier classifier(classes(), classSettings(), ClassBalance::codewords);
  EXPECT_EQ(classifier.classify(turned(test::asymmetricShape()), ViewKind::model).object(), "blocks");
  EXPECT_EQ(classifier.classify(turned(test::roundedShape()), ViewKind::model).object(), "potato");
  EXPECT_EQ(classifier.classify(turned(test::cupShape()), ViewKind::model).object(), "cup");
}

TEST(Classifier, NamesViews) {
  const auto codebook = classes(ViewKind::view);
  EXPECT_EQ(testKind(*codebook), ViewKind::view);
  const Classifier classifier(codebook, classSettings(), ClassBalance::none);
  const Eigen::Isometry3f T = test::poseOf(15, Eigen::Vector3f::UnitZ(), {0.1f, 0, 1.1f});
  const Classification result = classifier.classify(test::view({{test::asymmetricShape(), T}}), ViewKind::view);
  EXPECT_EQ(result.object(), "blocks");
}

TEST(Classifier, RanksCandidatesByTheirShareOfTheStrength) {
  const Classification result =
      Classifier(classes(), classSettings(), ClassBalance::none).classify(turned(test::cupShape()), ViewKind::model);
  ASSERT_GE(result.candidates.size(), 1u);
  double sum = 0, last = 1;
  for (const Classification::Candidate& candidate : result.candidates) {
    EXPECT_LE(candidate.score, last);
    last = candidate.score;
    sum += candidate.score;
  }
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_GT(result.counts.keypoints, 10u);
  EXPECT_EQ(result.counts.votes, result.counts.descriptors);
  EXPECT_GT(result.times.total, 0);
}

TEST(Classifier, BalanceWeighsDensityByTheRootOfCodewords) {
  const auto codebook = classes();
  std::map<std::string, double> words;
  for (const Codeword& word : codebook->words) words[codebook->objectOf(word)] += 1;
  const Eigen::Isometry3f aside = test::poseOf(0, {1, 0, 0}, {1, 0, 0});
  const Cloud cloud = test::merged(
      {turned(test::roundedShape()), test::transformed(test::model(test::asymmetricShape(), class_spacing), aside)});
  const auto scores = [&](ClassBalance balance) {
    std::map<std::string, double> of;
    for (const auto& c : Classifier(codebook, classSettings(), balance).classify(cloud, ViewKind::model).candidates) {
      of[c.object] = c.score;
    }
    return of;
  };
  const auto plain = scores(ClassBalance::none), balanced = scores(ClassBalance::codewords);
  ASSERT_GE(plain.size(), 2u);
  for (const auto& [object, score] : plain) {
    const double ratio = (balanced.at(object) / balanced.at("potato")) / (score / plain.at("potato"));
    EXPECT_NEAR(ratio, std::sqrt(words["potato"] / words[object]), 1e-6) << object;
  }
}

TEST(Classifier, OtherObjectsNearlyAsNearVoteWithLessWeight) {
  const auto codebook = classes();
  const auto classify = [&](double ambiguity) {
    Settings settings = classSettings();
    settings.matching.ambiguity = ambiguity;
    return Classifier(codebook, settings, ClassBalance::none).classify(turned(test::cupShape()), ViewKind::model);
  };
  const Classification nearest = classify(1), some = classify(1.5), all = classify(10);
  EXPECT_EQ(nearest.counts.votes, nearest.counts.descriptors);
  EXPECT_GT(some.counts.votes, nearest.counts.votes);
  EXPECT_GT(all.counts.votes, some.counts.votes);
  EXPECT_LE(all.counts.votes, 3 * all.counts.descriptors);  // one of each object
  for (const Classification* result : {&nearest, &some, &all}) EXPECT_EQ(result->object(), "cup");
  // the farther a codeword the less it weighs, so that the last ones change next to nothing
  ASSERT_EQ(all.candidates.size(), 3u);
  EXPECT_NEAR(all.candidates[0].score, some.candidates[0].score, 0.02);
  EXPECT_LT(all.candidates[0].score, nearest.candidates[0].score);
}

TEST(Classifier, DoesNotDependOnThreads) {
  const auto codebook = classes();
  Settings settings = classSettings();
  settings.matching.ambiguity = 1.3;
  std::vector<std::vector<double>> scores;
  for (const int threads : {1, 3}) {
    settings.threads = threads;
    scores.emplace_back();
    const Classification result = Classifier(codebook, settings, ClassBalance::codewords)
                                      .classify(turned(test::asymmetricShape()), ViewKind::model);
    for (const auto& candidate : result.candidates) scores.back().push_back(candidate.score);
  }
  EXPECT_EQ(scores[0], scores[1]);
}

TEST(Classifier, RefusesSettingsOfAnotherCodebook) {
  Settings settings = classSettings();
  settings.descriptor.radius = 0.1;
  EXPECT_THAT(errorOf(ErrorCode::incompatible, [&] { Classifier(classes(), settings, ClassBalance::none); }),
              HasSubstr("descriptor.radius = 0.08 (not 0.1)"));
}

/// A data set in memory whose clouds are files.
class EvaluateTests : public ::testing::Test {
protected:
  void SetUp() override {
    writeCloud(folder_.path("one.pcd"), test::sphere(0.1f, 0.02f));
    data_set_.name = "set";
    data_set_.file = folder_.path("set.yaml");
  }
  void add(const std::string& object) { data_set_.tests.push_back({object, folder_.path("one.pcd")}); }
  ClassificationEvaluation run(std::vector<std::string> answers) {
    std::size_t next = 0;
    const auto classify = [&](const Cloud&) {
      Classification result;
      const std::string answer = answers[next++];
      if (!answer.empty()) result.candidates.push_back({answer, 1});
      return result;
    };
    return evaluateTests(data_set_, classify, "fake", Settings());
  }

  test::TemporaryFolder folder_;
  DataSet data_set_;
};

TEST_F(EvaluateTests, CountsHitsAndConfusions) {
  for (const char* object : {"cup", "cup", "cup", "vase", "vase"}) add(object);
  const ClassificationEvaluation result = run({"cup", "vase", "lamp", "vase", ""});
  EXPECT_EQ(result.data_set, "set");
  EXPECT_EQ(result.method, "fake");
  EXPECT_EQ(result.total.tests, 5u);
  EXPECT_EQ(result.total.correct, 2u);
  EXPECT_DOUBLE_EQ(result.total.accuracy(), 0.4);
  EXPECT_THAT(result.objects, ElementsAre("cup", "lamp", "vase"));
  EXPECT_THAT(result.confusion, ElementsAre(ElementsAre(1, 1, 1), ElementsAre(0, 0, 0), ElementsAre(0, 0, 1)));
  EXPECT_THAT(result.unanswered, ElementsAre(0, 0, 1));
  EXPECT_EQ(result.per_object[0].correct, 1u);
  EXPECT_EQ(result.per_object[2].tests, 2u);
}

TEST_F(EvaluateTests, SaysWhatIsMissing) {
  EXPECT_THAT(errorOf(ErrorCode::bad_data, [&] { run({}); }), HasSubstr("has nothing to classify"));
  data_set_.tests.push_back({"cup", folder_.path("absent.pcd")});
  EXPECT_THAT(errorOf(ErrorCode::bad_file, [&] { run({}); }), HasSubstr("absent.pcd"));
}

}  // namespace
}  // namespace sks
