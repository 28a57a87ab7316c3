// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sks {

/// A mesh file and what it names: materials, pictures. All of them are regular files, and where a folder is set, none
/// lies outside of it.
class MeshFiles {
public:
  /// @param folder of confinement; empty: files may lie anywhere
  MeshFiles(std::string mesh, std::string folder) : mesh_(std::move(mesh)), folder_(std::move(folder)) {}

  const std::string& mesh() const { return mesh_; }
  /// Ending of the mesh's name in lower case, e.g. ".obj".
  std::string ending() const;

  /// Where a file lies that the mesh names: relative to the file that names it or to the mesh, or, as exporters leave
  /// names of another machine behind, under its last part beside these, in capitals or not.
  /// @param from file that names it; empty: the mesh @throws Error(bad_file) with the reason alone
  std::string find(const std::string& name, const std::string& from = "") const;
  /// The content of a file that find() has found. @throws Error(bad_file) with the reason alone
  static std::string read(const std::string& path);
  /// The content of the mesh itself. @throws Error(bad_file) with the reason alone
  std::string readMesh() const;

private:
  std::string allowed(const std::string& path) const;

  std::string mesh_, folder_;
};

}  // namespace sks
