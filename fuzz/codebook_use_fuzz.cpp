// SPDX-License-Identifier: BSD-3-Clause
// Detection with any codebook that is accepted.
#include <sks_detector/detector.hpp>

#include "codebook_file.hpp"
#include "small_codebook.hpp"

namespace {

/// Free settings may ask for any amount of work.
sks::Settings withQuickStages(sks::Settings settings) {
  const sks::Settings quick = sks::fuzz::smallSettings();
  settings.threads = quick.threads;
  settings.ransac = quick.ransac;
  settings.refinement = quick.refinement;
  settings.verification = quick.verification;
  settings.voting = quick.voting;
  settings.matching = quick.matching;
  settings.detection.hypotheses = quick.detection.hypotheses;
  return settings;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sks::Cloud cloud = sks::fuzz::smallView();
  const auto codebook = sks::fuzz::readCodebookFile(data, size);
  if (!codebook) return 0;
  sks::fuzz::refused([&] {
    const sks::Detector detector(codebook, withQuickStages(codebook->settings));
    for (const sks::Detection& detection : detector.detect(cloud).detections) {
      sks::fuzz::require(detection.score >= 0 && detection.score <= 1, "a score lies in [0, 1]");
    }
  });
  return 0;
}
