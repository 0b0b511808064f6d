// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/explanation_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace vinebench::harness {
namespace {

using OrderedJson = nlohmann::ordered_json;

double share_of(const Normal& normal, const Effect& effect) {
  const double drift = normal.chance.metres.typical();
  return drift > 0 ? effect.metres / drift : 0;
}

std::vector<std::string> texts(const Explanation& explanation,
                               const std::vector<std::size_t>& factors) {
  std::vector<std::string> list;
  for (const std::size_t i : factors) list.push_back(explanation.factors[i].text);
  return list;
}

std::string names(const Explanation& explanation, const std::vector<std::size_t>& factors) {
  std::vector<std::string> list;
  for (const std::size_t i : factors) list.push_back(explanation.factors[i].name);
  return fmt::format("{}", fmt::join(list, " + "));
}

std::string cause_sentence(const Explanation& explanation, const std::vector<std::size_t>& causes) {
  if (!causes.empty()) {
    return fmt::format("caused by {}", fmt::join(texts(explanation, causes), ", and by "));
  }
  return explanation.factors.empty() ? "the scenario has no factor that could be taken away"
                                     : "no factor explains it beyond chance";
}

const char* verdict_of(const Effect& effect) {
  if (effect.is_cause()) return "cause";
  return effect.is_open ? "chance could do it" : "";
}

std::string row(const Explanation& explanation, const Normal& normal, const FactorEffect& one,
                const std::string& remark) {
  return fmt::format("  {:<32} {:>9.1f} {:>7.0f} % {:>7.1f}   {}{}\n",
                     names(explanation, one.factors), 1e3 * one.effect.metres,
                     100 * share_of(normal, one.effect), one.effect.lost, remark,
                     one.from_start ? " (absent from the start)" : "");
}

std::string interaction_text(const FactorEffect& pair) {
  return fmt::format("interaction {:+.1f} mm", 1e3 * pair.interaction.metres);
}

std::vector<FactorEffect> strongest_first(std::vector<FactorEffect> list) {
  std::ranges::stable_sort(list, std::greater(), [](const FactorEffect& one) {
    return std::pair(one.effect.is_cause(), one.effect.metres);
  });
  return list;
}

std::string heading(const char* runs, const char* difference) {
  return fmt::format("  {:<32} {:>9} {:>9} {:>7}\n", runs, difference, "share", "frames");
}

std::string format_singles(const Explanation& explanation, const Look& look) {
  std::string text = heading("without", "mm less");
  for (const FactorEffect& one : strongest_first(look.singles)) {
    text += row(explanation, look.normal, one, verdict_of(one.effect));
  }
  return text;
}

/// Shares are of the drift of the look, as those of singles.
std::string format_alone(const Explanation& explanation, const Look& look) {
  if (look.alone.empty()) return "";
  std::string text = heading("with no other than", "mm more");
  for (const FactorEffect& one : strongest_first(look.alone)) {
    text += row(explanation, look.normal, one,
                one.effect.is_cause() ? "would do" : verdict_of(one.effect));
  }
  return text;
}

std::string format_remainder(const Explanation& explanation, const Look& rest) {
  const AsItWas& chance = rest.normal.chance;
  return fmt::format("  left without {}: {:.1f} +- {:.1f} mm, {:.0f} frames lost; {}\n",
                     names(explanation, rest.normal.without), 1e3 * chance.metres.typical(),
                     1e3 * chance.metres.deviation(), chance.lost.typical(),
                     cause_sentence(explanation, rest.causes)) +
         format_singles(explanation, rest) + format_alone(explanation, rest);
}

std::string format_stretch(const Explanation& explanation, const StretchExplanation& stretch,
                           double rate_hz) {
  const auto seconds = [&](std::int64_t frame) { return static_cast<double>(frame) / rate_hz; };
  const Look& first = stretch.looks.front();
  const Chance& metres = first.normal.chance.metres;
  std::string text = fmt::format("stretch {}, {:.2f} to {:.2f} s: {}\n", stretch.stretch.number,
                                 seconds(stretch.stretch.first), seconds(stretch.stretch.last),
                                 cause_sentence(explanation, stretch.causes()));
  text += fmt::format(
      "  drift since {:.2f} s: {:.1f} mm (with other noise {:.1f} +- {:.1f} mm), {:.0f} frames "
      "lost; beyond chance: {:.1f} mm\n",
      seconds(stretch.aligned), 1e3 * stretch.was.metres, 1e3 * metres.typical(),
      1e3 * metres.deviation(), stretch.was.lost, 1e3 * metres.limit());
  if (!stretch.stretch.coincide.empty()) {
    text += fmt::format("  what coincides: {}\n", fmt::join(stretch.stretch.coincide, ", "));
  }
  if (first.singles.empty()) return text;
  text += format_singles(explanation, first);
  for (const FactorEffect& pair : strongest_first(stretch.pairs)) {
    text += row(explanation, first.normal, pair, interaction_text(pair));
  }
  if (first.singles.size() > 1) {
    const Effect& all = stretch.all->effect;
    text += fmt::format("  {:<32} {:>9.1f} {:>7.0f} % {:>7.1f}\n", "all of them", 1e3 * all.metres,
                        100 * share_of(first.normal, all), all.lost);
  }
  text += format_alone(explanation, first);
  for (std::size_t i = 1; i < stretch.looks.size(); ++i) {
    text += format_remainder(explanation, stretch.looks[i]);
  }
  return text;
}

OrderedJson reruns_json(const std::vector<StretchDrift>& reruns) {
  OrderedJson json = OrderedJson::array();
  for (const StretchDrift& drift : reruns) {
    json.push_back(
        {{"drift_m", drift.metres}, {"end_drift_m", drift.end}, {"lost_frames", drift.lost}});
  }
  return json;
}

OrderedJson names_json(const Explanation& explanation, const std::vector<std::size_t>& factors) {
  OrderedJson json = OrderedJson::array();
  for (const std::size_t i : factors) json.push_back(explanation.factors[i].name);
  return json;
}

OrderedJson effect_json(const Explanation& explanation, const FactorEffect& one) {
  OrderedJson json{{"without", names_json(explanation, one.factors)},
                   {"from_start", one.from_start},
                   {"reruns", reruns_json(one.reruns)},
                   {"caused_m", one.effect.metres},
                   {"caused_lost_frames", one.effect.lost},
                   {"cause", one.effect.is_cause()}};
  if (one.factors.size() == 2) json["interaction_m"] = one.interaction.metres;
  return json;
}

OrderedJson alone_json(const Explanation& explanation, const FactorEffect& one) {
  return {{"with", names_json(explanation, one.factors)},
          {"reruns", reruns_json(one.reruns)},
          {"added_m", one.effect.metres},
          {"added_lost_frames", one.effect.lost},
          {"cause", one.effect.is_cause()}};
}

OrderedJson chance_json(const Chance& metres) {
  return {{"runs", metres.runs()},
          {"median_m", metres.typical()},
          {"deviation_m", metres.deviation()},
          {"limit_m", metres.limit()}};
}

/// "factors", and "alone" where they were tried.
void add_effects(const Explanation& explanation, const Look& look, OrderedJson& json) {
  json["factors"] = OrderedJson::array();
  for (const FactorEffect& one : look.singles) {
    json["factors"].push_back(effect_json(explanation, one));
  }
  for (const FactorEffect& one : look.alone) json["alone"].push_back(alone_json(explanation, one));
}

OrderedJson remainder_json(const Explanation& explanation, const Look& rest) {
  OrderedJson json{{"without", names_json(explanation, rest.normal.without)},
                   {"causes", names_json(explanation, rest.causes)},
                   {"chance", chance_json(rest.normal.chance.metres)},
                   {"median_lost_frames", rest.normal.chance.lost.typical()}};
  add_effects(explanation, rest, json);
  return json;
}

OrderedJson stretch_json(const Explanation& explanation, const StretchExplanation& stretch,
                         double rate_hz) {
  const auto seconds = [&](std::int64_t frame) { return static_cast<double>(frame) / rate_hz; };
  const Look& first = stretch.looks.front();
  OrderedJson json{{"stretch", stretch.stretch.number},
                   {"from", seconds(stretch.stretch.first)},
                   {"until", seconds(stretch.stretch.last)},
                   {"drift_since", seconds(stretch.aligned)},
                   {"causes", names_json(explanation, stretch.causes())},
                   {"coincide", stretch.stretch.coincide},
                   {"drift_m", stretch.was.metres},
                   {"end_drift_m", stretch.was.end},
                   {"lost_frames", stretch.was.lost},
                   {"chance", chance_json(first.normal.chance.metres)}};
  add_effects(explanation, first, json);
  json["pairs"] = OrderedJson::array();
  for (const FactorEffect& one : stretch.pairs) {
    json["pairs"].push_back(effect_json(explanation, one));
  }
  if (stretch.all) json["without_all"] = effect_json(explanation, *stretch.all);
  for (std::size_t i = 1; i < stretch.looks.size(); ++i) {
    json["remainders"].push_back(remainder_json(explanation, stretch.looks[i]));
  }
  return json;
}

}  // namespace

std::string format_explanation(const Explanation& explanation, double rate_hz) {
  std::string text;
  for (const StretchExplanation& stretch : explanation.stretches) {
    text += format_stretch(explanation, stretch, rate_hz);
  }
  return text;
}

nlohmann::ordered_json to_json(const Explanation& explanation, double rate_hz) {
  OrderedJson json{{"reruns", explanation.reruns}, {"stretches", OrderedJson::array()}};
  for (const StretchExplanation& stretch : explanation.stretches) {
    json["stretches"].push_back(stretch_json(explanation, stretch, rate_hz));
  }
  return json;
}

}  // namespace vinebench::harness
