// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include <sks_detector/codebook.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/settings.hpp>

namespace sks_detector {

/// Name and checksum of a codebook, e.g. "toys (3f2a90c1)".
std::string nameWithChecksum(const sks::Codebook& codebook);

/// `settings`, but those that are bound to a codebook as in `bound`.
sks::Settings withBound(sks::Settings settings, const sks::Settings& bound);

/// The detector in use: codebook and settings, swapped as a whole. A frame takes the pointer once and so sees one
/// consistent set; what is expensive is built aside, before the swap. Safe to use from several threads.
class DetectorSlot {
public:
  /// @param settings in force while there is no codebook; those bound to a codebook are then the codebook's own
  /// @throws sks::Error(bad_usage) if they are invalid
  explicit DetectorSlot(const sks::Settings& settings);

  /// The detector in use; null while there is no codebook.
  std::shared_ptr<const sks::Detector> detector() const;
  /// The settings in force; with a codebook those bound to it are the codebook's.
  sks::Settings settings() const;
  /// The settings to train with: those in force, but of the ones bound to a codebook what was set while there was none.
  sks::Settings trainingSettings() const;
  /// Where the codebook was loaded from or saved to; empty if nowhere.
  std::string codebookFile() const;
  /// Name and checksum of the codebook; empty without one.
  std::string codebookName() const;

  /// Swaps in a codebook; null takes it out. Takes as long as its matcher takes to build; frames and setSettings() do
  /// not wait for it. @throws sks::Error; the old one is then still in use
  void setCodebook(const std::shared_ptr<const sks::Codebook>& codebook, const std::string& file);
  /// Notes where a codebook was saved, if it is still the one in use.
  void setCodebookFile(const sks::Codebook& codebook, const std::string& file);

  /// Swaps in settings, validated as a whole. @throws sks::Error naming keys and values, also of settings bound to the
  /// codebook in use that would differ from it; the old ones are then still in force
  void setSettings(const sks::Settings& settings);

private:
  std::mutex building_;       // held while a detector is built aside: one codebook at a time
  mutable std::mutex mutex_;  // guards what follows; never held for long
  sks::Settings wanted_;
  std::shared_ptr<const sks::Detector> detector_;
  std::string codebook_file_;
};

}  // namespace sks_detector
