// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <memory>

#include <sks_detector/error.hpp>
#include <sks_detector/simulation/camera_presets.hpp>

#include "core/settings/threads.hpp"
#include "simulation/builtin_objects.hpp"
#include "simulation/scene.hpp"
#include "simulation/sequence.hpp"
#include "tools/bag.hpp"
#include "tools/cluster/cluster.hpp"
#include "tools/command.hpp"
#include "tools/force_option.hpp"
#include "tools/mesh_options.hpp"
#include "tools/progress_bar.hpp"
#include "tools/simulated_set.hpp"
#include "tools/twin_set.hpp"

namespace sks::tools {
namespace {

struct SimulateOptions {
  std::string output;
  std::string twin;  // data set file whose recordings are imitated; empty: none
  MeshOptions meshes;
  int scenes = 10;
  bool no_noise = false;
  std::string camera = "basic", room = "plain";
  int least_points = 0;
  SceneOptions scene;
  ForceOption force;
  CLI::Option* bag_option = nullptr;
  std::string bag;  // empty: scenes.bag in the output folder
  double rate = 1;
  int repeat = 1;
  CLI::Option* sequence_option = nullptr;
  SequenceOptions sequence;

  std::unique_ptr<BagRecorder> bagRecorder(const CameraModel& camera_model) const;
};

std::unique_ptr<BagRecorder> SimulateOptions::bagRecorder(const CameraModel& camera_model) const {
  if (bag_option->count() == 0) return nullptr;
  if (repeat < 1 || repeat > 100000) {
    throw Error(ErrorCode::bad_usage, "--repeat " + std::to_string(repeat) + " must be in [1, 100000]");
  }
  const std::string path = bag.empty() ? (std::filesystem::path(output) / "scenes.bag").string() : bag;
  const bool camera_moves = sequence_option->count() > 0;
  return std::make_unique<BagRecorder>(path, camera_model, camera_moves ? sequence.rate : rate);
}

std::vector<SceneModel> loadModels(const std::vector<TrainingEntry>& entries) {
  std::vector<SceneModel> models;
  for (const TrainingEntry& entry : entries) {
    LoadedMesh loaded = findMesh(entry.path, entry.scale.value_or(0));
    for (const std::string& warning : loaded.warnings) warn(warning);
    models.push_back({entry.object, entry.source, std::make_shared<const Mesh>(std::move(loaded.mesh))});
  }
  return models;
}

CameraModel cameraOf(const SimulateOptions& options) {
  CameraModel camera = cameraPreset(options.camera);
  if (options.no_noise) {
    camera.noise = CameraNoise::none();
    camera.color = {};
  }
  camera.noise.seed = options.scene.seed;
  return camera;
}

void runTwin(const SimulateOptions& options) {
  if (options.meshes.any() || options.bag_option->count() > 0) {
    throw Error(ErrorCode::bad_usage,
                "--twin takes objects and scenes from its data set: leave out --builtin, --mesh "
                "and --bag");
  }
  options.force.checkFolder(options.output);
  ProgressBar bar;
  const std::string file =
      writeTwins(options.twin, options.output, cameraOf(options), startableThreads(Settings()), bar.callback());
  bar.clear();
  print("twins: " + file + "\n");
}

/// One scene, picture after picture.
std::size_t addSequence(const std::vector<SceneModel>& models, const SceneOptions& scene,
                        const SequenceOptions& options, SimulatedSet& set, BagRecorder* bag, const Progress& progress) {
  SimulatedSequence sequence(models, scene, options, 0);
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    report(progress, {"simulating", "", i, sequence.size()});
    const SequenceFrame frame = sequence.at(i);
    set.add(frame.scene, frame.stamp);
    if (bag) bag->add(frame.scene.view.cloud, frame.scene.T_table_camera, set.truth(frame.scene));
  }
  return sequence.size();
}

void run(const SimulateOptions& options) {
  const bool is_sequence = options.sequence_option->count() > 0;
  const bool in_order = !options.twin.empty() || is_sequence || options.bag_option->count() > 0;
  if (in_order && !leads()) return;  // one process writes it
  if (!options.twin.empty()) return runTwin(options);
  if (!options.meshes.any()) {
    throw Error(ErrorCode::bad_usage, "there is nothing to simulate: give --builtin or --mesh NAME=FILE");
  }
  if (options.scenes < 1 || options.scenes > 100000) {
    throw Error(ErrorCode::bad_usage, "--scenes " + std::to_string(options.scenes) + " must be in [1, 100000]");
  }
  if (options.least_points < 0) {
    throw Error(ErrorCode::bad_usage, "--min-points " + std::to_string(options.least_points) + " must be 0 or more");
  }
  SceneOptions scene = options.scene;
  scene.threads = startableThreads(Settings());
  scene.camera = cameraOf(options);
  scene.room = roomOf(options.room);
  validate(scene);
  const std::vector<TrainingEntry> entries = options.meshes.entries();
  const std::vector<SceneModel> models = loadModels(entries);
  if (leads()) options.force.checkFolder(options.output);
  SimulatedSet set(options.output, entries, models, std::size_t(options.least_points));
  const std::unique_ptr<BagRecorder> bag = options.bagRecorder(scene.camera);
  ProgressBar bar;
  const Progress progress = bar.callback();
  const std::size_t total = is_sequence ? addSequence(models, scene, options.sequence, set, bag.get(), progress)
                                        : std::size_t(options.scenes);
  const auto simulate = [&](std::size_t i) {
    const SimulatedScene simulated = simulateScene(models, scene, i);
    for (int k = 0; bag && k < options.repeat; ++k)
      bag->add(simulated.view.cloud, simulated.T_table_camera, set.truth(simulated));
    return set.write(simulated, i);
  };
  dealOut<std::string>(
      in_order ? nullptr : workShare(), is_sequence ? 0 : total, simulate,
      [&](std::size_t, const std::string& written) { set.list(written); },
      [&](std::size_t done) {
        report(progress, {"simulating", "", done, total});
      });
  if (!leads()) return;
  if (bag) bag->finish();
  const std::string file = set.finish(options.force);
  bar.clear();
  print(std::to_string(total) + " scenes: " + file + "\n");
}

}  // namespace

