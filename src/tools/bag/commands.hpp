// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>

namespace sks::tools {

void addBagInfo(CLI::App& bag);
void addBagExtract(CLI::App& bag);
void addBagEvaluate(CLI::App& bag);

}  // namespace sks::tools
