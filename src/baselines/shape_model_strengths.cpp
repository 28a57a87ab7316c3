// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/shape_model_classifier.hpp"

#include <algorithm>
#include <utility>

#include "baselines/pcl_shape_model.hpp"
#include "core/scene_description.hpp"
#include "core/stopwatch.hpp"

namespace sks::baselines {
namespace {

/// Keypoints and their descriptors as PCL takes them.
struct DescribedCloud {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points{new pcl::PointCloud<pcl::PointXYZ>};
  pcl::PointCloud<pcl::Normal>::Ptr normals{new pcl::PointCloud<pcl::Normal>};

  void add(const Eigen::Vector3f& position, const Eigen::Matrix3f& frame, std::uint32_t row) {
    points->push_back(pcl::PointXYZ(position.x(), position.y(), position.z()));
    normals->push_back(describedNormal(frame, row));
  }
};

/// PCL thins clouds to a grid: this one is so fine that it leaves the keypoints alone.
float samplingSize(const Settings& settings) {
  return float(settings.keypoints.grid_size / 8);
}

/// An estimation for one thread.
ShapeModelEstimation makeEstimation(const Settings& settings, const KnoppSettings& own, const DescriptorMatrix& rows) {
  ShapeModelEstimation estimation;
  ShapeModelEstimation::FeaturePtr feature(new StoredDescriptors);
  static_cast<StoredDescriptors&>(*feature).setRows(rows);
  estimation.setFeatureEstimator(feature);
  estimation.setSamplingSize(samplingSize(settings));
  estimation.setNumberOfClusters(unsigned(own.clusters));
  estimation.setNVotState(own.vote_weight);
  return estimation;
}

}  // namespace

struct ShapeModelClassifier::ShapeModel {
  pcl::features::ISMModel::Ptr trained{new pcl::features::ISMModel};
};

ShapeModelClassifier::ShapeModelClassifier(std::shared_ptr<const Codebook> codebook, const Settings& settings,
                                           const KnoppSettings& own)
    : codebook_(std::move(codebook)), settings_(settingsFor(*codebook_, settings)), own_(own) {
  own_.clusters = std::min(own_.clusters, int(codebook_->words.size()));
  std::vector<DescribedCloud> views(codebook_->views.size());
  for (std::uint32_t i = 0; i < codebook_->words.size(); ++i) {
    views[codebook_->words[i].view].add(codebook_->words[i].position, codebook_->words[i].frame, i);
  }
  std::vector<pcl::PointCloud<pcl::PointXYZ>::Ptr> clouds;
  std::vector<pcl::PointCloud<pcl::Normal>::Ptr> normals;
  std::vector<unsigned int> classes;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].points->empty()) continue;
    clouds.push_back(views[i].points);
    normals.push_back(views[i].normals);
    classes.push_back(codebook_->views[i].object);
  }
  ShapeModelEstimation estimation = makeEstimation(settings_, own_, codebook_->descriptors);
  estimation.setTrainingClouds(clouds);
  estimation.setTrainingNormals(normals);
  estimation.setTrainingClasses(classes);
  estimation.setSigmaDists(std::vector<float>(codebook_->objects.size(), float(own_.learning_sigma)));
  auto model = std::make_unique<ShapeModel>();
  estimation.trainISM(model->trained);
  model_ = std::move(model);
}

ShapeModelClassifier::~ShapeModelClassifier() = default;

Classification ShapeModelClassifier::classify(const Cloud& cloud, ViewKind kind) const {
  Classification result;
  Stopwatch total;
  const Orientation orientation = kind == ViewKind::model ? Orientation::outward : Orientation::sensor;
  const auto no_match = [](const DescriptorMatrix&, int) { return std::vector<Match>(); };
  const SceneDescription scene =
      describeScene(cloud, orientation, *codebook_, no_match, settings_, result.times, result.counts);

  Stopwatch stage;
  DescribedCloud described;
  for (std::size_t row = 0; row < scene.descriptors.keypoints.size(); ++row) {
    described.add(scene.keypoints.positions[scene.descriptors.keypoints[row]], scene.descriptors.frames[row],
                  std::uint32_t(row));
  }
  std::vector<double> strengths(codebook_->objects.size(), 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threadCount(settings_))
  for (std::size_t object = 0; object < strengths.size(); ++object) {
    ShapeModelEstimation estimation = makeEstimation(settings_, own_, scene.descriptors.values);
    const auto votes = estimation.findObjects(model_->trained, described.points, described.normals, int(object));
    std::vector<pcl::ISMPeak, Eigen::aligned_allocator<pcl::ISMPeak>> peaks;
    if (votes->getNumberOfVotes() == 0) continue;
    votes->findStrongestPeaks(peaks, int(object), settings_.voting.suppression_radius, own_.sigma);
    for (const pcl::ISMPeak& peak : peaks) strengths[object] = std::max(strengths[object], peak.density);
  }
  result.candidates = rankedCandidates(codebook_->objects, strengths);
  result.counts.hypotheses = result.candidates.size();
  result.times.voting += stage.lap();
  result.times.total = total.lap();
  return result;
}

}  // namespace sks::baselines
