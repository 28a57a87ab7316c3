// SPDX-License-Identifier: BSD-3-Clause
#include "ros/result_output.hpp"

namespace sks_detector {

std::vector<MakeResultOutput>& resultOutputs() {
  static std::vector<MakeResultOutput> outputs;
  return outputs;
}

}  // namespace sks_detector
