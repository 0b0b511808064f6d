// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/bounds.h"

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "core/config/yaml.h"
#include "harness/report/report_json.h"
#include "harness/report/stored_run.h"
#include "tests/support/documented_keys.h"

namespace vinebench::harness {
namespace {

/// Every metric has a value of its own.
RunReport every_metric() {
  constexpr double kDegree = std::numbers::pi / 180;
  RunReport report;
  RunResults& results = report.results;
  results.coverage = 0.5;
  results.losses = 2;
  Evaluation& corrected = results.corrected.emplace();
  corrected.ate.rmse = 0.03;
  corrected.origin.rmse = 0.04;
  corrected.rpe_trans_percent = 5;
  corrected.worst.error = 0.06;
  corrected.orientation = {{7 * kDegree, 8 * kDegree}, {9 * kDegree, 10 * kDegree}};
  corrected.world = WorldErrors{{.rmse = 0.11}, {{12 * kDegree, 0}, {13 * kDegree, 0}}};
  results.live_world = WorldErrors{{.rmse = 0.19}, {}};
  results.drift = Drift{.error = 0.14};
  results.end_error = 0.15;
  results.consistency = Consistency{.frames = 1, .nees_mean = 16};
  results.loops.closures.resize(37);
  for (std::size_t i = 0; i < 17; ++i) results.loops.closures[i].correct = true;
  results.loops.missed.resize(18);
  return report;
}

// A guard is derived from the files of runs, and applied to the results of a run.
TEST(BoundsTest, ResultsAndFileHaveTheSameValues) {
  const RunReport report = every_metric();
  const auto stored = stored_run(to_json(report));
  ASSERT_TRUE(stored);
  std::set<double> values;
  for (const Bound& bound : bounds()) {
    const auto measured = bound.measured(report.results);
    ASSERT_TRUE(measured) << bound.key;
    EXPECT_NEAR(stored->value(bound.metric).value_or(-1), *measured, 1e-12) << bound.key;
    values.insert(*measured);
  }
  EXPECT_EQ(values.size(), bounds().size() - 1);  // two bounds of the NEES
}

/// The keys of a configuration, in order.
struct Keys {
  template <class T>
  void operator()(const char* key, T&, const Range& = {}) {
    list.emplace_back(key);
  }
  void require(bool, const char*, const char*) {}
  std::vector<std::string> list;
};

TEST(BoundsTest, EveryKeyHasItsBound) {
  Keys keys;
  Expectations().serialize(keys);
  EXPECT_EQ(keys.list.size(), bounds().size() + 2);  // blind and median
  for (const Bound& bound : bounds()) {
    EXPECT_THAT(keys.list, testing::Contains(bound.key));
    YamlDocument document;
    document.set(bound.key, "1");
    const auto asked = document.read<Expectations>();
    for (const Bound& other : bounds()) {
      EXPECT_EQ(other.asked(asked).has_value(), &other == &bound) << bound.key << other.key;
    }
  }
}

template <class Config>
std::string list_of_keys() {
  Keys keys;
  Config().serialize(keys);
  return fmt::format("{{{}}}", fmt::join(keys.list, ", "));
}

TEST(BoundsTest, EveryKeyHasOneDefinition) {
  std::set<std::string> documented;
  for (const std::string& key : test::documented_keys("| key | met when |")) {
    EXPECT_TRUE(documented.insert(key).second) << key << " is defined twice";
  }
  std::set<std::string> expected{"blind: " + list_of_keys<Expectations::Blind>(),
                                 "median: " + list_of_keys<Expectations::Median>()};
  for (const Bound& bound : bounds()) expected.insert(bound.key);
  EXPECT_EQ(documented, expected);
}

TEST(BoundsTest, WhatWasNotMeasuredHasNoValue) {
  for (const Bound& bound : bounds()) {
    const bool always = bound.spread == Spread::kCount || bound.spread == Spread::kShare;
    EXPECT_EQ(bound.measured({}).has_value(), always) << bound.key;
  }
}

TEST(BoundsTest, CountsAreWholeNumbers) {
  EXPECT_EQ(text_of(bounds().at(1), 2), "2");
  EXPECT_EQ(text_of(bounds().at(2), 0.0123), "0.0123 m");
}

}  // namespace
}  // namespace vinebench::harness
