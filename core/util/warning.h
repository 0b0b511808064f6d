// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace vinebench {

using WarningSink = std::function<void(const std::string&)>;

/// Where warnings go: a program's standard error, a test's list. Without one they are dropped, for
/// a library never prints. Returns the sink before; all warnings may then be given again.
WarningSink set_warning_sink(WarningSink sink);

/// Hands a warning to the sink: something given was left out, with file and reason, and nothing
/// fails for it. The same text is given once. May be called from any thread.
void warn(const std::string& text);

}  // namespace vinebench
