// SPDX-License-Identifier: BSD-3-Clause
// Codebooks that were trained apart and joined are what training all at once gives.
#include "core/pipeline/codebook_merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/simulation/training_views.hpp>
#include <sks_detector/trainer.hpp>

#include "bumps.hpp"
#include "error_of.hpp"
#include "io/codebook_bytes.hpp"
#include "io/file.hpp"
#include "simulation/builtin_objects.hpp"
#include "temporary_folder.hpp"
#include "training_samples.hpp"
#ifdef SKS_EXECUTABLE
#include "run_sks.hpp"
#endif

namespace sks {
namespace {

using test::errorOf;
using test::sampleOf;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Samples = std::vector<TrainingSample>;

Samples operator+(Samples a, const Samples& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Few and coarse views of a built-in mesh.
Samples viewsOf(const std::string& mesh, const std::string& object) {
  MeshTraining training;
  training.views = 6;
  return meshSamples(object, "builtin:" + mesh, std::make_shared<const Mesh>(builtinObject(mesh)), training);
}

std::shared_ptr<const Codebook> trainedOn(const Samples& samples, const Settings& settings = {}) {
  return std::make_shared<const Codebook>(train(samples, settings, "all"));
}

/// As it is after it was written and read.
std::shared_ptr<const Codebook> stored(const std::shared_ptr<const Codebook>& codebook) {
  return codebookFromBytes(codebookBytes(*codebook));
}

std::string mergedBytes(const std::vector<std::shared_ptr<const Codebook>>& codebooks) {
  std::vector<CodebookPart> parts;
  for (const auto& codebook : codebooks) parts.push_back({"part.sks", stored(codebook)});
  return codebookBytes(mergedCodebook(parts, "all"));
}

RegisteredModel modelOf(std::uint32_t object, const std::string& frame) {
  RegisteredModel model;
  model.object = object;
  model.frame = frame;
  model.surface.points = model.surface.normals = {Eigen::Vector3f::UnitX()};
  model.surface.box.extend(Eigen::Vector3f::UnitX());
  return model;
}

TEST(CodebookMerge, GivesTheFileOfTrainingAllAtOnce) {
  const Samples first = viewsOf("mug", "mug") + Samples{sampleOf("bumps", test::bumps(true))};
  const Samples second = viewsOf("duck", "duck");
  const auto a = trainedOn(first), b = trainedOn(second), all = trainedOn(first + second);
  EXPECT_GT(all->background.rows(), 0u);
  EXPECT_EQ(mergedBytes({a, b}), codebookBytes(*all));
}

TEST(CodebookMerge, GivesTheFileOfTrainingAllAtOnceInColour) {
  const Samples first{sampleOf("a", test::bumps(true))}, second{sampleOf("b", test::bumps(true))},
      third{sampleOf("c", test::bumps(true))};
  const auto all = trainedOn(first + second + third);
  EXPECT_EQ(all->descriptor_type, DescriptorType::cshot);
  EXPECT_EQ(mergedBytes({trainedOn(first), trainedOn(second), trainedOn(third)}), codebookBytes(*all));
}

TEST(CodebookMerge, KeepsAllWordsOfTwoObjectsOfOneMesh) {
  const Samples first = viewsOf("mug", "mug"), second = viewsOf("mug", "cup");
  const auto all = trainedOn(first + second);
  std::vector<std::size_t> words(2, 0);
  for (const Codeword& word : all->words) ++words[all->views[word.view].object];
  EXPECT_EQ(words[0], words[1]);
  EXPECT_EQ(mergedBytes({trainedOn(first), trainedOn(second)}), codebookBytes(*all));
}

TEST(CodebookMerge, MakesTheBackgroundThatOlderFilesLack) {
  const Samples first = viewsOf("mug", "mug"), second = viewsOf("duck", "duck");
  Codebook a = *trainedOn(first), b = *trainedOn(second);
  a.background = b.background = {};
  EXPECT_EQ(mergedBytes({std::make_shared<const Codebook>(a), std::make_shared<const Codebook>(b)}),
            codebookBytes(*trainedOn(first + second)));
}

TEST(CodebookMerge, KeepsModelsWithTheirObjects) {
  Codebook a = *trainedOn({sampleOf("a", test::bumps())});
  Codebook b = *trainedOn({sampleOf("b", test::bumps()), sampleOf("c", test::bumps())});
  a.models = {modelOf(0, "a#model")};
  b.models = {modelOf(1, "c#model")};
  const Codebook all = mergedCodebook(
      {{"a.sks", std::make_shared<const Codebook>(a)}, {"b.sks", std::make_shared<const Codebook>(b)}}, "three");
  EXPECT_EQ(all.name, "three");
  EXPECT_THAT(all.objects, ElementsAre("a", "b", "c"));
  ASSERT_EQ(all.models.size(), 2u);
  EXPECT_EQ(all.objects[all.models[0].object], "a");
  EXPECT_EQ(all.objects[all.models[1].object], "c");
}

TEST(CodebookMerge, RefusesOtherSettingsWithNamesAndValues) {
  Settings other;
  other.keypoints.grid_size = 0.03;
  other.descriptor.radius = 0.06;
  other.threads = 1;
  const auto a = trainedOn({sampleOf("a", test::bumps())}), b = trainedOn({sampleOf("b", test::bumps())}, other);
  const std::string error = errorOf(ErrorCode::incompatible, [&] {
    mergedCodebook({{"a.sks", a}, {"b.sks", b}}, "all");
  });
  const Settings& settings = a->settings;
  for (const char* key : {"keypoints.grid_size", "descriptor.radius"}) {
    EXPECT_THAT(error, HasSubstr(std::string(key) + " = " + getSetting(other, key) + " (not " +
                                 getSetting(settings, key) + ")"));
  }
  EXPECT_THAT(error, AllOf(HasSubstr("'a.sks'"), HasSubstr("'b.sks'")));
  EXPECT_THAT(error, ::testing::Not(HasSubstr("threads")));
}

TEST(CodebookMerge, RefusesColourBesideShapeAlone) {
  const auto a = trainedOn({sampleOf("a", test::bumps(true))}), b = trainedOn({sampleOf("b", test::bumps(false))});
  EXPECT_THAT(errorOf(ErrorCode::incompatible,
                      [&] {
                        mergedCodebook({{"a.sks", a}, {"b.sks", b}}, "all");
                      }),
              HasSubstr("'b.sks' holds descriptors 'shot' of 352 values, not 'cshot' of 1344 values like 'a.sks'"));
}

TEST(CodebookMerge, NamesTheObjectsThatAreThereTwice) {
  const Samples abc{sampleOf("a", test::bumps()), sampleOf("b", test::bumps()), sampleOf("c", test::bumps())};
  const auto first = trainedOn(abc), second = trainedOn({abc[2], sampleOf("d", test::bumps()), abc[0]});
  EXPECT_THAT(errorOf(ErrorCode::incompatible,
                      [&] {
                        mergedCodebook({{"x.sks", first}, {"y.sks", second}}, "all");
                      }),
              HasSubstr("'x.sks' and 'y.sks' both hold 'c', 'a': "));
}

#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

/// Two codebooks of one object each, and one of both.
class MergeCommand : public ::testing::Test {
protected:
  void SetUp() override {
    train("a.sks", {"--mesh", "mug=builtin:mug"});
    train("b.sks", {"--mesh", "duck=builtin:duck"});
  }

  void train(const std::string& file, std::vector<std::string> meshes) const {
    meshes.insert(meshes.begin(), {"train", "--views", "4", "--name", "pair", "--output", folder_.path(file)});
    const test::CommandRun run = test::runSks(meshes);
    ASSERT_EQ(run.status, 0) << run.errors;
  }

  test::CommandRun merge(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"merge", "--output", folder_.path("c.sks")});
    return test::runSks(arguments);
  }
  test::CommandRun mergeBoth(std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {folder_.path("a.sks"), folder_.path("b.sks")});
    return merge(options);
  }
  std::string content(const std::string& file) const { return readTextFile(folder_.path(file)); }

