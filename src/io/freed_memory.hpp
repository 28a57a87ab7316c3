// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace sks {

/// Gives memory that was freed in small pieces back to the system, so that what follows takes it in place of more.
inline void returnFreedMemory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace sks