void addSimulate(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "simulate", "cluttered table scenes with exact ground truth, seen by a virtual RGB-D camera, as a data set");
  const auto options = std::make_shared<SimulateOptions>();
  command->add_option("--output,-o", options->output, "folder for dataset.yaml and scenes/")
      ->required()
      ->type_name("DIR");
  options->force.add(*command);
  options->meshes.add(*command);
  command->add_option("--scenes", options->scenes, "number of scenes (default: 10)")->type_name("N");
  command->add_option("--objects", options->scene.objects, "objects in a scene (default: 5)")->type_name("K");
  command->add_flag("--repeated", options->scene.repeated, "an object may stand there several times");
  command->add_option("--distractors", options->scene.distractors, "other things in a scene (default: 4)")
      ->type_name("D");
  command->add_option("--region", options->scene.region, "radius in which things are dropped [m] (default: 0.2)");
  command->add_option("--min-elevation", options->scene.min_elevation,
                      "of the camera above the table; the lower, the more is hidden [degrees] (default: 25)");
  command->add_option("--max-elevation", options->scene.max_elevation, "... at most [degrees] (default: 60)");
  command->add_option("--min-distance", options->scene.min_distance,
                      "of the camera from the middle of the table [m] (default: 0.7)");
  command->add_option("--max-distance", options->scene.max_distance, "... at most [m] (default: 1.3)");
  command->add_option("--seed", options->scene.seed, "same seed, same files (default: 1)")->type_name("S");
  command->add_option("--camera", options->camera,
                      "ideal, basic (independent errors in depth, true colours), kinect, xtion or realsense (errors in "
                      "depth and colour as recorded) (default: basic)");
  command->add_option("--room", options->room,
                      "none, plain (a table, sometimes a wall) or furnished (floor, walls, furniture to 4 m) (default: "
                      "plain)");
  command
      ->add_option("--twin", options->twin,
                   "instead of tables: the recorded scenes of a data set, whose objects are replaced by their meshes")
      ->type_name("FILE");
  command->add_flag("--packages", options->scene.packages,
                    "other things are cartons, cans, bottles and books with prints");
  command->add_flag("--no-noise", options->no_noise, "a camera without errors");
  command
      ->add_option("--min-points", options->least_points,
                   "objects with fewer measured points are not asked for (default: 0)")
      ->type_name("N");
  options->bag_option =
      command->add_option("--bag", options->bag, "also as a bag for `rosbag play` (default: scenes.bag in DIR)")
          ->type_name("[FILE]")
          ->expected(0, 1);
  command->add_option("--rate", options->rate, "frames of the bag in a second [Hz] (default: 1)")
      ->needs(options->bag_option);
  command->add_option("--repeat", options->repeat, "frames of the bag that show each scene (default: 1)")
      ->type_name("N")
      ->needs(options->bag_option);
  options->sequence_option =
      command
          ->add_option(
              "--sequence", options->sequence.seconds,
              "instead of many scenes: one, over so many seconds, before a camera that moves; an object is pushed, "
              "then an arm passes in front [s]; camera.txt tells where the camera was")
          ->type_name("SECONDS");
  command->add_option("--frame-rate", options->sequence.rate, "pictures of the sequence in a second [Hz] (default: 30)")
      ->needs(options->sequence_option);
  command
      ->add_option("--swing", options->sequence.swing,
                   "by which its camera goes around the table, to either side [degrees] (default: 20)")
      ->needs(options->sequence_option);
  command->callback([options] { run(*options); });
}

}  // namespace sks::tools
