// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/trainer.hpp>

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "bumps.hpp"
#include "error_of.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

using sks::DescriptorType;
using sks::ErrorCode;
using sks::ViewKind;
using sks::test::errorOf;
using sks::test::sampleOf;
using testing::HasSubstr;

namespace {

sks::Cloud asymmetric(bool color) {
  return sks::test::model(sks::test::asymmetricShape(), 0.004f, color);
}

std::string trainingError(ErrorCode code, const std::vector<sks::TrainingSample>& samples,
                          const sks::Settings& settings = {}) {
  return errorOf(code, [&] { sks::train(samples, settings, "test"); });
}

std::vector<float> valuesOf(const sks::Codebook& codebook) {
  const sks::DescriptorMatrix rows = codebook.descriptors.values();
  return {rows.data(), rows.data() + rows.rows() * rows.cols()};
}

}  // namespace

TEST(Trainer, KeepsEveryWordWithItsViewAndObject) {
  sks::Settings settings;
  settings.keypoints.discard = 0.9;  // no selection in training
  const sks::Cloud bumps = sks::test::bumps(true);
  const auto codebook = sks::train(
      {sampleOf("thing", asymmetric(true), ViewKind::model, "a.ply"), sampleOf("bumps", bumps, ViewKind::view, "b.pcd"),
       sampleOf("thing", sks::test::transformed(asymmetric(true), sks::test::poseOf(0, {0, 0, 1}, {1, 2, 3})),
                ViewKind::model, "c.ply")},
      settings, "trio");
  EXPECT_EQ(codebook.name, "trio");
  EXPECT_EQ(codebook.objects, (std::vector<std::string>{"thing", "bumps"}));
  ASSERT_EQ(codebook.views.size(), 3u);
  EXPECT_EQ(codebook.views[0].object, 0u);
  EXPECT_EQ(codebook.views[1].object, 1u);
  EXPECT_EQ(codebook.views[2].object, 0u);
  EXPECT_EQ(codebook.views[1].source, "b.pcd");
  EXPECT_EQ(codebook.views[1].kind, ViewKind::view);
  EXPECT_EQ(codebook.views[2].kind, ViewKind::model);
  EXPECT_EQ(codebook.words.size(), codebook.descriptors.rows());
  std::vector<std::size_t> words(3, 0);
  for (const auto& word : codebook.words) {
    ++words[word.view];
    const auto& view = codebook.views[word.view];
    EXPECT_TRUE((word.position.array() >= view.box_min.array()).all());
    EXPECT_TRUE((word.position.array() <= view.box_max.array()).all());
    EXPECT_NEAR(word.frame.determinant(), 1, 1e-4);
  }
  const sks::Surface surface = sks::prepareSurface(bumps, {}, sks::Orientation::sensor, 1);
  EXPECT_EQ(words[1], sks::gridKeypoints(surface, 0.02).size());
  EXPECT_EQ(codebook.settings.keypoints.discard, 0.9);
}

