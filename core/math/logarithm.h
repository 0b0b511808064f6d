// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vinebench::elementary {

/// A number as an unevaluated sum.
struct ExtendedSum {
  long double high;
  long double low;
};

/// ln(x) of a positive, finite x with about 75 bits.
ExtendedSum log_extended(long double x);

}  // namespace vinebench::elementary
