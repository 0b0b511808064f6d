// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vinebench::elementary {

/// e^(x + low) with 64 bits; `low` is less than an ulp of x. Arguments beyond +-11000 count as
/// these, whose results are infinite or zero as doubles.
long double exp_extended(long double x, long double low);

}  // namespace vinebench::elementary
