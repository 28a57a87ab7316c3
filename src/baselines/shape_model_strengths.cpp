// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "baselines/object_strengths.hpp"
#include "baselines/pcl_shape_model.hpp"

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
  auto* const stored = new StoredDescriptors;
  const ShapeModelEstimation::FeaturePtr feature(stored);
  stored->setRows(rows);
  estimation.setFeatureEstimator(feature);
  estimation.setSamplingSize(samplingSize(settings));
  estimation.setNumberOfClusters(unsigned(own.clusters));
  estimation.setNVotState(own.vote_weight);
  return estimation;
}

pcl::features::ISMModel::Ptr trainShapeModel(const Codebook& codebook, const Settings& settings,
                                             const KnoppSettings& own) {
  std::vector<DescribedCloud> views(codebook.views.size());
  for (std::uint32_t i = 0; i < codebook.words.size(); ++i) {
    views[codebook.words[i].view].add(codebook.words[i].position, codebook.words[i].frame, i);
  }
  std::vector<pcl::PointCloud<pcl::PointXYZ>::Ptr> clouds;
  std::vector<pcl::PointCloud<pcl::Normal>::Ptr> normals;
  std::vector<unsigned int> classes;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].points->empty()) continue;
    clouds.push_back(views[i].points);
    normals.push_back(views[i].normals);
    classes.push_back(codebook.views[i].object);
  }
  ShapeModelEstimation estimation = makeEstimation(settings, own, codebook.descriptors.values());
  estimation.setTrainingClouds(clouds);
  estimation.setTrainingNormals(normals);
  estimation.setTrainingClasses(classes);
  estimation.setSigmaDists(std::vector<float>(codebook.objects.size(), float(own.learning_sigma)));
  pcl::features::ISMModel::Ptr model(new pcl::features::ISMModel);
  estimation.trainISM(model);
  return model;
}

DescribedCloud describedCloud(const SceneDescription& scene) {
  DescribedCloud described;
  for (std::size_t row = 0; row < scene.descriptors.keypoints.size(); ++row) {
    described.add(scene.keypoints.positions[scene.descriptors.keypoints[row]], scene.descriptors.frames[row],
                  std::uint32_t(row));
  }
  return described;
}

}  // namespace

StrengthFunction shapeModelStrengths(const Codebook& codebook, const Settings& settings, KnoppSettings own) {
  own.clusters = std::min(own.clusters, int(codebook.words.size()));
  const pcl::features::ISMModel::Ptr model = trainShapeModel(codebook, settings, own);
  return [=, objects = codebook.objects.size()](const SceneDescription& scene) {
    const DescribedCloud described = describedCloud(scene);
    ObjectStrengths strengths{std::vector<double>(objects, 0), 0};
#pragma omp parallel for schedule(dynamic, 1) num_threads(threadCount(settings))
    for (std::size_t object = 0; object < objects; ++object) {
      ShapeModelEstimation estimation = makeEstimation(settings, own, scene.descriptors.values);
      const auto votes = estimation.findObjects(model, described.points, described.normals, int(object));
      if (votes->getNumberOfVotes() == 0) continue;
      std::vector<pcl::ISMPeak, Eigen::aligned_allocator<pcl::ISMPeak>> peaks;
      votes->findStrongestPeaks(peaks, int(object), settings.voting.suppression_radius, own.sigma);
      double& strength = strengths.of_object[object];
      for (const pcl::ISMPeak& peak : peaks) strength = std::max(strength, peak.density);
    }
    strengths.hypotheses = objects - std::size_t(std::count(strengths.of_object.begin(), strengths.of_object.end(), 0));
    return strengths;
  };
}

}  // namespace sks::baselines
