// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "io/dataset.hpp"

namespace sks::tools {

/// Metres per unit of a mesh from the text of `--scale`: a number, or the name of a unit; 0 for no text.
/// @throws Error(bad_usage)
double meshScale(const std::string& text);

/// Adds `--scale`, for meshes. @param text for meshScale()
void addMeshScale(CLI::App& command, std::string& text);

/// `--mesh NAME=FILE ...`, `--scale` and `--builtin [GROUP ...]`.
class MeshOptions {
public:
  void add(CLI::App& command);

  bool any() const { return builtin_->count() > 0 || !meshes_.empty(); }
  /// One training entry for each mesh, in their order; its source is the file as given, or `builtin:` and a name.
  /// @throws Error(bad_usage) for a mesh without name or file, a name that stands twice, or an impossible scale
  std::vector<TrainingEntry> entries() const;

private:
  std::vector<std::string> groups() const;  // of built-in objects that are asked for

  std::vector<std::string> meshes_;
  std::string scale_;
  std::vector<std::string> groups_;
  CLI::Option* builtin_ = nullptr;
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
