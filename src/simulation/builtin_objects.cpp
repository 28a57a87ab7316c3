// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/builtin_objects.hpp"

#include <sks_detector/error.hpp>

#include "simulation/builtin_shapes.hpp"

namespace sks {
namespace {

struct Builtin {
  const char* name;
  Mesh (*make)();
};

constexpr Builtin builtins[] = {{"mug", makeMug},        {"bottle", makeBottle}, {"bowl", makeBowl},
                                {"box", makePrintedBox}, {"drill", makeDrill},   {"duck", makeDuck}};

const std::string prefix = "builtin:";

}  // namespace

std::vector<std::string> builtinNames() {
  std::vector<std::string> names;
  for (const Builtin& builtin : builtins) names.emplace_back(builtin.name);
  return names;
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
