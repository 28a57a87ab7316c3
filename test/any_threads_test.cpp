// SPDX-License-Identifier: BSD-3-Clause
// The same with 1 to 16 threads, whatever the machine has and whatever else it does, for clouds of any kind.
#include <sks_detector/detector.hpp>

#include <atomic>
#include <cmath>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>
#include <sks_detector/trainer.hpp>

#include "bumps.hpp"
#include "synthetic.hpp"

namespace sks {
namespace {

constexpr int most_threads = 16;

std::shared_ptr<const Codebook> bumpsCodebook() {
  static const auto codebook = std::make_shared<const Codebook>(
      train({{"bumps", "bumps.pcd", ViewKind::view, [] { return test::bumps(); }, {}, {}}}, Settings(), "bumps"));
  return codebook;
}

/// All that is found, to the last bit, or why the cloud is refused.
std::string outcome(const Detector& detector, const Cloud& cloud) {
  std::ostringstream text;
  text.precision(17);
  try {
    for (const Detection& d : detector.detect(cloud).detections) {
      text << d.object << " " << d.score << " " << d.votes << " " << d.inliers << " " << d.T_scene_model.matrix()
           << "\n";
    }
  } catch (const Error& error) {
    text << error.what();
  }
  return text.str();
}

std::vector<Detector> detectorsOfAnyThreads() {
  std::vector<Detector> detectors;
  const Detector first(bumpsCodebook());
  for (int threads = 1; threads <= most_threads; ++threads) {
    Settings settings = bumpsCodebook()->settings;
    settings.threads = threads;
    detectors.push_back(first.withSettings(settings));
  }
  return detectors;
}

void expectOneOutcome(const Cloud& cloud, const std::string& what) {
  static const std::vector<Detector> detectors = detectorsOfAnyThreads();
  const std::string wanted = outcome(detectors[0], cloud);
  for (int threads = 2; threads <= most_threads; ++threads) {
    EXPECT_EQ(outcome(detectors[std::size_t(threads - 1)], cloud), wanted) << what << ", " << threads << " threads";
  }
}

/// Keeps all cores busy in its scope.
class OtherWork {
public:
  OtherWork() {
    for (unsigned i = 0; i <= std::thread::hardware_concurrency(); ++i) {
      threads_.emplace_back([this] {
        while (!done_) ++turns_;
      });
    }
  }
  ~OtherWork() {
    done_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  OtherWork(const OtherWork&) = delete;
  OtherWork& operator=(const OtherWork&) = delete;

private:
  std::atomic<bool> done_{false};
  std::atomic<unsigned> turns_{0};
  std::vector<std::thread> threads_;
};

/// An image of a plane whose points are multiples of 1/128 m, all of them different.
Cloud dyadicImage(std::uint32_t columns, std::uint32_t rows) {
  Cloud cloud;
  cloud.width = columns;
  cloud.height = rows;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      cloud.points.emplace_back((float(column) - float(columns) / 2) / 128, (float(row) - float(rows) / 2) / 128, 4.0f);
    }
  }
  return cloud;
}

}  // namespace

TEST(AnyThreads, FindTheSameWhileTheMachineIsBusy) {
  const OtherWork other;
  const Cloud cloud = test::transformed(test::bumps(), test::poseOf(15, {0, 1, 0}, {0.05f, 0, 0.1f}));
  ASSERT_FALSE(Detector(bumpsCodebook()).detect(cloud).detections.empty());
  expectOneOutcome(cloud, "bumps");
}

TEST(AnyThreads, ComeToAnEndOnMultiplesOfAPowerOfTwo) {
  expectOneOutcome(dyadicImage(256, 256), "65,536 points");  // never ended with 8 threads
  expectOneOutcome(dyadicImage(320, 250), "80,000 points");  // nor this one with 4
}

TEST(AnyThreads, FindTheSameInCloudsOfAnyKind) {
  constexpr int n = 3000;
  std::vector<Eigen::Vector3f> line, one(n, {0, 0, 1}), powers, tiny, huge, far;
  for (int i = 0; i < n; ++i) {
    line.emplace_back(0.0f, 0.0f, 1.0f + float(i) * 1e-3f);
    powers.emplace_back(std::ldexp(1.0f, i % 60 - 56), std::ldexp(1.0f, i / 60 - 46), 1.0f);
    tiny.emplace_back(float(i % 60) * 1e-42f, float(i / 60) * 1e-42f, 0.0f);
    huge.emplace_back(float(i % 60) * 1e30f, float(i / 60) * 1e30f, 1e30f);
    far.emplace_back(float(i % 60) * 0.1f, float(i / 60) * 0.1f, i < 10 ? 0.01f : 19.0f);
  }
  expectOneOutcome(test::makeCloud(line), "a line");
  expectOneOutcome(test::makeCloud(one), "one place");
  expectOneOutcome(test::makeCloud(powers), "powers of two");
  expectOneOutcome(test::makeCloud(tiny), "tiny");
  expectOneOutcome(test::makeCloud(huge), "huge");
  expectOneOutcome(test::makeCloud(far), "far");
}

TEST(AnyThreads, TrainTheSame) {
  for (const ViewKind kind : {ViewKind::view, ViewKind::model}) {
    std::vector<float> first;
    for (int threads = 1; threads <= most_threads; ++threads) {
      Settings settings;
      settings.threads = threads;
      const Codebook codebook =
          train({{"bumps", "bumps.pcd", kind, [] { return test::bumps(); }, {}, {}}}, settings, "b");
      const DescriptorMatrix rows = codebook.descriptors.values();
      const std::vector<float> values(rows.data(), rows.data() + rows.rows() * rows.cols());
      if (threads == 1) first = values;
      ASSERT_FALSE(values.empty());
      EXPECT_EQ(values, first) << threads;
    }
  }
}

}  // namespace sks
