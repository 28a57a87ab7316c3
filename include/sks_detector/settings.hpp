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
    v(s.min_range, "min_range", Range{0, 100}, "m", "points nearer to the sensor are dropped");
    v(s.max_range, "max_range", Range{0.01, 1000}, "m", "points farther from the sensor are dropped");
    v(s.remove_duplicates, "remove_duplicates", "drop points at exactly the place of an earlier one");
    v(s.min_points, "min_points", Range{1, 1000000}, "", "clouds with fewer usable points are refused");
    v(s.crop, "crop", "keep only points inside the crop box");
    const Range box{-1000, 1000};
    v(s.crop_min_x, "crop_min_x", box, "m", "lower corner of the crop box, cloud frame");
    v(s.crop_min_y, "crop_min_y", box, "m", "lower corner of the crop box, cloud frame");
    v(s.crop_min_z, "crop_min_z", box, "m", "lower corner of the crop box, cloud frame");
    v(s.crop_max_x, "crop_max_x", box, "m", "upper corner of the crop box, cloud frame");
    v(s.crop_max_y, "crop_max_y", box, "m", "upper corner of the crop box, cloud frame");
    v(s.crop_max_z, "crop_max_z", box, "m", "upper corner of the crop box, cloud frame");
  }
};

struct SurfaceSettings {
  double resolution = 0.0;
  double normal_radius = 0.01;
  int normal_min_neighbors = 5;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.resolution, "resolution", Range{0, 0.1}, "m", "the cloud is thinned to one point per cube of this edge; 0: not",
      Binding::codebook);
    v(s.normal_radius, "normal_radius", Range{0.0005, 0.2}, "m", "neighbourhood from which a normal is estimated",
      Binding::codebook);
    v(s.normal_min_neighbors, "normal_min_neighbors", Range{3, 1000}, "", "points with fewer neighbours get no normal",
      Binding::codebook);
  }
};

struct KeypointSettings {
  KeypointDetector detector = KeypointDetector::grid;
  double grid_size = 0.02;
  SelectionRule selection = SelectionRule::rank;
  double discard = 0.5;
  double curvature_threshold = 0.001;
  double iss_salient_radius = 0.02;
  double iss_suppression_radius = 0.01;
  double iss_gamma_21 = 0.975;
  double iss_gamma_32 = 0.975;
  int iss_min_neighbors = 5;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.detector, "detector", "where keypoints lie: voxel grid centroids or ISS");
    v(s.grid_size, "grid_size", Range{0.001, 0.5}, "m", "edge g of the voxel grid; also the radius of a local surface");
    v(s.selection, "selection",
      "which scene keypoints are kept: a share by rank of Gaussian curvature, all above a fixed threshold, or above "
      "Otsu's threshold of its histogram");
    v(s.discard, "discard", Range{0, 0.99}, "",
      "share of the scene keypoints that rank selection drops; 0: no selection");
    v(s.curvature_threshold, "curvature_threshold", Range{0, 1}, "", "lowest Gaussian curvature that threshold keeps");
    v(s.iss_salient_radius, "iss_salient_radius", Range{0.001, 0.5}, "m", "ISS: radius of the scatter matrix");
    v(s.iss_suppression_radius, "iss_suppression_radius", Range{0.001, 0.5}, "m",
      "ISS: radius of non-maxima suppression");
    v(s.iss_gamma_21, "iss_gamma_21", Range{0, 1}, "", "ISS: upper bound of the second over the first eigenvalue");
    v(s.iss_gamma_32, "iss_gamma_32", Range{0, 1}, "", "ISS: upper bound of the third over the second eigenvalue");
    v(s.iss_min_neighbors, "iss_min_neighbors", Range{1, 1000}, "", "ISS: fewest neighbours of a keypoint");
  }
};

struct DescriptorSettings {
  DescriptorType type = DescriptorType::automatic;
  double radius = 0.05;
  double model_facing = 0.0;
  int min_neighbors = 5;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.type, "type", "SHOT (shape), CSHOT (shape and colour), or auto: CSHOT where all training clouds have colour",
      Binding::codebook);
    v(s.radius, "radius", Range{0.002, 1}, "m", "support radius of descriptor and local reference frame",
      Binding::codebook);
    v(s.model_facing, "model_facing", Range{-1, 1}, "",
      "training on full models: only the part of the support whose normals have at least this cosine with the "
      "keypoint's own is described, since a camera cannot see the far side; -1: all of it",
      Binding::codebook);
    v(s.min_neighbors, "min_neighbors", Range{5, 10000}, "", "keypoints with fewer neighbours get no descriptor");
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
    v(s.bandwidth, "bandwidth", Range{0.001, 1}, "m", "bandwidth h of mean shift and density (eq. 3)");
    v(s.max_iterations, "max_iterations", Range{1, 10000}, "", "most mean shift steps of a seed");
    v(s.tolerance, "tolerance", Range{1e-9, 0.01}, "m", "mean shift stops at steps shorter than this");
    v(s.suppression_radius, "suppression_radius", Range{0, 1}, "m",
      "of two maxima of one class nearer than this the weaker is dropped");
    v(s.min_votes, "min_votes", Range{1, 1000}, "", "maxima with fewer votes are dropped");
  }
};