// Trap 12: the centre is that of the box, not the centroid of the points.
TEST(Trainer, CenterIsThatOfTheBox) {
  sks::Cloud cloud = sks::test::bumps();
  const std::size_t n = cloud.size();
  for (std::size_t i = 0; i < n; ++i) {  // one side is sampled thrice as densely
    if (cloud.points[i].x() < 0) cloud.points.push_back(cloud.points[i] + Eigen::Vector3f(0.001f, 0.001f, 0));
    if (cloud.points[i].x() < 0) cloud.points.push_back(cloud.points[i] + Eigen::Vector3f(0.0015f, 0.0015f, 0));
  }
  cloud.width = std::uint32_t(cloud.size());
  Eigen::Vector3f low = cloud.points[0], high = low;
  for (const auto& p : cloud.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const sks::TrainingView view = sks::train({sampleOf("bumps", cloud)}, {}, "test").views[0];
  EXPECT_EQ(view.box_min, low);
  EXPECT_EQ(view.box_max, high);
  EXPECT_LT((view.center() - 0.5f * (low + high)).norm(), 1e-6f);
  EXPECT_LT((view.extent() - (high - low)).norm(), 1e-6f);
}

TEST(Trainer, KeepsAThinnedSurfaceWithNormals) {
  sks::Settings settings;
  settings.training.surface_resolution = 0.01;
  const auto cloud = sks::test::sphere(0.06f, 0.003f, {1, 2, 3});
  const auto view = sks::train({sampleOf("ball", cloud, ViewKind::model)}, settings, "test").views[0];
  ASSERT_EQ(view.surface_points.size(), view.surface_normals.size());
  EXPECT_GT(view.surface_points.size(), 300u);
  EXPECT_LT(view.surface_points.size(), cloud.size() / 3);
  for (std::size_t i = 0; i < view.surface_points.size(); ++i) {
    EXPECT_GT(view.surface_normals[i].dot((view.surface_points[i] - Eigen::Vector3f(1, 2, 3)).normalized()), 0.99f);
  }
}

TEST(Trainer, KeepsTheColorsOfTheSurface) {
  const auto plain = sks::train({sampleOf("bumps", sks::test::bumps())}, {}, "test").views[0];
  EXPECT_TRUE(plain.surface_colors.empty());
  sks::Cloud cloud = sks::test::sphere(0.06f, 0.003f, {1, 2, 3});
  cloud.colors.assign(cloud.size(), {255, 0, 0});
  const auto view = sks::train({sampleOf("ball", cloud, ViewKind::model)}, {}, "test").views[0];
  ASSERT_EQ(view.surface_colors.size(), view.surface_points.size());
  for (const Eigen::Vector3f& color : view.surface_colors) {  // red is L 53.2, a 80.1, b 67.2
    EXPECT_LT((color - Eigen::Vector3f(0.532f, 0.668f, 0.56f)).norm(), 0.003f);
  }
}

TEST(Trainer, AutomaticDescriptorIsCshotWhereAllCloudsHaveColor) {
  const auto colored = sampleOf("a", asymmetric(true), ViewKind::model), plain = sampleOf("b", sks::test::bumps());
  const auto color = sks::train({colored, colored}, {}, "test");
  EXPECT_EQ(color.descriptor_type, DescriptorType::cshot);
  EXPECT_EQ(color.settings.descriptor.type, DescriptorType::cshot);
  EXPECT_EQ(color.descriptors.cols(), sks::cshot_size);

  // From the first cloud without colour on, all are SHOT: the very ones that SHOT gives.
  sks::Settings shot;
  shot.descriptor.type = DescriptorType::shot;
  const auto expected = sks::train({colored, plain, colored}, shot, "test");
  const auto mixed = sks::train({colored, plain, colored}, {}, "test");
  EXPECT_EQ(mixed.descriptor_type, DescriptorType::shot);
  EXPECT_EQ(mixed.settings.descriptor.type, DescriptorType::shot);
  ASSERT_EQ(mixed.words.size(), expected.words.size());
  const auto a = valuesOf(mixed), b = valuesOf(expected);
  ASSERT_EQ(a.size(), b.size());
  std::size_t rounded_otherwise = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(a[i], b[i], 0.01f);
    rounded_otherwise += std::abs(a[i] - b[i]) > 1e-6f;
  }
  EXPECT_LT(rounded_otherwise, a.size() / 1000);
}

TEST(Trainer, AutomaticDescriptorIsShotForMeshes) {
  sks::TrainingSample rendered = sampleOf("a", asymmetric(true), ViewKind::model);
  rendered.rendered = true;
  const auto codebook = sks::train({rendered, sampleOf("b", asymmetric(true), ViewKind::model)}, {}, "test");
  EXPECT_EQ(codebook.descriptor_type, DescriptorType::shot);
  for (const sks::TrainingView& view : codebook.views) {  // colours are still compared in verification
    EXPECT_EQ(view.surface_colors.size(), view.surface_points.size());
  }
}

TEST(Trainer, ForcedCshotRefusesACloudWithoutColorByName) {
  sks::Settings settings;
  settings.descriptor.type = DescriptorType::cshot;
  const std::string message = trainingError(
      ErrorCode::incompatible, {sampleOf("b", sks::test::bumps(), ViewKind::view, "plain/b.pcd")}, settings);
  EXPECT_THAT(message, HasSubstr("plain/b.pcd: "));
  EXPECT_THAT(message, HasSubstr("descriptor.type=shot"));
}

TEST(Trainer, UnusableCloudsAreNamedBySource) {
  const auto nameless = [](sks::Cloud cloud, const std::string& source) {
    return sampleOf("thing", std::move(cloud), ViewKind::view, source);
  };
  EXPECT_EQ(trainingError(ErrorCode::bad_data, {nameless({}, "a.pcd")}), "a.pcd: the cloud is empty (0 points)");
  EXPECT_THAT(trainingError(ErrorCode::bad_data, {nameless(sks::test::bumps(), "fine.pcd"),
                                                  nameless(sks::test::randomCloud(3, 1, 1), "b.pcd")}),
              HasSubstr("b.pcd: the cloud has 3 usable points"));
  sks::Cloud millimetres = sks::test::bumps();
  for (auto& p : millimetres.points) p *= 1000;
  EXPECT_THAT(trainingError(ErrorCode::bad_data, {nameless(millimetres, "mm.pcd")}),
              HasSubstr("mm.pcd: the cloud looks like millimetres"));
  // Points farther apart than the radii.
  const std::string sparse =
      trainingError(ErrorCode::bad_data, {nameless(sks::test::randomCloud(50, 5, 2), "sparse.pcd")});
  EXPECT_THAT(sparse, HasSubstr("sparse.pcd: none of its 50 keypoints has a descriptor"));
  EXPECT_THAT(sparse, HasSubstr("surface.normal_radius (0.01 m)"));
  EXPECT_THAT(sparse, HasSubstr("descriptor.radius (0.05 m)"));
}

