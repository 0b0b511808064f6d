// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/margins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(MarginsTest, OneForAllAndOnesOfTheirOwn) {
  const Margins margins =
      parse_margins({"ate_rmse_m=2", "5%", "losses=20%", "losses=1"}, "--margin");
  EXPECT_DOUBLE_EQ(margins.of(metric_named("rpe_trans_percent")).share, 0.05);
  EXPECT_EQ(margins.of(metric_named("ate_rmse_m")).absolute, 2);
  EXPECT_DOUBLE_EQ(margins.of(metric_named("ate_rmse_m")).share, 0.05);
  EXPECT_DOUBLE_EQ(margins.of(metric_named("losses")).share, 0.2);
  EXPECT_EQ(margins.of(metric_named("losses")).absolute, 1);
  EXPECT_DOUBLE_EQ(parse_margins({}, "--margin").of(metric_named("losses")).share, 0.1);
}

TEST(MarginsTest, WhatIsNoMarginIsAnError) {
  const auto error = [](const std::string& text) {
    return test::error_of([&] { parse_margins({text}, "--margin"); });
  };
  EXPECT_THAT(error("5"), AllOf(HasSubstr("--margin"), HasSubstr("METRIC=VALUE, found '5'")));
  for (const char* text : {"0%", "-1%", "100%", "nan%", "%", "", "5 %", "1e999%"}) {
    EXPECT_THAT(error(text), HasSubstr("expected a percentage")) << text;
  }
  for (const char* value : {"", "0", "-2", "inf", "x", "200%", "2mm"}) {
    EXPECT_THAT(error(std::string("ate_rmse_m=") + value),
                HasSubstr("--margin ate_rmse_m: expected a percentage below 100% or a number above "
                          "0 (ATE, mm)"))
        << value;
  }
  EXPECT_THAT(error("ate_rmse=5%"), HasSubstr("did you mean 'ate_rmse_m'?"));
}

TEST(MarginsTest, MetricsByName) {
  EXPECT_EQ(parse_metrics({}).size(), shown_metrics().size() + 1);
  EXPECT_EQ(parse_metrics({}).front().key, kPassedKey);
  EXPECT_EQ(parse_metrics({"loop_closures.wrong"}).at(0).title, "loops wrong");
  EXPECT_THAT(test::error_of([] { parse_metrics({"losses", "losses"}); }), HasSubstr("repeated"));
  EXPECT_THAT(test::error_of([] { parse_metrics({"nothing"}); }), HasSubstr("expected one of"));
}

}  // namespace
}  // namespace vinebench::harness
