// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// The one file that includes Boost.Math, which takes seconds to compile.
#include "harness/statistics/distributions.h"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace vinebench::harness {
namespace {

constexpr double kLargeShift = 1000;

}  // namespace

double student_t_cdf(double t, double degrees_of_freedom) {
  return boost::math::cdf(boost::math::students_t(degrees_of_freedom), t);
}

double student_t_quantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), probability);
}

double noncentral_t_cdf(double t, double degrees_of_freedom, double shift) {
  if (shift == 0) return student_t_cdf(t, degrees_of_freedom);
  if (std::abs(shift) > kLargeShift) {
    t *= kLargeShift / std::abs(shift);
    shift = std::copysign(kLargeShift, shift);
  }
  return boost::math::cdf(boost::math::non_central_t(degrees_of_freedom, shift), t);
}

double binomial_cdf(std::size_t events, std::size_t trials, double probability) {
  if (events >= trials) return 1;
  const boost::math::binomial distribution(static_cast<double>(trials), probability);
  return boost::math::cdf(distribution, static_cast<double>(events));
}

double binomial_probability(std::size_t events, std::size_t trials, double probability) {
  const boost::math::binomial distribution(static_cast<double>(trials), probability);
  return boost::math::pdf(distribution, static_cast<double>(events));
}

double beta_quantile(double probability, double a, double b) {
  return boost::math::quantile(boost::math::beta_distribution<>(a, b), probability);
}

double f_survival(double f, double numerator_degrees, double denominator_degrees) {
  const boost::math::fisher_f distribution(numerator_degrees, denominator_degrees);
  return boost::math::cdf(boost::math::complement(distribution, f));
}

}  // namespace vinebench::harness
