// SPDX-License-Identifier: BSD-3-Clause
// replay_<target> FOLDER...: feeds each file of these folders to a fuzz target once, without a fuzzer, so that what was
// learnt in fuzzing is tested by every build. The exit status is 1 if there is no file or one takes more than a second.
#include <algorithm>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "io/file_content.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

std::vector<std::string> filesOf(const std::string& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Time of the processor that one input takes [s].
double secondsOf(const std::string& file) {
  const sks::FileContent input(file);
  const std::clock_t start = std::clock();
  LLVMFuzzerTestOneInput(input.data(), input.size());
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int count, char** arguments) {
  std::size_t inputs = 0;
  bool quick = true;
  for (int i = 1; i < count; ++i) {
    for (const std::string& file : filesOf(arguments[i])) {
      std::cout << file << std::endl;  // the last one named is the one that ends the program
      const double seconds = secondsOf(file);
      if (seconds > 1) std::cerr << "replay: " << file << " takes " << seconds << " s\n";
      quick = quick && seconds <= 1;
      ++inputs;
    }
  }
  std::cout << "replay: " << inputs << " inputs" << std::endl;
  if (inputs == 0) std::cerr << "replay: nothing to feed; usage: replay_<target> FOLDER...\n";
  return inputs > 0 && quick ? 0 : 1;
}
