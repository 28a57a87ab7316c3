// SPDX-License-Identifier: BSD-3-Clause
// The one source of every default, range, unit and help text: command line, YAML files, dynamic_reconfigure, the
// codebook file and the documentation are all fed from the visit() functions below.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace sks {

enum class DescriptorType { automatic, shot, cshot };
enum class KeypointDetector { grid, iss };
enum class SelectionRule { rank, threshold, histogram };
enum class Hypotheses { verified, hough };
enum class RegisterViews { automatic, on, off };
enum class ModelOrigin { automatic, base, center, first };

/// Names of an enumeration's values, in their order.
template <typename Enum>
struct EnumNames;
template <>
struct EnumNames<DescriptorType> {
  static constexpr std::array<const char*, 3> value{"auto", "shot", "cshot"};
};
template <>
struct EnumNames<KeypointDetector> {
  static constexpr std::array<const char*, 2> value{"grid", "iss"};
};
template <>
struct EnumNames<SelectionRule> {
  static constexpr std::array<const char*, 3> value{"rank", "threshold", "histogram"};
};
template <>
struct EnumNames<Hypotheses> {
  static constexpr std::array<const char*, 2> value{"verified", "hough"};
};
template <>
struct EnumNames<RegisterViews> {
  static constexpr std::array<const char*, 3> value{"auto", "true", "false"};
};
template <>
struct EnumNames<ModelOrigin> {
  static constexpr std::array<const char*, 4> value{"auto", "base", "center", "first"};
};

/// Closed range of a number.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Whether a setting is free at detection or must be the one that the codebook was trained with.
enum class Binding { free, codebook };

struct SanitizeSettings {
  double min_range = 0.0;
  double max_range = 20.0;
  bool remove_duplicates = true;
  int min_points = 10;
  bool crop = false;
  double crop_min_x = -10.0, crop_min_y = -10.0, crop_min_z = -10.0;
  double crop_max_x = 10.0, crop_max_y = 10.0, crop_max_z = 10.0;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.min_range, "min_range", Range{0, 100}, "m",
      "points nearer to the sensor than this are dropped, for example those of the robot's own gripper; 0: none");
    v(s.max_range, "max_range", Range{0.01, 1000}, "m",
      "points farther from the sensor than this are dropped; smaller: faster, but objects farther away are not found");
    v(s.remove_duplicates, "remove_duplicates", "drop each point that has exactly the position of an earlier one");
    v(s.min_points, "min_points", Range{1, 1000000}, "",
      "a cloud with fewer usable points is refused with an error; larger: clouds that are nearly empty are reported");
    v(s.crop, "crop", "keep only the points inside the box from crop_min to crop_max");
    const Range box{-1000, 1000};
    const char* lowest = "with crop: points with a lower value of this coordinate are dropped; frame of the cloud";
    const char* highest = "with crop: points with a higher value of this coordinate are dropped; frame of the cloud";
    v(s.crop_min_x, "crop_min_x", box, "m", lowest);
    v(s.crop_min_y, "crop_min_y", box, "m", lowest);
    v(s.crop_min_z, "crop_min_z", box, "m", lowest);
    v(s.crop_max_x, "crop_max_x", box, "m", highest);
    v(s.crop_max_y, "crop_max_y", box, "m", highest);
    v(s.crop_max_z, "crop_max_z", box, "m", highest);
  }
};

struct SurfaceSettings {
  double resolution = 0.0;
  double spacing_at_1m = 0.004;
  double normal_radius = 0.01;
  int normal_min_neighbors = 5;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.resolution, "resolution", Range{0, 0.1}, "m",
      "the cloud is thinned to one point for each cube with this edge; larger: faster, but small details are lost; "
      "0: the cloud is not thinned",
      Binding::codebook);
    v(s.spacing_at_1m, "spacing_at_1m", Range{0, 0.1}, "m",
      "a scene that is an image of a camera is thinned, once its normals are estimated from all points, to about this "
      "distance between points at a range of 1 m, or where nine tenths of it are farther, at that range; larger: "
      "faster, but small, thin and distant objects are lost; 0, or a sensor that measures no more densely: all points "
      "are kept");
    v(s.normal_radius, "normal_radius", Range{0.0005, 0.2}, "m",
      "a normal is estimated from the points within this radius; larger: less disturbed by sensor noise, but edges and "
      "small details become blurred",
      Binding::codebook);
    v(s.normal_min_neighbors, "normal_min_neighbors", Range{3, 1000}, "",
      "points with fewer neighbours within normal_radius get no normal; larger: sparse parts of the cloud, whose "
      "normals are unreliable, are not used",
      Binding::codebook);
  }
};

