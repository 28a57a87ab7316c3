// SPDX-License-Identifier: BSD-3-Clause
#include "tools/codebook_options.hpp"

#include <sks_detector/codebook_file.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/registration.hpp>

#include "core/pipeline/shared_training.hpp"
#include "io/codebook_bytes.hpp"
#include "io/codebook_layout.hpp"
#include "io/file.hpp"
#include "tools/cluster/cluster.hpp"

namespace sks::tools {

void CodebookOptions::add(CLI::App& command) {
  CLI::Option* codebook = command.add_option("--codebook,-b", codebook_, "trained codebook (*.sks)")->type_name("FILE");
  command.add_option("--save-codebook", save_, "keep the codebook that was trained")
      ->type_name("FILE")
      ->excludes(codebook);
  mesh_views_.add(command);
}

std::shared_ptr<const Codebook> CodebookOptions::read() const {
  return codebook_.empty() ? nullptr : readCodebook(codebook_);
}

void CodebookOptions::check() const {
  if (save_.empty()) return;
  checkCodebookName(save_);
  if (leads()) checkWritable(save_);
}

std::shared_ptr<const Codebook> CodebookOptions::train(const DataSet& data_set, const Settings& settings,
                                                       const Progress& progress) const {
  if (data_set.training.empty()) {
    throw Error(ErrorCode::bad_usage,
                "'" + data_set.file + "' has no training clouds; give a codebook: --codebook FILE");
  }
  const std::vector<TrainingSample> samples = trainingSamples(data_set, mesh_views_.sampler());
  WorkShare* const share = workShare();
  auto codebook =
      std::make_shared<const Codebook>(trainRegistered(samples, settings, data_set.name, progress, {}, share).codebook);
  if (!save_.empty() && leads()) writeCodebook(save_, *codebook);
  if (share == nullptr) return codebook;
  std::string bytes = share->leads() ? codebookBytes(*codebook) : "";
  share->spread(bytes);
  return share->leads() ? codebook : codebookFromBytes(bytes);
}

}  // namespace sks::tools
