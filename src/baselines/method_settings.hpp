// SPDX-License-Identifier: BSD-3-Clause
// What only the baselines can be set to; the stages that they share with the detector are set by sks::Settings. As
// there, the visit() functions are the one source of defaults, ranges, units and help texts.
#pragma once

#include <string>
#include <vector>

#include <sks_detector/settings.hpp>

namespace sks::baselines {

/// Discrete 3-D Hough voting (Tombari and Di Stefano 2010).
struct TombariSettings {
  double bin_size = 0.03;
  double votes = 5;
  bool interpolate = true;
  bool weigh = false;
  double half_inliers = 8;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.bin_size, "bin_size", Range{0.001, 1}, "m", "edge of the bins of the Hough space, and of RANSAC's inliers");
    v(s.votes, "votes", Range{1, 10000}, "", "fewest votes of a bin that is a hypothesis");
    v(s.interpolate, "interpolate", "spread each vote over the neighbouring bins");
    v(s.weigh, "weigh", "votes of nearer descriptors weigh more");
    v(s.half_inliers, "half_inliers", Range{0.001, 10000}, "", "inliers that score 0.5");
  }
};

/// Grouping of geometrically consistent correspondences (Chen and Bhanu 2007).
struct ChenSettings {
  double resolution = 0.01;
  int consensus = 4;
  double half_inliers = 8;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.resolution, "resolution", Range{0.0005, 1}, "m",
      "by how much distances within a group may differ between model and scene");
    v(s.consensus, "consensus", Range{3, 10000}, "", "fewest correspondences of a group");
    v(s.half_inliers, "half_inliers", Range{0.001, 10000}, "", "inliers that score 0.5");
  }
};

/// Global hypothesis verification (Aldoma et al. 2012) of the hypotheses of `chen`, after ICP.
struct AldomaSettings {
  int hypotheses = 100;
  double resolution = 0.005;
  double inlier_distance = 0.01;
  double occlusion_distance = 0.015;
  double outlier_weight = 3;
  double clutter_weight = 5;
  double clutter_radius = 0.03;
  double normal_radius = 0.02;
  int annealing_steps = 1000;
  double half_inliers = 4;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.hypotheses, "hypotheses", Range{1, 10000}, "", "most hypotheses, those with most inliers, that are verified");
    v(s.resolution, "resolution", Range{0.001, 0.1}, "m", "scene and models are thinned to cubes of this edge");
    v(s.inlier_distance, "inlier_distance", Range{0.001, 0.2}, "m", "a scene point this near is explained by a model");
    v(s.occlusion_distance, "occlusion_distance", Range{0.0005, 0.5}, "m",
      "model points this far behind the scene's surface are hidden");
    v(s.outlier_weight, "outlier_weight", Range{0, 1000}, "", "what a visible model point without scene points costs");
    v(s.clutter_weight, "clutter_weight", Range{0, 1000}, "",
      "what an unexplained scene point costs that continues the surface of an explained one");
    v(s.clutter_radius, "clutter_radius", Range{0.001, 1}, "m", "how near to an explained point that must be");
    v(s.normal_radius, "normal_radius", Range{0.001, 0.2}, "m", "neighbourhood of the thinned scene's normals");
    v(s.annealing_steps, "annealing_steps", Range{1, 100000}, "",
      "steps of simulated annealing; also the temperature that it starts from");
    v(s.half_inliers, "half_inliers", Range{0.001, 10000}, "", "inliers at which what was accepted scores 0.5");
  }
};

/// Hough voting with self-adapted thresholds, double RANSAC, and ICP twice with validation (Zhou et al. 2018).
struct ZhouSettings {
  double bin_size = 0.03;
  double peak_share = 0.5;
  double votes = 3;
  double first_spacings = 1.5;
  double second_spacings = 0.75;
  double first_support = 0.4;
  double second_support = 0.5;
  double support_distance = 0.008;
  double half_inliers = 4;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.bin_size, "bin_size", Range{0.001, 1}, "m", "edge of the bins of the Hough space");
    v(s.peak_share, "peak_share", Range{0.01, 1}, "",
      "a bin is a hypothesis from this share of the votes of the model's highest bin on");
    v(s.votes, "votes", Range{1, 10000}, "", "fewest votes of a bin, whatever the highest has");
    v(s.first_spacings, "first_spacings", Range{0.01, 100}, "",
      "inlier threshold of the first RANSAC, in spacings of the model's keypoints");
    v(s.second_spacings, "second_spacings", Range{0.01, 100}, "", "the same of the second, among what fits the first");
    v(s.first_support, "first_support", Range{0, 1}, "",
      "lowest share of the model's surface facing the sensor that lies at scene points after the first ICP");
    v(s.second_support, "second_support", Range{0, 1}, "", "the same after the second ICP");
    v(s.support_distance, "support_distance", Range{0.0005, 0.2}, "m", "how near these scene points are");
    v(s.half_inliers, "half_inliers", Range{0.001, 10000}, "", "inliers, times support, that score 0.5");
  }
};

/// Implicit shape model of clustered descriptors (Knopp et al. 2010), to classify.
struct KnoppSettings {
  int clusters = 200;
  double sigma = 0.05;
  double learning_sigma = 1;
  bool vote_weight = true;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.clusters, "clusters", Range{1, 100000}, "", "visual words that the descriptors are clustered to");
    v(s.sigma, "sigma", Range{0.001, 1}, "m", "width of the votes' kernel");
    v(s.learning_sigma, "learning_sigma", Range{0.001, 100}, "m",
      "votes weigh less whose word points to places that differ by this much in training; large: all the same");
    v(s.vote_weight, "vote_weight", "divide by the number of votes that a word casts (eq. 4 of that paper)");
  }
};

/// Continuous voting with votes weighted by distance ratio (Seib et al. 2015), to classify; how far the ratio may go is
/// `verification.ambiguity`.
struct SeibSettings {
  bool balance = true;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.balance, "balance",
      "density over the root of the class's codewords: who has more of them catches more by chance");
  }
};

/// All of them; a key is e.g. `tombari.bin_size`.
struct MethodSettings {
  TombariSettings tombari;
  ChenSettings chen;
  AldomaSettings aldoma;
  ZhouSettings zhou;
  KnoppSettings knopp;
  SeibSettings seib;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v.group("tombari", s.tombari);
    v.group("chen", s.chen);
    v.group("aldoma", s.aldoma);
    v.group("zhou", s.zhou);
    v.group("knopp", s.knopp);
    v.group("seib", s.seib);
  }
};

/// All of them in their order.
const std::vector<SettingInfo>& methodSettingInfos();

/// Whether a key, or the name of a group, is one of these settings' and not the detector's.
bool isMethodSetting(const std::string& key);

/// @throws Error(bad_usage) for an unknown key
std::string getMethodSetting(const MethodSettings& settings, const std::string& key);

/// Sets one from text. @throws Error(bad_usage) naming the nearest known key, or the type, range and unit
void setMethodSetting(MethodSettings& settings, const std::string& key, const std::string& value);

/// Overlays a YAML file with settings of the detector and of methods. @throws like loadSettings()
void loadMethodSettings(const std::string& path, Settings& settings, MethodSettings& own);

}  // namespace sks::baselines
