// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/simulation/mesh.hpp>

#include "error_of.hpp"
#include "temporary_folder.hpp"

namespace sks::test {

/// Tests that write mesh files into a folder of their own.
class MeshFileTest : public ::testing::Test {
protected:
  std::string write(const std::string& name, const std::string& content) const {
    writeFile(folder_.path(name), content);
    return folder_.path(name);
  }
  std::string refusal(const std::string& path, double scale = 0) const {
    return errorOf(ErrorCode::bad_file, [&] { loadMesh(path, scale); });
  }

  TemporaryFolder folder_;
};

}  // namespace sks::test
