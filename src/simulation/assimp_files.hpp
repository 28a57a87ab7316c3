// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <assimp/IOSystem.hpp>

#include "simulation/mesh_files.hpp"

namespace sks {

/// What assimp sees of the file system: the files of one mesh, read into memory. It never writes.
class AssimpFiles : public Assimp::IOSystem {
public:
  explicit AssimpFiles(const MeshFiles& files) : files_(files) {}

  bool Exists(const char* name) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

private:
  const MeshFiles& files_;
};

}  // namespace sks
