// SPDX-License-Identifier: BSD-3-Clause
// Mesh files, as loadMesh() takes them; the first byte of an input picks the format.
#include <array>
#include <string>

#include <unistd.h>

#include <sks_detector/simulation/mesh.hpp>

#include "memory_file.hpp"
#include "refused.hpp"
#include "temporary_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sks::test::TemporaryFolder folder;
  constexpr std::array<const char*, 3> endings = {"obj", "ply", "stl"};
  if (size == 0) return 0;
  const sks::fuzz::MemoryFile file(data + 1, size - 1);
  const std::string link = folder.path(std::string("mesh.") + endings[data[0] % endings.size()]);
  if (::symlink(file.path().c_str(), link.c_str()) != 0) return 0;
  sks::fuzz::refused([&] {
    const sks::Mesh mesh = sks::loadMesh(link).mesh;
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      sks::fuzz::require(triangle.minCoeff() >= 0 && std::size_t(triangle.maxCoeff()) < mesh.vertices.size(),
                         "triangles are made of vertices");
    }
  });
  ::unlink(link.c_str());
  return 0;
}
