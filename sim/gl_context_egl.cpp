// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/gl_context.h"
#include "slam/base/error.h"

namespace vinebench {

std::unique_ptr<GlContext> make_egl_context() {
  fail("VINEBENCH_GL=egl: this build has no EGL");
}

}  // namespace vinebench
