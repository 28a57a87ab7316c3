// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sks {

/// From now on all cores, where that many threads are asked for, are those of the machine over the number of processes
/// that share it, at least one. To be called before threads are started.
void shareCores(int processes);

}  // namespace sks
