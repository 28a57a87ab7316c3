// SPDX-License-Identifier: BSD-3-Clause
// Counts allocations: once a thread's buffers have grown, the hot stages allocate their results and nothing else.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include <sks_detector/descriptors.hpp>
#include <sks_detector/sanitize.hpp>

#include "core/image_normals.hpp"
#include "synthetic.hpp"

namespace {

std::atomic<std::size_t> allocations{0};

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
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

sks::Cloud objectImage() {
  return sks::sanitize(
      sks::test::view({{sks::test::asymmetricShape(), sks::test::poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}}), {});
}

}  // namespace

TEST(Allocations, NormalsNeedNone) {
  const sks::Cloud cloud = objectImage();
  sks::Surface surface = sks::makeSurface(cloud, 0.01);
  EXPECT_EQ(allocationsOf([&] { sks::estimateNormals(surface, {}, sks::Orientation::sensor, 1); }), 0u);
  std::vector<Eigen::Vector3f> normals;
  EXPECT_EQ(allocationsOf([&] { EXPECT_TRUE(sks::imageNormals(cloud, {}, 1, normals)); }), 0u);
}

TEST(Allocations, SelectionNeedsThoseOfItsResultOnly) {
  const sks::Surface surface = sks::prepareSurface(objectImage(), {}, sks::Orientation::sensor, 1);
  sks::Keypoints keypoints = sks::gridKeypoints(surface, 0.01);
  ASSERT_GT(keypoints.size(), 100u);
  EXPECT_EQ(allocationsOf([&] { sks::measureCurvature(surface, keypoints, {}, {}, 1); }), 0u);
}

TEST(Allocations, DescriptorsNeedThoseOfTheirResultOnly) {
  const sks::Surface surface = sks::prepareSurface(objectImage(), {}, sks::Orientation::sensor, 1);
  for (const double grid_size : {0.01, 0.03}) {
    const sks::Keypoints keypoints = sks::gridKeypoints(surface, grid_size);
    // Values and their shared owner, frames, indices: however many keypoints there are.
    EXPECT_EQ(allocationsOf([&] { sks::computeDescriptors(surface, keypoints, sks::DescriptorType::shot, {}, 1); }), 4u)
        << keypoints.size();
  }
}
