// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace vinebench::harness {

// Distribution functions, by Boost.Math. A sample size or number of events is a std::size_t, a
// degree of freedom or a parameter of shape a double above zero.

double student_t_cdf(double t, double degrees_of_freedom);
/// Requires 0 < probability < 1.
double student_t_quantile(double probability, double degrees_of_freedom);

/// Of (Z + shift) / sqrt(chi-squared / degrees of freedom). Beyond a shift of 1000 the value is
/// taken as proportional to it, because Z hardly counts (absolute error below 1e-3).
double noncentral_t_cdf(double t, double degrees_of_freedom, double shift);

/// At most `events` of `trials`, each with this probability.
double binomial_cdf(std::size_t events, std::size_t trials, double probability);
/// Exactly `events`.
double binomial_probability(std::size_t events, std::size_t trials, double probability);

/// Requires 0 < probability < 1.
double beta_quantile(double probability, double a, double b);

/// The probability of a larger value of Fisher's F.
double f_survival(double f, double numerator_degrees, double denominator_degrees);

}  // namespace vinebench::harness
