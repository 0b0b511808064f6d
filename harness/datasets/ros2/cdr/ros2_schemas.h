// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench::harness {

/// The definition of a type that is written, with those of all types in it, in the form "ros2msg":
/// what readers without ROS decode its messages by. Throws Error for another type.
std::string ros2_schema(const std::string& type);

}  // namespace vinebench::harness