struct RansacSettings {
  double inlier_threshold = 0.025;
  int iterations = 200;
  int min_inliers = 3;
  int seed = 1;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.inlier_threshold, "inlier_threshold", Range{0.0005, 0.5}, "m", "farthest that an inlier pair may lie apart");
    v(s.iterations, "iterations", Range{1, 100000}, "", "most samples of a maximum");
    v(s.min_inliers, "min_inliers", Range{1, 1000}, "", "hypotheses with fewer inliers are dropped");
    v(s.seed, "seed", Range{0, 2147483647}, "", "seed of the samples; same seed, same result");
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
    v(s.iterations, "iterations", Range{0, 1000}, "", "rounds of ICP against the stored surface; 0: no refinement");
    v(s.start_distance, "start_distance", Range{0.0005, 0.5}, "m", "farthest pairs of the first round");
    v(s.end_distance, "end_distance", Range{0.0005, 0.5}, "m", "farthest pairs of the last round");
    v(s.max_points, "max_points", Range{10, 1000000}, "",
      "most points of the stored surface that are used, spread evenly");
    v(s.min_density, "min_density", Range{0, 10000}, "votes", "hypotheses of lower density are not refined");
  }
};

struct VerificationSettings {
  int candidates = 80;
  double ambiguity = 1.3;
  bool skip_planes = true;
  double support_distance = 0.008;
  double support_angle = 0.45;
  double occlusion_distance = 0.015;
  double color_tolerance = 20;
  double half_evidence = 4.4;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.candidates, "candidates", Range{0, 1000}, "",
      "poses of each object, from single correspondences, that are refined and compared with the stored surface; 0: "
      "hypotheses are the Hough maxima that pass RANSAC, scored by their votes alone, as published");
    v(s.ambiguity, "ambiguity", Range{1, 10}, "",
      "each object's nearest codeword votes too, with less weight, where its distance is within this factor of the "
      "nearest of all; 1: only the nearest, as published. In scenes it needs candidates above 0");
    v(s.skip_planes, "skip_planes",
      "keypoints on planes that are larger than every object (tables, walls) are not described: what lies there "
      "confirms no pose. Needs candidates above 0");
    v(s.support_distance, "support_distance", Range{0.0005, 0.1}, "m",
      "a point of the stored surface is confirmed by a scene point within this distance");
    v(s.support_angle, "support_angle", Range{0.01, 1.5}, "rad", "... whose normal deviates by no more than this");
    v(s.occlusion_distance, "occlusion_distance", Range{0.0005, 0.5}, "m",
      "what lies this far behind the scene's surface is hidden; what lies this far in front of it should be seen");
    v(s.color_tolerance, "color_tolerance", Range{0, 1000}, "CIELab",
      "where codebook and scene have colours, what differs by this much from the stored colour (lightness counts half) "
      "confirms it by 0.6 only, and so on with a Gaussian; 0: colours are not compared");
    v(s.half_evidence, "half_evidence", Range{0.001, 1000}, "", "evidence that scores 0.5 (docs/method.md)");
  }
};

struct DetectionSettings {
  double threshold = 0.5;
  double half_density = 8.0;
  int max_per_object = 20;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.threshold, "threshold", Range{0, 1}, "", "lowest score of a detection that is reported");
    v(s.half_density, "half_density", Range{0.001, 10000}, "votes",
      "density of the inliers' votes that scores 0.5 where poses are not verified");
    v(s.max_per_object, "max_per_object", Range{1, 1000}, "", "most hypotheses of one object in one scene");
  }
};

struct TrainingSettings {
  double surface_resolution = 0.005;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v(s.surface_resolution, "surface_resolution", Range{0.001, 0.1}, "m",
      "edge of the cubes to which a training view's stored surface is thinned");
  }
};

/// Everything that can be set. Groups are the first part of a key: `keypoints.discard`.
struct Settings {
  SanitizeSettings sanitize;
  SurfaceSettings surface;
  KeypointSettings keypoints;
  DescriptorSettings descriptor;
  VotingSettings voting;
  RansacSettings ransac;
  RefinementSettings refinement;
  VerificationSettings verification;
  DetectionSettings detection;
  TrainingSettings training;
  int threads = 0;

  template <typename Self, typename Visitor>
  static void visit(Self& s, Visitor&& v) {
    v.group("sanitize", s.sanitize);
    v.group("surface", s.surface);
    v.group("keypoints", s.keypoints);
    v.group("descriptor", s.descriptor);
    v.group("voting", s.voting);
    v.group("ransac", s.ransac);
    v.group("refinement", s.refinement);
    v.group("verification", s.verification);
    v.group("detection", s.detection);
    v.group("training", s.training);
    v(s.threads, "threads", Range{0, 256}, "", "threads for training and detection; 0: one for each core");
  }
};

/// What a front end needs to know about one setting.
struct SettingInfo {
  std::string key;            ///< dotted, e.g. "keypoints.discard"
  std::string type;           ///< "double", "int", "bool" or "choice"
  std::string default_value;  ///< as getSetting() would print it
  Range range;                ///< of numbers
  std::string unit;           ///< "m", or empty for a plain number
  std::string help;
  std::vector<std::string> choices;  ///< of a choice
  Binding binding = Binding::free;
};

/// All settings in the order of the stages.
const std::vector<SettingInfo>& settingInfos();

/// The value of one setting as text that setSetting() takes back unchanged. @throws Error(bad_usage) for an unknown key
std::string getSetting(const Settings& settings, const std::string& key);

/// Sets one setting from text. @throws Error(bad_usage) naming the nearest known key, or the type, range and unit
void setSetting(Settings& settings, const std::string& key, const std::string& value);

/// Checks each range, and what must hold between settings. @throws Error(bad_usage) naming keys and values
void validate(const Settings& settings);

/// The keys bound to the codebook (Binding::codebook) in which the two differ.
std::vector<std::string> bindingConflicts(const Settings& codebook, const Settings& wanted);

/// The known key that is nearest to a misspelt one, by edit distance.
std::string nearestSettingKey(const std::string& key);

/// `settings.threads`, with 0 replaced by the number of cores.
int threadCount(const Settings& settings);

}  // namespace sks