  test::TemporaryFolder folder_;
};

TEST_F(MergeCommand, WritesTheFileOfTrainingAllAtOnce) {
  const test::CommandRun run = mergeBoth();
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, AllOf(HasSubstr("mug"), HasSubstr("duck")));
  train("both.sks", {"--mesh", "mug=builtin:mug", "--mesh", "duck=builtin:duck"});
  EXPECT_EQ(content("c.sks"), content("both.sks"));
}

TEST_F(MergeCommand, ReplacesNothingWithoutForce) {
  writeFileAtomically(folder_.path("c.sks"), "mine");
  const test::CommandRun refused = mergeBoth();
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, AllOf(HasSubstr("c.sks' is there already"), HasSubstr("--force")));
  EXPECT_EQ(content("c.sks"), "mine");
  const test::CommandRun run = mergeBoth({"--force", "--name", "other"});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("other"));
}

TEST_F(MergeCommand, SaysWhatCannotBeMerged) {
  const test::CommandRun one = merge({folder_.path("a.sks")});
  EXPECT_EQ(one.status, 2);
  EXPECT_THAT(one.errors, HasSubstr("give at least two codebooks"));
  const test::CommandRun twice = merge({folder_.path("a.sks"), folder_.path("a.sks")});
  EXPECT_EQ(twice.status, 1);
  EXPECT_THAT(twice.errors, HasSubstr("both hold 'mug'"));
  const test::CommandRun missing = merge({folder_.path("a.sks"), folder_.path("gone.sks")});
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.errors, HasSubstr("gone.sks"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("c.sks")));
}

#endif

}  // namespace
}  // namespace sks
