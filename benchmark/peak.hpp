// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sks::bench {

/// Floating point operations a second that one core reaches with multiply-adds on registers alone, with the widest
/// vectors that it has. An addition is one operation, a multiply-add two.
double peakOperationsPerSecond();

}  // namespace sks::bench
