// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/methods.hpp"

#include <algorithm>
#include <utility>

#include <pcl/console/print.h>

#include "baselines/group_classifier.hpp"
#include "baselines/scene_detector.hpp"
#include "baselines/shape_model_classifier.hpp"
#include "baselines/weighted_voting_classifier.hpp"

namespace sks::baselines {
namespace {

const char* const isolated_only = "it says what an isolated object is, but has no pose: use sks classify";

/// A function that keeps what it calls.
template <typename Maker, typename... Arguments>
ClassifyFunction classifyWith(ViewKind kind, Arguments&&... arguments) {
  const auto classifier = std::make_shared<const Maker>(std::forward<Arguments>(arguments)...);
  return [=](const Cloud& cloud) { return classifier->classify(cloud, kind); };
}

/// PCL would report on stderr each group in which nothing agrees.
void silencePcl() {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
}

Grouping groupingOf(const std::string& name, const Settings& settings, const MethodSettings& own) {
  if (name == "tombari") return houghGrouping(own.tombari);
  if (name == "zhou") return selfAdaptedGrouping(own.zhou, settings.ransac, settings.keypoints.grid_size);
  return consistencyGrouping(own.chen);
}

double halfSupport(const std::string& name, const MethodSettings& own) {
  if (name == "tombari") return own.tombari.half_inliers;
  if (name == "aldoma") return own.aldoma.half_inliers;
  return name == "zhou" ? own.zhou.half_inliers : own.chen.half_inliers;
}

HypothesisCheck checkOf(const std::string& name, const std::shared_ptr<const Codebook>& codebook,
                        const Settings& settings, const MethodSettings& own) {
  const int threads = threadCount(settings);
  if (name == "aldoma") return globalVerification(codebook, own.aldoma, settings.refinement, threads);
  if (name == "zhou") return doubleValidation(codebook, own.zhou, settings.refinement, threads);
  return {};
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> list{
      {"tombari", {"tombari"}, "", "", "discrete 3-D Hough voting with local frames"},
      {"chen", {"chen"}, "", "", "geometrically consistent correspondences"},
      {"aldoma",
       {"chen", "aldoma"},
       "",
       "without its verification, which isolated objects are not put to, it is chen: use --method chen",
       "the hypotheses of chen, ICP and global verification"},
      {"zhou", {"zhou"}, "", "", "self-adapted thresholds, RANSAC and ICP twice"},
      {"knopp", {"knopp"}, isolated_only, "", "implicit shape model (sks classify only)"},
      {"seib", {"seib"}, isolated_only, "", "continuous voting, weighted (sks classify only)"},
  };
  return list;
}

const Method* findMethod(const std::string& name) {
  const auto found =
      std::find_if(methods().begin(), methods().end(), [&](const Method& method) { return method.name == name; });
  return found == methods().end() ? nullptr : &*found;
}

DetectFunction makeDetect(const std::string& name, const std::shared_ptr<const Codebook>& codebook,
                          const Settings& settings, const MethodSettings& own) {
  silencePcl();
  const auto detector =
      std::make_shared<const SceneDetector>(codebook, settings, groupingOf(name, settings, own),
                                            checkOf(name, codebook, settings, own), halfSupport(name, own));
  return [=](const Cloud& cloud) { return detector->detect(cloud); };
}

ClassifyFunction makeClassify(const std::string& name, const std::shared_ptr<const Codebook>& codebook,
                              const Settings& settings, const MethodSettings& own, ViewKind kind) {
  silencePcl();
  if (name == "knopp") return classifyWith<ShapeModelClassifier>(kind, codebook, settings, own.knopp);
  if (name == "seib") return classifyWith<WeightedVotingClassifier>(kind, codebook, settings, own.seib);
  return classifyWith<GroupClassifier>(kind, codebook, settings, groupingOf(name, settings, own));
}

}  // namespace sks::baselines