struct KeypointSettings {
  KeypointDetector detector = KeypointDetector::grid;
  double grid_size = 0.02;
  SelectionRule selection = SelectionRule::rank;
  double discard = 0.35;
  double curvature_threshold = 0.001;
  bool skip_planes = true;
  double iss_salient_radius = 0.02;
  double iss_suppression_radius = 0.01;
  double iss_gamma_21 = 0.975;
  double iss_gamma_32 = 0.975;
  int iss_min_neighbors = 5;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.detector, "detector",
      "where keypoints are placed. grid: at the centroid of the points in each cell of a voxel grid; iss: where the "
      "surface varies in all directions (Intrinsic Shape Signatures)");
    v(s.grid_size, "grid_size", Range{0.001, 0.5}, "m",
      "edge of a cell of the voxel grid, and radius of the surface whose curvature is computed; smaller: more "
      "keypoints, so small objects are found better, but slower");
    v(s.selection, "selection",
      "which keypoints of a scene are kept. rank: the fraction with the highest Gaussian curvature, see discard; "
      "threshold: all above curvature_threshold; histogram: all above a threshold that Otsu's method chooses for each "
      "scene");
    v(s.discard, "discard", Range{0, 0.99}, "",
      "fraction of a scene's keypoints that selection by rank drops, those with the lowest Gaussian curvature; "
      "larger: faster, but flat and small objects are missed; 0: all keypoints are kept");
    v(s.curvature_threshold, "curvature_threshold", Range{0, 1}, "",
      "lowest Gaussian curvature that selection by threshold keeps; larger: fewer keypoints, faster, but flat objects "
      "are missed");
    v(s.skip_planes, "skip_planes",
      "drop keypoints on planes that are larger than every object, such as tables and walls: faster, and they would "
      "confirm no pose. Only used where detection.hypotheses is verified");
    v(s.iss_salient_radius, "iss_salient_radius", Range{0.001, 0.5}, "m",
      "ISS: the variation of the surface is computed within this radius; larger: keypoints at larger structures");
    v(s.iss_suppression_radius, "iss_suppression_radius", Range{0.001, 0.5}, "m",
      "ISS: of keypoints within this radius only the one with the strongest variation stays; larger: fewer keypoints");
    v(s.iss_gamma_21, "iss_gamma_21", Range{0, 1}, "",
      "ISS: highest ratio of the second to the first eigenvalue of the points around a keypoint; smaller: fewer "
      "keypoints");
    v(s.iss_gamma_32, "iss_gamma_32", Range{0, 1}, "",
      "ISS: highest ratio of the third to the second eigenvalue of the points around a keypoint; smaller: fewer "
      "keypoints");
    v(s.iss_min_neighbors, "iss_min_neighbors", Range{1, 1000}, "",
      "ISS: points with fewer neighbours are no keypoints; larger: fewer keypoints in sparse parts of the cloud");
  }
};

struct DescriptorSettings {
  DescriptorType type = DescriptorType::automatic;
  double radius = 0.05;
  double model_facing = 0.0;
  int min_neighbors = 5;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.type, "type",
      "what a descriptor describes. shot: shape; cshot: shape and colour; auto: cshot where all training clouds have "
      "colour and come from a camera, else shot: the colours of a mesh are not the camera's",
      Binding::codebook);
    v(s.radius, "radius", Range{0.002, 1}, "m",
      "radius of the surface around a keypoint that its descriptor and its local reference frame describe; larger: "
      "different objects are told apart better, but clutter and occlusion disturb more, and it is slower",
      Binding::codebook);
    v(s.model_facing, "model_facing", Range{-1, 1}, "",
      "training on full models: a descriptor takes only points whose normal has at least this cosine with the normal "
      "of its keypoint, because a camera cannot see the far side; larger: fewer points are taken; -1: all are taken",
      Binding::codebook);
    v(s.min_neighbors, "min_neighbors", Range{5, 10000}, "",
      "keypoints with fewer points within radius get no descriptor; larger: sparse parts of the cloud are not used");
  }
};

