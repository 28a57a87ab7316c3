// SPDX-License-Identifier: BSD-3-Clause
#include "io/dataset.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "core/settings/name_text.hpp"
#include "io/file.hpp"
#include "io/length_unit.hpp"
#include "io/symmetry_yaml.hpp"
#include "io/yaml_map.hpp"
#include "io/yaml_text.hpp"

namespace sks {
namespace {

namespace fs = std::filesystem;

/// Whether a path names an object that the program makes itself.
bool isBuiltin(const std::string& path) {
  return path.rfind("builtin:", 0) == 0;
}

constexpr double largest_max_distance = 100, farthest_position = 1e4;  // [m]
constexpr double largest_normal_error = 0.01;                          // of the length of a unit vector
constexpr double most_points = 1e9;

/// Reads the parts of one file; keeps what all of them need.
class DataSetReader {
public:
  DataSetReader(const std::string& file, MissingClouds missing)
      : file_(file), folder_(fs::path(file).parent_path()), missing_(missing) {
    data_set_.file = file;
  }

  DataSet read(const std::string& text);

private:
  void readUnits(const YamlMap& map);
  static double scaleOf(const YamlMap& map);
  Eigen::Vector3d positionOf(const YamlMap& map, const std::string& key, const Eigen::Vector3d& position) const;
  void readTraining(const YamlMap& map);
  static Eigen::Hyperplane<double, 3> readPlane(const YamlMap& map, double scale);
  static Eigen::Isometry3d readCloudPose(const YamlMap& map, double scale);
  void addSymmetries();
  void readScene(const YamlMap& map);
  GroundTruth readGroundTruth(const YamlMap& map);
  Eigen::Isometry3d readPose(const YamlMap& map) const;
  void warnAboutReference(const YamlMap& map, const GroundTruth& truth);

  YamlMap mapOf(const YAML::Node& node, const std::string& what, const std::vector<std::string>& known) const {
    return {node, file_, what, known};
  }
  void warn(const YAML::Node& node, const std::string& message) {
    data_set_.warnings.push_back(file_ + ":" + std::to_string(node.Mark().line + 1) + ": " + message);
  }
  std::string resolve(const std::string& path) const { return (folder_ / path).lexically_normal().string(); }
  bool isMissing(const YamlMap& map) const;
  std::string cloudPath(const YamlMap& map) const;

