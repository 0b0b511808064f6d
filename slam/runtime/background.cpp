// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/background.h"

#include <sys/resource.h>

namespace vinebench::slam {

namespace {

/// On Linux a thread has a niceness of its own. So much more is a tenth of the time.
constexpr int kNicer = 10;

}  // namespace

void lower_priority_of_thread() {
  // Where it fails, the work is done all the same; above 19 it is 19.
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + kNicer);
}

}  // namespace vinebench::slam
