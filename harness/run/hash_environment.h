// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/util/arithmetic.h"

namespace vinebench::harness {

/// What a run's hash may depend on beside scenario, seed and build: what computes in this process
/// (core/util/arithmetic.h), and libraries with their versions; and the processor, for information.
NamedValues hash_environment(const NamedValues& libraries);

/// Names of the values in which two environments differ, without the processor, such as "libm,
/// blas". Hashes are comparable if there is none.
std::string environment_differences(const NamedValues& a, const NamedValues& b);

}  // namespace vinebench::harness
