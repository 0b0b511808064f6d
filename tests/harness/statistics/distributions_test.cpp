// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/distributions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::harness {
namespace {

// Printed tables have 97.5 % quantiles of 12.7062 (1), 2.2281 (10), 2.0423 (30), 1.9600 (many).
TEST(DistributionsTest, StudentsTIsThatOfTheTables) {
  EXPECT_NEAR(student_t_quantile(0.975, 1), 12.7062, 5e-5);
  EXPECT_NEAR(student_t_quantile(0.975, 10), 2.2281, 5e-5);
  EXPECT_NEAR(student_t_quantile(0.975, 30), 2.0423, 5e-5);
  EXPECT_NEAR(student_t_quantile(0.975, 1e6), 1.9600, 5e-5);
  EXPECT_NEAR(student_t_cdf(2.2281, 10), 0.975, 1e-5);
}

// With one degree of freedom it is Cauchy's: 1/2 + atan(t) / pi.
TEST(DistributionsTest, OneDegreeOfFreedomIsCauchys) {
  EXPECT_NEAR(student_t_cdf(-3, 1), 0.5 - std::atan(3.0) / M_PI, 1e-12);
}

// At t = 0 the sign of Z + shift alone counts: P(Z < -shift).
TEST(DistributionsTest, TheNoncentralTIsShifted) {
  EXPECT_NEAR(noncentral_t_cdf(0, 5, 1.96), 0.0249979, 1e-6);
  EXPECT_NEAR(noncentral_t_cdf(0, 5, -1.96), 1 - 0.0249979, 1e-6);
  EXPECT_DOUBLE_EQ(noncentral_t_cdf(1.5, 7, 0), student_t_cdf(1.5, 7));
  // At a shift of 2000, 2 Z in 1000 at most: P(T <= 2000) = P(chi-squared / 1 >= 1) = P(|Z| >= 1).
  EXPECT_NEAR(noncentral_t_cdf(2000, 1, 2000), 0.3173, 1e-3);
  EXPECT_NEAR(noncentral_t_cdf(-2000, 1, -2000), 1 - 0.3173, 1e-3);
}

// Of three coins: 1, 3, 3, 1 in eighths.
TEST(DistributionsTest, TheBinomialCounts) {
  EXPECT_NEAR(binomial_cdf(0, 3, 0.5), 1.0 / 8, 1e-15);
  EXPECT_NEAR(binomial_cdf(1, 3, 0.5), 4.0 / 8, 1e-15);
  EXPECT_EQ(binomial_cdf(3, 3, 0.5), 1);
  EXPECT_NEAR(binomial_probability(2, 3, 0.5), 3.0 / 8, 1e-15);
  EXPECT_NEAR(binomial_probability(0, 4, 0), 1, 1e-15);
}

// Beta(1, n) has the distribution 1 - (1 - x)^n. F with (2, d) has the survival (1 + 2 f /
// d)^(-d/2).
TEST(DistributionsTest, BetaAndFAgreeWithTheirClosedForms) {
  EXPECT_NEAR(beta_quantile(0.975, 1, 20), 1 - std::pow(0.025, 1.0 / 20), 1e-12);
  EXPECT_NEAR(f_survival(3, 2, 12), std::pow(1 + 2 * 3.0 / 12, -6), 1e-12);
}

}  // namespace
}  // namespace vinebench::harness
