// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/searched_words.hpp"

#include <string>

#include <sks_detector/error.hpp>

namespace sks {

void SearchedWords::checkHistograms() const {
  for (std::size_t i = 0; i < floats_.rows() * floats_.cols(); ++i) {
    if (floats_.data()[i] >= 0 && floats_.data()[i] <= QuantizedDescriptors::largest_bin) continue;
    throw Error(ErrorCode::bad_data, "codeword " + std::to_string(i / floats_.cols()) + " is no histogram: bin " +
                                         std::to_string(i % floats_.cols()) + " is " +
                                         std::to_string(floats_.data()[i]));
  }
}

}  // namespace sks