struct MatchingSettings {
  double ambiguity = 1.3;
  bool background = true;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.ambiguity, "ambiguity", Range{1, 10}, "",
      "a descriptor votes for the nearest codeword of each object whose distance is at most this factor times the "
      "distance of the nearest of all codewords, with less weight the farther it is; larger: objects that look alike "
      "are confused less, but slower; 1: only the nearest codeword, as published. It counts as 1 in scenes where "
      "detection.hypotheses is hough");
    v(s.background, "background",
      "descriptors of common shapes (boxes, cans, bottles, balls) compete with the codewords: what resembles them more "
      "than an object votes less for it, so that a codebook of one object is not fooled by everything else; false: "
      "faster. Only used with shot, where detection.hypotheses is verified");
  }
};

struct VotingSettings {
  double bandwidth = 0.03;
  int max_iterations = 100;
  double tolerance = 1e-5;
  double suppression_radius = 0.05;
  int min_votes = 3;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.bandwidth, "bandwidth", Range{0.001, 1}, "m",
      "bandwidth h of mean shift and of the density of votes (eq. 3): votes about this near to each other support each "
      "other; larger: inexact votes still meet, but objects that stand close together merge");
    v(s.max_iterations, "max_iterations", Range{1, 10000}, "",
      "most steps of mean shift from each start; smaller: faster, but maxima may be found inexactly");
    v(s.tolerance, "tolerance", Range{1e-9, 0.01}, "m",
      "mean shift stops at a step shorter than this; smaller: maxima are found more exactly, but slower");
    v(s.suppression_radius, "suppression_radius", Range{0, 1}, "m",
      "of two hypotheses for one object whose positions are nearer to each other than this, the weaker one is dropped; "
      "larger: no object is found twice, but two of a kind that touch are found as one");
    v(s.min_votes, "min_votes", Range{1, 1000}, "",
      "maxima with fewer votes are dropped; larger: fewer false detections, but objects of which little is seen are "
      "missed");
  }
};

struct RansacSettings {
  double inlier_threshold = 0.025;
  int iterations = 200;
  int min_inliers = 3;
  int seed = 1;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.inlier_threshold, "inlier_threshold", Range{0.0005, 0.5}, "m",
      "a correspondence is an inlier of a pose that brings its two points within this distance; larger: inexact "
      "correspondences count, but so do more wrong ones");
    v(s.iterations, "iterations", Range{1, 100000}, "",
      "most poses that RANSAC tries for one maximum of the votes; larger: the best one is found more surely, but "
      "slower");
    v(s.min_inliers, "min_inliers", Range{1, 1000}, "",
      "hypotheses with fewer inliers are dropped; larger: fewer false detections, but objects of which little is seen "
      "are missed");
    v(s.seed, "seed", Range{0, 2147483647}, "",
      "start of the random numbers; the same seed gives the same result, another one a slightly different result");
  }
};

struct RefinementSettings {
  int iterations = 12;
  double start_distance = 0.02;
  double end_distance = 0.005;
  int max_points = 250;
  double min_density = 3.0;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.iterations, "iterations", Range{0, 1000}, "",
      "rounds of ICP that fit the stored surface of an object to the scene; larger: more exact poses, but slower; 0: "
      "poses are not refined");
    v(s.start_distance, "start_distance", Range{0.0005, 0.5}, "m",
      "in the first round of ICP points up to this distance are paired; larger: poses that are farther off can be "
      "corrected, but neighbouring objects disturb more");
    v(s.end_distance, "end_distance", Range{0.0005, 0.5}, "m",
      "in the last round of ICP points up to this distance are paired; smaller: more exact, but too few pairs where "
      "the sensor is noisy");
    v(s.max_points, "max_points", Range{10, 1000000}, "",
      "most points of the stored surface that ICP uses, spread evenly; larger: more exact poses, but slower");
    v(s.min_density, "min_density", Range{0, 10000}, "votes",
      "where detection.hypotheses is hough, only hypotheses of at least this density are refined; larger: faster, but "
      "the poses of weak hypotheses are less exact");
  }
};

