// SPDX-License-Identifier: BSD-3-Clause
// From the cloud in memory to hypotheses, on the scenes of kinect_new_views with its codebook.
#include <sks_detector/dataset.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/settings_file.hpp>
#include <sks_detector/trainer.hpp>

#include "pair.hpp"
#include "pcl_clouds.hpp"
#include "pcl_pipeline.hpp"
#include "recorded_scenes.hpp"

namespace sks::bench {
namespace {

constexpr std::size_t scene_count = 3;

Settings publishedSettings() {
  Settings settings;
  loadSettings(std::string(SKS_SOURCE_DIR) + "/config/paper.yaml", settings);
  settings.threads = threads;
  return settings;
}

/// The published method composed of PCL's parts, and ours.
void pipeline(benchmark::State& state) {
  const std::string file = test::recordedData("kinect_new_views/dataset.yaml");
  if (file.empty()) return state.SkipWithError("skipped: no kinect_new_views in SKS_DATA");
  const DataSet data_set = loadDataSet(file);
  const Settings settings = publishedSettings();
  const auto codebook = std::make_shared<const Codebook>(train(trainingSamples(data_set), settings, data_set.name));
  const Detector detector(codebook, settings);
  const PclPipeline pcl_pipeline(*codebook, settings, threads);
  std::vector<Cloud> clouds;
  std::vector<pcl::PointCloud<pcl::PointXYZ>::Ptr> pcl_clouds;
  for (std::size_t i = 0; i < std::min(scene_count, data_set.scenes.size()); ++i) {
    clouds.push_back(readCloud(data_set.scenes[i].path, data_set.scale));
    pcl_clouds.push_back(test::pclPoints(clouds.back().points));
  }
  compare(
      state,
      [&] {
        for (const auto& cloud : pcl_clouds) benchmark::DoNotOptimize(pcl_pipeline.detect(cloud));
      },
      [&] {
        for (const Cloud& cloud : clouds) benchmark::DoNotOptimize(detector.detect(cloud));
      },
      10, 3);
  state.SetLabel(std::to_string(clouds.size()) + " scenes");
}

BENCHMARK(pipeline)->Apply(asPair);

}  // namespace
}  // namespace sks::bench
