// SPDX-License-Identifier: BSD-3-Clause
// From the cloud in memory to hypotheses: the published method beside one composed of PCL's parts, the default settings
// beside the published ones, two threads beside one.
#include "pair.hpp"
#include "pcl_clouds.hpp"
#include "pcl_pipeline.hpp"
#include "recorded_detectors.hpp"

namespace sks::bench {
namespace {

constexpr const char* recorded = "kinect_new_views";

/// The published method composed of PCL's parts, and ours.
void pipeline(benchmark::State& state) {
  const auto data_set = recordedDataSet(state, recorded);
  if (!data_set) return;
  const Settings settings = preset("paper", threads);
  const auto codebook = trained(*data_set, settings);
  const Detector detector(codebook, settings);
  const PclPipeline pcl_pipeline(*codebook, settings, threads);
  const std::vector<Cloud> clouds = sceneClouds(*data_set, 3);
  std::vector<pcl::PointCloud<pcl::PointXYZ>::Ptr> pcl_clouds;
  for (const Cloud& cloud : clouds) pcl_clouds.push_back(test::pclPoints(cloud.points));
  compare(
      state,
      [&] {
        for (const auto& cloud : pcl_clouds) benchmark::DoNotOptimize(pcl_pipeline.detect(cloud));
      },
      [&] { detectAll(detector, clouds); }, 10, 3);
  state.SetLabel(std::to_string(clouds.size()) + " scenes");
}

/// The default settings may take 1.5 times as long as the published ones.
void publishedAndDefault(benchmark::State& state) {
  const auto data_set = recordedDataSet(state, recorded);
  if (!data_set) return;
  const Settings settings = preset("default", threads);
  const Detector verifying(trained(*data_set, settings), settings);
  const Detector published = verifying.withSettings(preset("paper", threads));
  const std::vector<Cloud> clouds = sceneClouds(*data_set, 8);
  compare(
      state, [&] { detectAll(published, clouds); }, [&] { detectAll(verifying, clouds); }, 1 / 1.5);
  state.SetLabel("theirs: paper.yaml, ours: default.yaml; " + std::to_string(clouds.size()) + " scenes");
}

void secondThread(benchmark::State& state, const char* name) {
  const auto data_set = recordedDataSet(state, recorded);
  if (!data_set) return;
  const Settings settings = preset(name, threads);
  const Detector two(trained(*data_set, settings), settings), one = two.withSettings(preset(name, 1));
  const std::vector<Cloud> clouds = sceneClouds(*data_set, 8);
  compare(
      state, [&] { detectAll(one, clouds); }, [&] { detectAll(two, clouds); }, 1.7);
}

BENCHMARK(pipeline)->Apply(asPair);
BENCHMARK(publishedAndDefault)->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, detection_paper, "paper")->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, detection_default, "default")->Apply(asPair);

}  // namespace
}  // namespace sks::bench