struct VerificationSettings {
  int candidates = 120;
  int total_candidates = 960;
  double support_distance = 0.008;
  double support_angle = 0.45;
  double occlusion_distance = 0.015;
  double color_tolerance = 20;
  double half_evidence = 1.7;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.candidates, "candidates", Range{1, 1000}, "",
      "most poses of each object that are refined and compared with the scene; larger: more objects are found in "
      "clutter, but slower. Only used where detection.hypotheses is verified");
    v(s.total_candidates, "total_candidates", Range{1, 1000000}, "",
      "most poses of all objects together that are refined and compared with the scene: with many objects each gets an "
      "equal share, but at least a quarter of `candidates`; larger: more of many objects are found in clutter, but "
      "slower");
    v(s.support_distance, "support_distance", Range{0.0005, 0.1}, "m",
      "a point of the stored surface is confirmed by a scene point within this distance whose normal agrees, see "
      "support_angle; larger: noisy and inexact surfaces are confirmed, but so are more wrong poses");
    v(s.support_angle, "support_angle", Range{0.01, 1.5}, "rad",
      "largest angle between the normals of a point of the stored surface and of the scene point that confirms it; "
      "larger: noisy surfaces are confirmed, but so are more wrong poses");
    v(s.occlusion_distance, "occlusion_distance", Range{0.0005, 0.5}, "m",
      "a point of the stored surface is occluded, which counts neither for nor against a pose, where it is more than "
      "this behind what the sensor saw; nearer, and not confirmed, it contradicts the pose; larger: more wrong poses "
      "are refused, but also right ones of objects that are partly occluded");
    v(s.color_tolerance, "color_tolerance", Range{0, 1000}, "CIELab",
      "where codebook and scene have colour: difference in colour at which a scene point confirms a point of the "
      "stored surface with only 0.6 of its weight; the weight falls further with larger differences (lightness counts "
      "half). Larger: other light is tolerated, but objects of one shape are confused; 0: colours are not compared");
    v(s.half_evidence, "half_evidence", Range{0.001, 1000}, "",
      "evidence for a pose (docs/method.md) that gives the score 0.5; larger: all scores are lower. Only used where "
      "detection.hypotheses is verified");
  }
};

struct DetectionSettings {
  Hypotheses hypotheses = Hypotheses::verified;
  double threshold = 0.5;
  std::string thresholds;
  double half_density = 8.0;
  int max_per_object = 20;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.hypotheses, "hypotheses",
      "where the poses of detections in scenes come from. verified: from single correspondences, refined and compared "
      "with the stored surface; finds more with fewer false detections. hough: from the maxima of the votes that pass "
      "RANSAC, scored by their votes alone, as published");
    v(s.threshold, "threshold", Range{0, 1}, "",
      "lowest score of a detection that is reported; larger: fewer false detections, but more objects are missed");
    v(s.thresholds, "thresholds",
      "lowest scores of single objects in place of threshold, for example mug=0.7,box=0.4; names of objects that the "
      "codebook does not hold do nothing. Empty: threshold holds for all");
    v(s.half_density, "half_density", Range{0.001, 10000}, "votes",
      "density of the inliers' votes that gives the score 0.5 to an object whose training view has 270 codewords; it "
      "is "
      "less for smaller ones. Larger: all scores are lower. Only used where hypotheses is hough");
    v(s.max_per_object, "max_per_object", Range{1, 1000}, "",
      "most detections of one object in one scene, the best ones; smaller: faster, but of many equal objects some are "
      "missed");
  }
};

