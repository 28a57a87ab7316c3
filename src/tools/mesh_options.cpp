// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mesh_options.hpp"

#include <algorithm>
#include <optional>

#include <sks_detector/error.hpp>

#include "core/settings/name_text.hpp"
#include "core/settings/shown_text.hpp"
#include "io/length_unit.hpp"
#include "simulation/builtin_objects.hpp"
#include "simulation/mesh_sampler.hpp"
#include "tools/command.hpp"

namespace sks::tools {

double meshScale(const std::string& text) {
  if (text.empty()) return 0;
  const std::optional<double> scale = metresIn(text);
  if (!scale) {
    throw Error(ErrorCode::bad_usage,
                "--scale " + text + ": expected the unit of the meshes: " + known_units + " (from 1e-9 to 1000)");
  }
  return *scale;
}

void addMeshScale(CLI::App& command, std::string& text) {
  command
      .add_option(
          "--scale", text,
          "metres in a unit of the meshes that do not state it: a number, or m, cm, mm, inch (default: m, or mm "
          "for meshes more than 5 units across)")
      ->type_name("S");
}

void MeshOptions::add(CLI::App& command) {
  command
      .add_option("--mesh", meshes_,
                  "an object's mesh (OBJ, PLY, STL, DAE, glTF), or builtin:mug and the like; can be repeated")
      ->type_name("NAME=FILE")
      ->allow_extra_args(true);
  addMeshScale(command, scale_);
  builtin_ = command
                 .add_option("--builtin", groups_,
                             "objects that the program makes itself: household (default), small, flat, thin; several "
                             "groups can be named")
                 ->type_name("[GROUP]")
                 ->expected(0, int(builtinGroups().size()));
}

std::vector<std::string> MeshOptions::groups() const {
  if (builtin_->count() == 0) return {};
  std::vector<std::string> named;
  for (const std::string& group : groups_) {
    if (!group.empty()) named.push_back(group);
  }
  return named.empty() ? std::vector<std::string>{builtinGroups().front()} : named;
}

std::vector<TrainingEntry> MeshOptions::entries() const {
  std::vector<TrainingEntry> entries;
  const double scale = meshScale(scale_);
  const auto add = [&](const std::string& name, const std::string& file) {
    checkName(name, "--mesh: the object's name");
    const auto same = [&](const TrainingEntry& entry) { return entry.object == name; };
    if (std::any_of(entries.begin(), entries.end(), same)) {
      throw Error(ErrorCode::bad_usage, "--mesh: two meshes are called '" + name + "'");
    }
    TrainingEntry entry;
    entry.object = name;
    entry.source = entry.path = file;
    entry.mesh = true;
    entry.scale = file.rfind("builtin:", 0) == 0 ? 0 : scale;
    entries.push_back(entry);
  };
  for (const std::string& group : groups()) {
    for (const std::string& name : builtinNames(group)) add(name, "builtin:" + name);
  }
  for (const std::string& mesh : meshes_) {
    const std::size_t equals = mesh.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == mesh.size()) {
      throw Error(ErrorCode::bad_usage, "--mesh " + shown(mesh) + ": expected NAME=FILE, e.g. --mesh mug=mug.obj");
    }
    add(mesh.substr(0, equals), mesh.substr(equals + 1));
  }
  return entries;
}

void MeshViewOptions::add(CLI::App& command) {
  command.add_option("--views", views_, "directions from which each mesh is trained (default: 42)")->type_name("N");
  command.add_option("--view-distance", distance_, "of the virtual camera from each mesh [m] (default: 0.8)");
  command.add_flag("--view-noise", noise_, "training views of meshes with the errors of a Kinect");
}

MeshSampler MeshViewOptions::sampler() const {
  MeshTraining training;
  training.views = views_;
  training.distance = distance_;
  training.noise = noise_;
  training.threads = threadCount(Settings());
  return meshSampler(training, warn);
}

}  // namespace sks::tools
