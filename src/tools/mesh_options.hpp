// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "io/dataset.hpp"

namespace sks::tools {

/// `--mesh NAME=FILE ...` and `--builtin`.
class MeshOptions {
public:
  void add(CLI::App& command);

  bool any() const { return builtin_ || !meshes_.empty(); }
  /// One training entry for each mesh, in their order; its source is the file as given, or `builtin:` and a name.
  /// @throws Error(bad_usage) for a mesh without name or file, or a name that stands twice
  std::vector<TrainingEntry> entries() const;

private:
  std::vector<std::string> meshes_;
  bool builtin_ = false;
};

/// `--views N` and the like: how meshes become training views.
class MeshViewOptions {
public:
  void add(CLI::App& command);

  /// What trainingSamples() needs to train from meshes; it warns of what is odd about them.
  MeshSampler sampler() const;

private:
  int views_ = 42;
  double distance_ = 0.8;
  bool noise_ = false;
};

}  // namespace sks::tools