TEST(Trainer, ViewsOfAMeshAlongAThinPartAreLeftOut) {
  sks::TrainingSample side = sampleOf("stick", asymmetric(false), ViewKind::model, "stick.ply");
  sks::TrainingSample end = sampleOf("stick", sks::test::plane(0.008f, 0.001f), ViewKind::view, "stick.ply#1");
  for (sks::TrainingSample* sample : {&side, &end}) {
    sample->rendered = true;
    sample->box = Eigen::AlignedBox3f(Eigen::Vector3f(-0.1f, -0.1f, -0.1f), Eigen::Vector3f(0.1f, 0.1f, 0.1f));
  }
  EXPECT_EQ(sks::train({end, side}, {}, "test").views.size(), 1u);
  EXPECT_THAT(trainingError(ErrorCode::bad_data, {end}),
              HasSubstr("stick.ply#1: none of the views of 'stick' shows more than a thin end of it; train more"));
  end.rendered = false;  // of a camera's view the size is the user's affair
  EXPECT_THAT(trainingError(ErrorCode::bad_data, {end, side}), HasSubstr("the cloud is too small"));
}

TEST(Trainer, WithoutCloudsThereIsNothingToTrain) {
  EXPECT_EQ(trainingError(ErrorCode::bad_usage, {}), "there is nothing to train: no training cloud was given");
}

TEST(Trainer, WordsOfMeshesThatRepeatOthersAreLeftOut) {
  using sks::test::poseOf;
  const auto view = [](float degrees) {
    auto sample = sampleOf(
        "thing", sks::test::view({{sks::test::asymmetricShape(), poseOf(degrees, {1, 2, 0.5f}, {0, 0, 0.8f})}}));
    sample.rendered = true;
    sample.frame = "thing.obj";
    return sample;
  };
  sks::Settings settings;
  const auto words = [&](const std::vector<sks::TrainingSample>& samples) {
    const sks::Codebook codebook = sks::train(samples, settings, "test");
    EXPECT_EQ(codebook.descriptors.rows(), codebook.words.size());
    EXPECT_EQ(codebook.views.size(), samples.size());
    return codebook.words.size();
  };
  const auto first = view(35), other_side = view(215);
  const std::size_t once = words({first});
  EXPECT_EQ(words({first, first}), once);
  EXPECT_GT(words({first, other_side}), once + once / 2);
  auto other_mesh = first;
  other_mesh.frame = "other.obj";
  EXPECT_EQ(words({first, other_mesh}), 2 * once);
  auto captured = first;
  captured.rendered = false;
  const std::size_t all = words({captured});
  EXPECT_EQ(words({captured, captured}), 2 * all);  // noise says something new each time
  settings.detection.hypotheses = sks::Hypotheses::hough;
  EXPECT_EQ(words({first, first}), 2 * all);  // as published, every codeword is kept
}

TEST(Trainer, ReportsProgressAndCanBeCancelled) {
  const std::vector<sks::TrainingSample> samples{sampleOf("a", sks::test::bumps(), ViewKind::view, "1.pcd"),
                                                 sampleOf("a", sks::test::bumps(), ViewKind::view, "2.pcd")};
  std::vector<std::string> items;
  sks::train(samples, {}, "test", [&](const sks::ProgressState& state) {
    EXPECT_EQ(state.stage, "training");
    EXPECT_EQ(state.total, 2u);
    EXPECT_EQ(state.done, items.size());
    items.push_back(state.item);
    return true;
  });
  EXPECT_EQ(items, (std::vector<std::string>{"1.pcd", "2.pcd", ""}));
  const auto stop = [](const sks::ProgressState& state) { return state.done < 1; };
  EXPECT_EQ(errorOf(ErrorCode::cancelled, [&] { sks::train(samples, {}, "test", stop); }),
            "training was cancelled after 1 of 2");
}

TEST(Trainer, DoesNotDependOnThreads) {  // trap 9
  const std::vector<sks::TrainingSample> samples{sampleOf("a", asymmetric(true), ViewKind::model),
                                                 sampleOf("b", sks::test::bumps(true))};
  sks::Settings settings;
  settings.threads = 1;
  const auto one = sks::train(samples, settings, "test");
  settings.threads = 2;
  const auto two = sks::train(samples, settings, "test");
  ASSERT_EQ(one.words.size(), two.words.size());
  EXPECT_EQ(valuesOf(one), valuesOf(two));
  for (std::size_t i = 0; i < one.words.size(); ++i) {
    EXPECT_EQ(one.words[i].position, two.words[i].position);
    EXPECT_EQ(one.words[i].frame, two.words[i].frame);
  }
}
