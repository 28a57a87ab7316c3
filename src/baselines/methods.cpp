// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/methods.hpp"

#include <algorithm>
#include <utility>

#include <pcl/console/print.h>

#include "baselines/grouping_verifier.hpp"
#include "baselines/nearest_matches.hpp"
#include "baselines/object_strengths.hpp"
#include "baselines/scene_detector.hpp"
#include "core/pipeline/default_stages.hpp"

namespace sks::baselines {
namespace {

const char* const isolated_only = "it says what an isolated object is, but has no pose: use sks classify";

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
      {"knopp", {"knopp"}, isolated_only, "", "implicit shape model"},
      {"seib", {"seib"}, isolated_only, "", "continuous voting, weighted"},
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
  Stages stages;
  stages.verifier = std::make_shared<const GroupingVerifier>(
      *codebook, groupingOf(name, settings, own), checkOf(name, codebook, settings, own), halfSupport(name, own));
  const auto detector = std::make_shared<const SceneDetector>(codebook, settings, stages);
  return [=](const Cloud& cloud) { return detector->detect(cloud); };
}

ClassifyFunction makeClassify(const std::string& name, const std::shared_ptr<const Codebook>& codebook,
                              const Settings& settings, const MethodSettings& own, ViewKind kind) {
  if (name == "seib") {  // this package's own, with a balance to be set
    const ClassBalance balance = own.seib.balance ? ClassBalance::codewords : ClassBalance::none;
    const auto classifier = std::make_shared<const Classifier>(codebook, settings, balance);
    return [=](const Cloud& cloud) { return classifier->classify(cloud, kind); };
  }
  silencePcl();
  SceneDescriber describer{codebook, settingsFor(*codebook, settings), completed({}, *codebook), {}};
  StrengthFunction strengths;
  if (name == "knopp") {
    describer.match = [](const DescriptorMatrix&, int) { return std::vector<Match>(); };
    strengths = shapeModelStrengths(*codebook, describer.settings, own.knopp);
  } else {
    describer.match = nearestMatches(*codebook);
    strengths = groupStrengths(codebook, groupingOf(name, settings, own), threadCount(describer.settings));
  }
  return [=](const Cloud& cloud) { return classifyIsolated(cloud, kind, describer, strengths); };
}

}  // namespace sks::baselines
