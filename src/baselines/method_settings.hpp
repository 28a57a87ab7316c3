// SPDX-License-Identifier: BSD-3-Clause
// What only the baselines can be set to; the stages that they share with the detector are set by sks::Settings. As
// there, the visit() functions are the one source of defaults, ranges, units and help texts.
#pragma once

#include <string>
#include <vector>

#include <sks_detector/settings.hpp>

#include "core/settings/settings_table.hpp"

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
    v(s.bin_size, "bin_size", Range{0.001, 1}, "m",
      "edge of a bin of the Hough space, and inlier threshold of RANSAC; larger: inexact votes still meet, but objects "
      "that stand close together merge");
    v(s.votes, "votes", Range{1, 10000}, "",
      "fewest votes in a bin that make a hypothesis; larger: fewer false detections, but more objects are missed");
    v(s.interpolate, "interpolate", "spread each vote over the neighbouring bins");
    v(s.weigh, "weigh", "give votes of nearer descriptors more weight");
    v(s.half_inliers, "half_inliers", Range{0.001, 10000}, "",
      "number of inliers that gives the score 0.5; larger: all scores are lower");
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
      "correspondences are grouped where their distances in model and scene differ by less than this; larger: larger "
      "groups, but with more wrong correspondences");
    v(s.consensus, "consensus", Range{3, 10000}, "",
      "fewest correspondences in a group that make a hypothesis; larger: fewer false detections, but more objects are "
      "missed");
    v(s.half_inliers, "half_inliers", Range{0.001, 10000}, "",
      "number of inliers that gives the score 0.5; larger: all scores are lower");
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
    v(s.hypotheses, "hypotheses", Range{1, 10000}, "",
      "most hypotheses that are verified, those with most inliers; larger: more objects are found, but slower");
    v(s.resolution, "resolution", Range{0.001, 0.1}, "m",
      "scene and models are thinned to one point for each cube with this edge; smaller: more exact, but slower");
    v(s.inlier_distance, "inlier_distance", Range{0.001, 0.2}, "m",
      "a scene point within this distance of a model point is explained by the model; larger: inexact poses are "
      "accepted");
    v(s.occlusion_distance, "occlusion_distance", Range{0.0005, 0.5}, "m",
      "model points more than this behind the scene's surface are occluded and cost nothing; larger: more of them "
      "count as visible");
    v(s.outlier_weight, "outlier_weight", Range{0, 1000}, "",
      "cost of a visible model point without scene points near it; larger: fewer hypotheses are accepted");
    v(s.clutter_weight, "clutter_weight", Range{0, 1000}, "",
      "cost of an unexplained scene point on the same smooth surface as an explained one; larger: fewer hypotheses "
      "that "
      "cover only a part of a surface are accepted");
    v(s.clutter_radius, "clutter_radius", Range{0.001, 1}, "m",
      "an unexplained scene point costs clutter_weight only within this distance of an explained one; larger: more of "
      "them cost");
    v(s.normal_radius, "normal_radius", Range{0.001, 0.2}, "m",
      "normals of the thinned scene are estimated from the points within this radius; larger: less disturbed by noise, "
      "but edges become blurred");
    v(s.annealing_steps, "annealing_steps", Range{1, 100000}, "",
      "steps of the simulated annealing that chooses the hypotheses, and its first temperature; larger: the best "
      "choice "
      "is found more surely, but slower");
    v(s.half_inliers, "half_inliers", Range{0.001, 10000}, "",
      "number of inliers of an accepted hypothesis that gives the score 0.5; larger: all scores are lower");
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
    v(s.bin_size, "bin_size", Range{0.001, 1}, "m",
      "edge of a bin of the Hough space; larger: inexact votes still meet, but objects that stand close together "
      "merge");
    v(s.peak_share, "peak_share", Range{0.01, 1}, "",
      "a bin makes a hypothesis if it has at least this fraction of the votes of the model's highest bin; larger: "
      "fewer "
      "hypotheses");
    v(s.votes, "votes", Range{1, 10000}, "",
      "fewest votes in a bin that make a hypothesis, whatever the highest bin has; larger: fewer hypotheses");
    v(s.first_spacings, "first_spacings", Range{0.01, 100}, "",
      "inlier threshold of the first RANSAC, as a multiple of the spacing of the model's keypoints; larger: inexact "
      "correspondences count, but so do more wrong ones");
    v(s.second_spacings, "second_spacings", Range{0.01, 100}, "",
      "inlier threshold of the second RANSAC, which works on the inliers of the first, as a multiple of the same "
      "spacing");
    v(s.first_support, "first_support", Range{0, 1}, "",
      "after the first ICP, hypotheses are dropped of whose surface that faces the sensor a lower fraction lies at "
      "scene points, see support_distance; larger: fewer false detections, but occluded objects are missed");
    v(s.second_support, "second_support", Range{0, 1}, "", "the same fraction after the second ICP");
    v(s.support_distance, "support_distance", Range{0.0005, 0.2}, "m",
      "a point of a model's surface lies at the scene if a scene point is within this distance; larger: inexact poses "
      "are accepted");
    v(s.half_inliers, "half_inliers", Range{0.001, 10000}, "",
      "number of inliers, times the fraction of the surface at scene points, that gives the score 0.5; larger: all "
      "scores are lower");
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
    v(s.clusters, "clusters", Range{1, 100000}, "",
      "number of visual words into which the descriptors are clustered; larger: words tell more shapes apart, but each "
      "stands for fewer of them, and it is slower");
    v(s.sigma, "sigma", Range{0.001, 1}, "m",
      "width of the kernel of a vote; larger: inexact votes support each other, but so do more wrong ones");
    v(s.learning_sigma, "learning_sigma", Range{0.001, 100}, "m",
      "how far apart the positions may be to which a word pointed in training before its votes lose weight; larger: "
      "fewer lose weight, at last none");
    v(s.vote_weight, "vote_weight",
      "divide the weight of a word's votes by their number, so that common words count no more than rare ones (eq. 4 "
      "of "
      "that paper)");
  }
};

/// Continuous voting with votes weighted by distance ratio (Seib et al. 2015), to classify; how far the ratio may go is
/// `matching.ambiguity`.
struct SeibSettings {
  bool balance = true;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.balance, "balance",
      "divide the density of a class's votes by the root of the number of its codewords: classes with more codewords "
      "get more votes by chance");
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

const SettingsTable<MethodSettings>& methodTable();

/// Overlays a YAML file with settings of the detector and of methods. @throws like loadSettings()
void loadMethodSettings(const std::string& path, Settings& settings, MethodSettings& own,
                        std::vector<std::string>* warnings = nullptr);

}  // namespace sks::baselines
