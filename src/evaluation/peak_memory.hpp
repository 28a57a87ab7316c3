// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sks {

/// Greatest resident size of this process so far [MiB].
double peakMemoryMb();

}  // namespace sks
