// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/explanation_text.h"

#include <gmock/gmock.h>

namespace vinebench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

StretchDrift steady_drift(double metres) {
  return {.metres = metres, .end = metres};
}

FactorEffect without(const AsItWas& was, std::vector<std::size_t> factors, double rest) {
  FactorEffect one{.factors = std::move(factors), .without = {steady_drift(rest)}};
  one.effect = effect_of(was, one.without);
  return one;
}

/// Of 20 mm, 16 mm are the wind's, at 10 Hz from 4 s to 6 s.
Explanation windy() {
  Explanation explanation;
  explanation.factors = {{.name = "noise", .text = "noise of the images"},
                         {.name = "wind", .text = "wind in the plants"}};
  StretchExplanation stretch;
  stretch.stretch = {.number = 2, .first = 40, .last = 60, .coincide = {"little texture"}};
  stretch.aligned = 19;
  stretch.was = steady_drift(0.0205);
  stretch.chance = as_it_was({steady_drift(0.02), steady_drift(0.0205), steady_drift(0.0195)});
  stretch.singles = {without(stretch.chance, {0}, 0.021), without(stretch.chance, {1}, 0.004)};
  stretch.all = without(stretch.chance, {0, 1}, 0.003);
  stretch.causes = {1};
  explanation.stretches = {stretch};
  return explanation;
}

TEST(ExplanationTextTest, NamesTheCauseFirstAndTheFactorsByStrength) {
  const std::string text = format_explanation(windy(), 10);
  EXPECT_THAT(text,
              testing::StartsWith("stretch 2, 4.00 to 6.00 s: caused by wind in the plants\n"));
  EXPECT_THAT(text, HasSubstr("drift since 1.90 s: 20.5 mm"));
  EXPECT_THAT(text, HasSubstr("what coincides: little texture"));
  EXPECT_THAT(text, HasSubstr("16.0      80 %"));
  EXPECT_LT(text.find("\n  wind"), text.find("\n  noise"));
}

TEST(ExplanationTextTest, SaysThatNothingExplainsIt) {
  Explanation explanation = windy();
  explanation.stretches[0].causes.clear();
  EXPECT_THAT(format_explanation(explanation, 10), HasSubstr("no factor explains it"));
  explanation.factors.clear();
  explanation.stretches[0].singles.clear();
  explanation.stretches[0].all.reset();
  EXPECT_THAT(format_explanation(explanation, 10), HasSubstr("the scenario has no factor"));
}

TEST(ExplanationTextTest, JsonHasMetresAndSeconds) {
  const auto json = to_json(windy(), 10).at("stretches").at(0);
  EXPECT_EQ(json.at("stretch"), 2);
  EXPECT_EQ(json.at("from"), 4.0);
  EXPECT_EQ(json.at("causes").at(0), "wind");
  EXPECT_NEAR(json.at("factors").at(1).at("caused_m").get<double>(), 0.016, 1e-9);
  EXPECT_EQ(json.at("factors").at(1).at("without").at(0), "wind");
  EXPECT_EQ(json.at("factors").at(1).at("cause"), true);
  EXPECT_EQ(json.at("without_all").at("without").size(), 2u);
}

}  // namespace
}  // namespace vinebench::harness
