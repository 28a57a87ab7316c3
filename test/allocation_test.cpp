// SPDX-License-Identifier: BSD-3-Clause
// Counts allocations: once a thread's buffers have grown, the hot stages allocate their results and nothing else.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/matching.hpp>

#include "core/keypoints/sparse_selection.hpp"
#include "core/surface/image_normals.hpp"
#include "core/surface/normals.hpp"
#include "core/surface/pinhole_fit.hpp"
#include "core/surface/sanitize.hpp"
#include "core/verification/pose_evidence.hpp"
#include "core/verification/projective_refinement.hpp"
#include "core/verification/refinement.hpp"
#include "core/verification/rough_support.hpp"
#include "core/voting/vote_density.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

namespace {

std::atomic<std::size_t> allocations{0};

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace {

/// Allocations of the second of two equal calls.
template <typename Stage>
std::size_t allocationsOf(Stage&& stage) {
  stage();
  const std::size_t before = allocations;
  stage();
  return allocations - before;
}

sks::Cloud imageOfObject() {
  return sks::sanitize(
      sks::test::view({{sks::test::asymmetricShape(), sks::test::poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}}), {});
}

}  // namespace

TEST(Allocations, NormalsNeedNone) {
  const sks::Cloud cloud = imageOfObject();
  sks::Surface surface = sks::makeSurface(cloud, 0.01);
  EXPECT_EQ(allocationsOf([&] { sks::estimateNormals(surface, {}, sks::Orientation::sensor, 1); }), 0u);
  std::vector<Eigen::Vector3f> normals;
  EXPECT_EQ(
      allocationsOf([&] { EXPECT_TRUE(sks::imageNormals(cloud, *sks::fitPinhole(cloud, 1), 1, {}, 1, normals)); }), 0u);
}

TEST(Allocations, SelectionNeedsThoseOfItsResultOnly) {
  const sks::Surface surface = sks::prepareSurface(imageOfObject(), {}, sks::Orientation::sensor, 1);
  sks::Keypoints keypoints = sks::gridKeypoints(surface, 0.01);
  ASSERT_GT(keypoints.size(), 100u);
  EXPECT_EQ(allocationsOf([&] { sks::measureCurvature(surface, keypoints, {}, {}, 1); }), 0u);
}

TEST(Allocations, DescriptorsNeedThoseOfTheirResultOnly) {
  const sks::Surface surface = sks::prepareSurface(imageOfObject(), {}, sks::Orientation::sensor, 1);
  for (const double grid_size : {0.01, 0.03}) {
    const sks::Keypoints keypoints = sks::gridKeypoints(surface, grid_size);
    // Values and their shared owner, frames, indices: however many keypoints there are.
    EXPECT_EQ(allocationsOf([&] { sks::computeDescriptors(surface, keypoints, sks::DescriptorType::shot, {}, 1); }), 4u)
        << keypoints.size();
  }
}

TEST(Allocations, MatchingNeedsThatOfItsResultOnly) {
  const sks::Surface surface = sks::prepareSurface(imageOfObject(), {}, sks::Orientation::sensor, 1);
  const auto describe = [&](double grid_size) {
    return sks::computeDescriptors(surface, sks::gridKeypoints(surface, grid_size), sks::DescriptorType::shot, {}, 1);
  };
  const sks::DescriptorMatrix words = describe(0.005).values;
  ASSERT_GT(words.rows(), 500u);
  for (const sks::SearchKind search : {sks::SearchKind::exact, sks::SearchKind::approximate}) {
    const sks::Matcher matcher(words, search);
    for (const double grid_size : {0.01, 0.03}) {
      const sks::DescriptorMatrix queries = describe(grid_size).values;
      EXPECT_EQ(allocationsOf([&] { EXPECT_EQ(matcher.match(queries, 1).size(), queries.rows()); }), 1u);
    }
  }
}

TEST(Allocations, PosesNeedThoseOfTheirConfirmingPointsOnly) {
  const sks::Settings settings;
  const sks::Cloud cloud = imageOfObject();
  const sks::Surface surface = sks::prepareSurface(cloud, settings.surface, sks::Orientation::sensor, 1);
  const sks::SceneView scene(surface, settings);
  const sks::Codebook codebook = sks::train({sks::test::sampleOf("thing", cloud)}, settings, "synthetic");
  const sks::TrainingView& view = codebook.views.at(0);
  const sks::SurfaceWeights surface_weights(view);
  const sks::RoughSurface rough(view);
  const Eigen::Isometry3d near_truth(Eigen::Translation3d(0.004, -0.003, 0.002));
  EXPECT_EQ(allocationsOf([&] { EXPECT_GT(sks::roughSupport(rough, scene, near_truth).points, 20); }), 0u);
  EXPECT_EQ(allocationsOf([&] { sks::refineAlongRays(view, scene, settings.refinement, near_truth); }), 0u);
  EXPECT_EQ(allocationsOf([&] {
              sks::refinePose(view.surface_points, view.surface_normals, surface, settings.refinement, near_truth);
            }),
            0u);
  EXPECT_EQ(allocationsOf([&] {
              const auto evidence = sks::examinePose(view, surface_weights, scene, settings, near_truth);
              EXPECT_GT(evidence.confirming.size(), 100u);
            }),
            1u);
  const std::vector<sks::Vote> votes(20);
  const sks::VoteDensity density(votes, 0.03);
  EXPECT_EQ(allocationsOf([&] { EXPECT_EQ(density.count({0, 0, 0}) + 0 * density.at({0, 0, 0}), 20); }), 0u);
}