  std::string file_;
  fs::path folder_;
  MissingClouds missing_;
  DataSet data_set_;
  std::set<std::string> scene_names_;
};

DataSet DataSetReader::read(const std::string& text) {
  const YAML::Node root = parseYaml(text, file_);
  const YamlMap map = mapOf(root, "the data set", {"name", "units", "max_distance", "training", "scenes", "tests"});
  data_set_.name = map.name("name");
  readUnits(map);
  for (const YAML::Node& item : map.list("training")) {
    readTraining(mapOf(item, "a training cloud",
                       {"object", "cloud", "kind", "plane", "cloud_pose", "symmetry", "units", "diameter",
                        "symmetries_discrete", "symmetries_continuous"}));
  }
  for (const YAML::Node& item : map.list("scenes")) {
    readScene(mapOf(item, "a scene", {"name", "cloud", "objects", "ignore"}));
  }
  addSymmetries();
  for (const YAML::Node& item : map.list("tests")) {
    const YamlMap test = mapOf(item, "a test", {"object", "cloud"});
    data_set_.tests.push_back({test.name("object"), cloudPath(test)});
  }
  const bool empty = data_set_.training.empty() && data_set_.scenes.empty() && data_set_.tests.empty();
  if (empty && missing_ == MissingClouds::refused) {
    failAt(file_, root, "nothing in it: the data set needs 'training', 'scenes' or 'tests'");
  }
  return std::move(data_set_);
}

void DataSetReader::readUnits(const YamlMap& map) {
  const std::string units = map.text("units");
  data_set_.scale = scaleOf(map);
  if (map.list("scenes").empty() && !map.has("max_distance")) return;  // only scenes are scored with it
  const double distance = map.number("max_distance");
  if (distance <= 0) map.fail("max_distance", "must be greater than 0 " + units);
  data_set_.max_distance = distance * data_set_.scale;
  if (data_set_.max_distance > largest_max_distance) map.fail("max_distance", "must be at most 100 m");
}

/// Metres in the unit that a map states.
double DataSetReader::scaleOf(const YamlMap& map) {
  const std::string units = map.text("units");
  const std::optional<double> scale = metresIn(units);
  if (!scale) map.fail("units", "is '" + units + "': use " + known_units + ", the unit of every length");
  return *scale;
}

/// A position of the scene in metres.
Eigen::Vector3d DataSetReader::positionOf(const YamlMap& map, const std::string& key,
                                          const Eigen::Vector3d& position) const {
  if (!((data_set_.scale * position).norm() <= farthest_position)) {
    map.fail(key, "lies more than 10 km away: is `units` right?");
  }
  return data_set_.scale * position;
}

bool DataSetReader::isMissing(const YamlMap& map) const {
  std::error_code ignored;
  return !isBuiltin(map.text("cloud")) && !fs::is_regular_file(resolve(map.text("cloud")), ignored);
}

std::string DataSetReader::cloudPath(const YamlMap& map) const {
  if (map.text("cloud").find('\0') != std::string::npos) map.fail("cloud", "contains a null character");
  if (isBuiltin(map.text("cloud"))) return map.text("cloud");
  std::string path = resolve(map.text("cloud"));
  if (!isMissing(map)) return path;
  std::error_code ignored;
  const std::string place = file_ + ":" + std::to_string(map.at("cloud").Mark().line + 1) + ": cloud '" + path;
  if (fs::exists(path, ignored)) throw Error(ErrorCode::bad_file, place + "' is no regular file");
  throw Error(ErrorCode::bad_file, place +
                                       "' does not exist; paths are relative to the data set file: correct the path or "
                                       "put the cloud there");
}

void DataSetReader::readTraining(const YamlMap& map) {
  TrainingEntry entry;
  entry.object = map.name("object");
  entry.source = fs::path(map.text("cloud")).lexically_normal().string();
  const bool left_out = missing_ == MissingClouds::left_out && isMissing(map);
  entry.path = left_out ? resolve(map.text("cloud")) : cloudPath(map);
  const std::string kind = map.text("kind");
  if (kind != "view" && kind != "model" && kind != "mesh") {
    map.fail("kind", "is '" + kind + "': use view (2.5-D, seen from the camera), model (full 3-D) or mesh (triangles)");
  }
  entry.kind = kind == "model" ? ViewKind::model : ViewKind::view;
  entry.mesh = kind == "mesh";
  if (isBuiltin(entry.path) && !entry.mesh) map.fail("kind", "must be mesh for the built-in object " + entry.path);
  if (map.has("symmetry")) entry.symmetry = readSymmetry(map);
  if (map.has("units")) entry.scale = scaleOf(map);
  const double scale = entry.scale.value_or(data_set_.scale);
  entry.symmetries = readSymmetries(map, scale);
  if (map.has("diameter")) {
    entry.diameter = scale * map.number("diameter");
    if (*entry.diameter <= 0) map.fail("diameter", "must be greater than 0");
  }
  if (map.has("plane")) entry.plane = readPlane(map, scale);
  if (map.has("cloud_pose")) entry.T_fixed_cloud = readCloudPose(map, scale);
  if (left_out) {
    warn(map.at("cloud"), "cloud '" + entry.path + "' of object '" + entry.object + "' does not exist: it is left out");
  }
  (left_out ? data_set_.missing : data_set_.training).push_back(std::move(entry));
}

/// [a, b, c, d] of the points (x, y, z) with a x + b y + c z + d = 0.
Eigen::Hyperplane<double, 3> DataSetReader::readPlane(const YamlMap& map, double scale) {
  const std::vector<double> values = map.numbers("plane", 4);
  const Eigen::Vector3d normal(values[0], values[1], values[2]);
  if (map.text("kind") != "view") map.fail("plane", "is only of use for views");
  if (!(std::abs(normal.norm() - 1) <= largest_normal_error)) {
    map.fail("plane", "must be [a, b, c, d] with a unit vector (a, b, c): the plane's normal, towards the object");
  }
  Eigen::Hyperplane<double, 3> plane(normal.normalized(), scale * values[3]);
  if (!(std::abs(plane.offset()) <= farthest_position))
    map.fail("plane", "lies more than 10 km away: is `units` right?");
  return plane;
}

Eigen::Isometry3d DataSetReader::readCloudPose(const YamlMap& map, double scale) {
  if (map.text("kind") != "view") map.fail("cloud_pose", "is only of use for views");
  Eigen::Isometry3d pose = readRigidMotion(map, "cloud_pose");
  pose.translation() *= scale;
  if (!(pose.translation().norm() <= farthest_position))
    map.fail("cloud_pose", "lies more than 10 km away: is `units` right?");
  return pose;
}

/// Gives the ground truth the symmetries that the training entries declare.
void DataSetReader::addSymmetries() {
  std::map<std::string, std::optional<Symmetry>> symmetries;
  for (const TrainingEntry& entry : data_set_.training) symmetries[entry.source] = entry.symmetry;
  for (Scene& scene : data_set_.scenes) {
    for (GroundTruth& truth : scene.objects) {
      const auto found = symmetries.find(truth.reference);
      if (found != symmetries.end()) truth.symmetry = found->second;
    }
  }
}

void DataSetReader::readScene(const YamlMap& map) {
  Scene scene;
  scene.name = map.name("name");
  if (!scene_names_.insert(scene.name).second) {
    map.fail("name", "is '" + scene.name + "', which an earlier scene has: give each scene a name of its own");
  }
  scene.path = cloudPath(map);
  for (const YAML::Node& item : map.list("objects")) {
    scene.objects.push_back(
        readGroundTruth(mapOf(item, "an object of scene '" + scene.name + "'",
                              {"object", "position", "reference", "pose", "visibility", "points"})));
  }
  std::set<std::string> with_truth;
  for (const GroundTruth& truth : scene.objects) with_truth.insert(truth.object);
  for (const YAML::Node& item : map.list("ignore")) {
    if (!item.IsScalar() || !nameFault(item.Scalar()).empty()) {
      failAt(file_, item, "'ignore' must be a list of names of objects");
    }
    scene.ignore.push_back(item.Scalar());
    if (with_truth.count(item.Scalar()) > 0) {
      warn(item, "'" + item.Scalar() + "' of scene '" + scene.name +
                     "' is ignored although it has ground truth there: that counts neither");
    }
  }
  data_set_.scenes.push_back(std::move(scene));
}

GroundTruth DataSetReader::readGroundTruth(const YamlMap& map) {
  GroundTruth truth;
  truth.object = map.name("object");
  const std::vector<double> position = map.numbers("position", 3);
  truth.position = positionOf(map, "position", Eigen::Vector3d(position[0], position[1], position[2]));
  if (map.has("reference")) truth.reference = fs::path(map.text("reference")).lexically_normal().string();
  if (map.has("pose")) truth.T_scene_reference = readPose(map);
  if (map.has("visibility")) {
    truth.visibility = map.number("visibility");
    if (*truth.visibility < 0 || *truth.visibility > 1) map.fail("visibility", "must lie in [0, 1]");
  }
  if (map.has("points")) {
    const double points = map.number("points");
    if (!(points >= 0 && points <= most_points && points == std::floor(points))) {
      map.fail("points", "must be a count, 0 or more");
    }
    truth.points = std::size_t(points);
  }
  warnAboutReference(map, truth);
  return truth;
}

void DataSetReader::warnAboutReference(const YamlMap& map, const GroundTruth& truth) {
  std::error_code ignored;
  if (truth.T_scene_reference && truth.reference.empty()) {
    warn(map.at("pose"), "a pose without 'reference', the training cloud that it maps: no pose error can be taken");
  } else if (!truth.reference.empty() && !isBuiltin(truth.reference) &&
             !fs::exists(resolve(truth.reference), ignored)) {
    warn(map.at("reference"), "reference '" + resolve(truth.reference) + "' does not exist");
  }
}

Eigen::Isometry3d DataSetReader::readPose(const YamlMap& map) const {
  Eigen::Isometry3d pose = readRigidMotion(map, "pose");
  pose.translation() = positionOf(map, "pose", pose.translation());
  return pose;
}

}  // namespace

DataSet loadDataSet(const std::string& path, MissingClouds missing) {
  return DataSetReader(path, missing).read(readTextFile(path));
}

DataSet parseDataSet(const std::string& text, const std::string& path) {
  return DataSetReader(path, MissingClouds::refused).read(text);
}

std::vector<TrainingSample> trainingSamples(const DataSet& data_set, const MeshSampler& sampler) {
  std::vector<TrainingSample> samples;
  for (const TrainingEntry& entry : data_set.training) {
    const double scale = entry.scale.value_or(data_set.scale);
    if (entry.mesh) {
      if (!sampler) throw Error(ErrorCode::bad_usage, entry.source + ": this program cannot train from meshes");
      const std::vector<TrainingSample> views = sampler(entry, scale);
      samples.insert(samples.end(), views.begin(), views.end());
      continue;
    }
    TrainingSample sample;
    sample.object = entry.object;
    sample.source = entry.source;
    sample.kind = entry.kind;
    sample.plane = entry.plane;
    sample.T_fixed_source = entry.T_fixed_cloud;
    sample.load = [path = entry.path, scale] { return readCloud(path, scale); };
    samples.push_back(std::move(sample));
  }
  return samples;
}

std::vector<std::string> untrainedObjects(const DataSet& data_set, const std::vector<std::string>& trained) {
  std::vector<std::string> untrained;
  std::set<std::string> known(trained.begin(), trained.end());
  for (const Scene& scene : data_set.scenes) {
    for (const GroundTruth& truth : scene.objects) {
      if (known.insert(truth.object).second) untrained.push_back(truth.object);
    }
  }
  return untrained;
}

}  // namespace sks
