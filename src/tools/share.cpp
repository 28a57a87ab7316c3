// SPDX-License-Identifier: BSD-3-Clause
#include "tools/share.hpp"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include <sks_detector/error.hpp>

namespace sks::tools {

std::string sharePath(const std::string& relative) {
  namespace fs = std::filesystem;
  std::vector<fs::path> folders;
  if (const char* share = std::getenv("SKS_SHARE")) folders.emplace_back(share);
  std::error_code ignored;
  const fs::path executable = fs::read_symlink("/proc/self/exe", ignored);
  for (const char* up : {"..", "../.."}) {  // bin/sks, or lib/sks_detector/sks in a catkin workspace
    folders.push_back((executable.parent_path() / up / "share/sks_detector").lexically_normal());
  }
  folders.emplace_back(SKS_SHARE_DIR);
  std::string tried;
  for (const fs::path& folder : folders) {
    if (fs::is_regular_file(folder / relative, ignored)) return (folder / relative).string();
    tried += (tried.empty() ? " '" : ", '") + folder.string() + "'";
  }
  throw Error(ErrorCode::bad_file, "cannot find '" + relative + "', which comes with this program, in any of" + tried +
                                       "; set SKS_SHARE to the folder that holds it");
}

}  // namespace sks::tools
