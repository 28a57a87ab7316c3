// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/builtin_objects.hpp"

#include <sks_detector/error.hpp>

#include "simulation/builtin_shapes.hpp"

namespace sks {
namespace {

struct Builtin {
  const char* group;
  const char* name;
  Mesh (*make)();
};

constexpr Builtin builtins[] = {
    {"household", "mug", makeMug},        {"household", "bottle", makeBottle}, {"household", "bowl", makeBowl},
    {"household", "box", makePrintedBox}, {"household", "drill", makeDrill},   {"household", "duck", makeDuck},
    {"small", "dice", makeDice},          {"small", "ball", makeBall},         {"small", "matchbox", makeMatchbox},
    {"small", "spool", makeSpool},        {"small", "pawn", makePawn},         {"flat", "card", makeCard},
    {"flat", "coaster", makeCoaster},     {"flat", "tile", makeTile},          {"flat", "booklet", makeBooklet},
    {"flat", "tablet", makeTablet},       {"thin", "marker", makeMarker},      {"thin", "screwdriver", makeScrewdriver},
    {"thin", "brush", makeBrush},         {"thin", "spoon", makeSpoon},        {"thin", "stick", makeStick}};

const std::string prefix = "builtin:";

}  // namespace

std::vector<std::string> builtinGroups() {
  std::vector<std::string> groups;
  for (const Builtin& builtin : builtins) {
    if (groups.empty() || groups.back() != builtin.group) groups.emplace_back(builtin.group);
  }
  return groups;
}

std::vector<std::string> builtinNames(const std::string& group) {
  std::vector<std::string> names;
  for (const Builtin& builtin : builtins) {
    if (group == builtin.group) names.emplace_back(builtin.name);
  }
  if (!names.empty()) return names;
  std::string known;
  for (const std::string& name : builtinGroups()) known += (known.empty() ? "" : ", ") + name;
  throw Error(ErrorCode::bad_usage, "there is no group '" + group + "' of built-in objects: use one of " + known);
}

Mesh builtinObject(const std::string& name) {
  std::string known;
  for (const Builtin& builtin : builtins) {
    if (name == builtin.name) return builtin.make();
    known += (known.empty() ? "" : ", ") + std::string(builtin.name);
  }
  throw Error(ErrorCode::bad_usage, "there is no built-in object '" + name + "': use one of " + known);
}

LoadedMesh findMesh(const std::string& name, double scale, const std::string& folder) {
  if (name.rfind(prefix, 0) != 0) return loadMesh(name, scale, folder);
  LoadedMesh builtin;
  builtin.mesh = builtinObject(name.substr(prefix.size()));
  builtin.file_colors.painted = builtin.mesh.triangles.size();
  builtin.states_unit = true;
  return builtin;
}

}  // namespace sks
