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
  FactorEffect one{.factors = std::move(factors), .reruns = {steady_drift(rest)}};
  one.effect = effect_of(was, one.reruns);
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
  Look look;
  look.normal.chance = as_it_was({steady_drift(0.02), steady_drift(0.0205), steady_drift(0.0195)});
  look.singles = {without(look.normal.chance, {0}, 0.021), without(look.normal.chance, {1}, 0.004)};
  look.causes = {1};
  stretch.looks = {look};
  stretch.all = without(look.normal.chance, {0, 1}, 0.003);
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

/// Without the wind 4 mm are left, of which the noise is 3.5.
Explanation windy_and_noisy() {
  Explanation explanation = windy();
  Look rest{.normal = {.without = {1}}};
  rest.normal.chance = as_it_was({steady_drift(0.004), steady_drift(0.0042), steady_drift(0.0039)});
  rest.singles = {without(rest.normal.chance, {0}, 0.0005)};
  rest.causes = {0};
  explanation.stretches[0].looks.push_back(rest);
  return explanation;
}

TEST(ExplanationTextTest, SaysWhatIsLeftWithoutTheFirstCause) {
  const std::string text = format_explanation(windy_and_noisy(), 10);
  EXPECT_THAT(text, HasSubstr("caused by wind in the plants, and by noise of the images\n"));
  const std::size_t rest = text.find(
      "  left without wind: 4.0 +- 0.2 mm, 0 frames lost; caused by noise of the images\n");
  ASSERT_NE(rest, std::string::npos) << text;
  EXPECT_NE(text.find("3.5      88 %", rest), std::string::npos) << text;  // 3.5 of 4.0 mm
  Explanation explanation = windy_and_noisy();
  explanation.stretches[0].looks[1].causes.clear();
  EXPECT_THAT(format_explanation(explanation, 10),
              HasSubstr("lost; no factor explains it beyond chance\n"));
}

TEST(ExplanationTextTest, SaysThatNothingExplainsIt) {
  Explanation explanation = windy();
  explanation.stretches[0].looks[0].causes.clear();
  EXPECT_THAT(format_explanation(explanation, 10), HasSubstr("no factor explains it"));
  explanation.factors.clear();
  explanation.stretches[0].looks[0].singles.clear();
  explanation.stretches[0].all.reset();
  EXPECT_THAT(format_explanation(explanation, 10), HasSubstr("the scenario has no factor"));
}

/// Neither wind nor noise takes anything away, and each would do.
Explanation windy_or_noisy() {
  Explanation explanation = windy();
  Look& look = explanation.stretches[0].looks[0];
  look.singles = {without(look.normal.chance, {0}, 0.02), without(look.normal.chance, {1}, 0.021)};
  look.alone = {{.factors = {0}, .effect = {.metres = 0.012, .drift_is_caused = true}},
                {.factors = {1}, .effect = {.metres = 0.016, .drift_is_caused = true}}};
  look.causes = {1, 0};
  return explanation;
}

TEST(ExplanationTextTest, SaysWhatWouldDoAlone) {
  const std::string text = format_explanation(windy_or_noisy(), 10);
  const std::size_t alone = text.find("  with no other than");
  ASSERT_NE(alone, std::string::npos) << text;
  EXPECT_NE(text.find("16.0      80 %     0.0   would do\n", alone), std::string::npos) << text;
  const auto json = to_json(windy_or_noisy(), 10).at("stretches").at(0).at("alone");
  EXPECT_EQ(json.at(0).at("with"), nlohmann::ordered_json({"noise"}));
  EXPECT_EQ(json.at(0).at("added_m"), 0.012);
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
  EXPECT_FALSE(json.contains("remainders"));
}

TEST(ExplanationTextTest, JsonHasWhatIsLeft) {
  const auto json = to_json(windy_and_noisy(), 10).at("stretches").at(0);
  EXPECT_EQ(json.at("causes"), nlohmann::ordered_json({"wind", "noise"}));
  const auto& rest = json.at("remainders").at(0);
  EXPECT_EQ(rest.at("without"), nlohmann::ordered_json({"wind"}));
  EXPECT_EQ(rest.at("causes"), nlohmann::ordered_json({"noise"}));
  EXPECT_NEAR(rest.at("chance").at("median_m").get<double>(), 0.004, 1e-9);
  EXPECT_NEAR(rest.at("factors").at(0).at("caused_m").get<double>(), 0.0035, 1e-9);
}

}  // namespace
}  // namespace vinebench::harness