struct TrainingSettings {
  double surface_resolution = 0.005;
  RegisterViews register_views = RegisterViews::automatic;
  ModelOrigin origin = ModelOrigin::automatic;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.surface_resolution, "surface_resolution", Range{0.001, 0.1}, "m",
      "the surface of each training view is stored with one point for each cube with this edge; smaller: poses are "
      "verified in more detail, but codebooks are larger and detection is slower");
    v(s.register_views, "register_views",
      "whether the captured views of an object are registered to each other, so that its detections have one frame and "
      "one box, whichever view matched; views that cannot be tied to the others keep frames of their own, with a "
      "warning. Training takes longer. auto: objects of whose views the supporting plane is known, as ~capture_view "
      "stores it; true: all; false: each view has its own frame, that of its camera");
    v(s.origin, "origin",
      "origin of the frame of registered views. base: below the middle of the object's box, on the plane that it stood "
      "on; center: in the middle of its box; both follow the box while added views show more of the object. first: it "
      "stays when views are added: below the middle of what the first view shows, or in its middle where no plane is "
      "known. auto: base where the plane is known, else center");
  }
};

struct TrackerSettings {
  double redetect = 2.0;
  double max_age = 2.0;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.redetect, "redetect", Range{0.1, 3600}, "s",
      "while objects are followed, the rest of the scene is searched for new ones this often, and when one is lost; "
      "smaller: what is new is found sooner, but less of the processor is left");
    v(s.max_age, "max_age", Range{0.1, 60}, "s",
      "an object that was not seen for so long is no longer followed; larger: it keeps its identity while it is hidden "
      "for longer, but is remembered where it may be gone");
  }
};

/// Everything that can be set. Groups are the first part of a key: `keypoints.discard`.
struct Settings {
  SanitizeSettings sanitize;
  SurfaceSettings surface;
  KeypointSettings keypoints;
  DescriptorSettings descriptor;
  MatchingSettings matching;
  VotingSettings voting;
  RansacSettings ransac;
  RefinementSettings refinement;
  VerificationSettings verification;
  DetectionSettings detection;
  TrackerSettings tracker;
  TrainingSettings training;
  int threads = 0;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v.group("sanitize", s.sanitize);
    v.group("surface", s.surface);
    v.group("keypoints", s.keypoints);
    v.group("descriptor", s.descriptor);
    v.group("matching", s.matching);
    v.group("voting", s.voting);
    v.group("ransac", s.ransac);
    v.group("refinement", s.refinement);
    v.group("verification", s.verification);
    v.group("detection", s.detection);
    v.group("tracker", s.tracker);
    v.group("training", s.training);
    v(s.threads, "threads", Range{0, 256}, "",
      "threads for training and detection; smaller: slower, but more of the processor is left to other programs; 0: "
      "one for each core");
  }
};

/// What a front end needs to know about one setting.
struct SettingInfo {
  std::string key;            ///< dotted, e.g. "keypoints.discard"
  std::string type;           ///< "double", "int", "bool", "choice" or "string"
  std::string default_value;  ///< as getSetting() would print it
  Range range;                ///< of numbers
  std::string unit;           ///< "m", or empty for a plain number
  std::string help;
  std::vector<std::string> choices;  ///< of a choice
  Binding binding = Binding::free;
};

/// All settings in the order of the stages.
const std::vector<SettingInfo>& settingInfos();

// Old names of settings are still understood by the functions below: `verification.ambiguity` (now
// `matching.ambiguity`), `verification.skip_planes` (`keypoints.skip_planes`) and `verification.candidates` with the
// value 0 (`detection.hypotheses` with the value `hough`).

/// The value of one setting as text that setSetting() takes back unchanged. @throws Error(bad_usage) for an unknown key
std::string getSetting(const Settings& settings, const std::string& key);

/// Sets one setting from text.
/// @param warnings takes a message if `key` is an old name; may be null
/// @throws Error(bad_usage) naming the nearest known key, or the type, range and unit; the old value then stays
void setSetting(Settings& settings, const std::string& key, const std::string& value,
                std::vector<std::string>* warnings = nullptr);

/// Checks each range, and what must hold between settings. @throws Error(bad_usage) naming keys and values
void validate(const Settings& settings);

/// The keys bound to the codebook (Binding::codebook) in which the two differ.
std::vector<std::string> bindingConflicts(const Settings& codebook, const Settings& wanted);

/// The known key that is nearest to a misspelt one, by edit distance; empty where none is near.
std::string nearestSettingKey(const std::string& key);

/// `settings.threads`, 0 replaced by the number of cores; at most so many, or 16 if that is more.
int threadCount(const Settings& settings);

}  // namespace sks
