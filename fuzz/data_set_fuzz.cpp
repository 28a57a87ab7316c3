// SPDX-License-Identifier: BSD-3-Clause
// Data set files, and what training and evaluation do with them first.
#include "io/dataset.hpp"

#include "memory_file.hpp"
#include "refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const sks::fuzz::MemoryFile file(data, size);
  sks::fuzz::refused([&] {
    const sks::DataSet data_set = sks::loadDataSet(file.path());
    sks::untrainedObjects(data_set, {"mug"});
    sks::trainingSamples(data_set,
                         [](const sks::TrainingEntry&, double) { return std::vector<sks::TrainingSample>(); });
  });
  return 0;
}
