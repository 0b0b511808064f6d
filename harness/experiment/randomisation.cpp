// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/randomisation.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/config/yaml.h"
#include "core/util/random.h"

namespace vinebench::harness {
namespace {

struct RandomisationConfig {
  struct Draw {
    std::string key;  ///< dotted, of the scenario: world.sun.elevation_deg
    std::optional<std::array<double, 2>> uniform;        ///< least, most
    std::optional<std::array<double, 2>> log_uniform;    ///< likewise, both above 0
    std::optional<std::array<double, 2>> normal;         ///< mean, standard deviation
    std::optional<std::array<std::int64_t, 2>> integer;  ///< least, most, both included
    std::vector<std::string> choice;                     ///< YAML values
    std::vector<std::filesystem::path> file;  ///< a choice of files, relative to this one
    std::vector<double> weights;              ///< of the choice; equal if absent
    std::optional<double> min;                ///< of normal
    std::optional<double> max;                ///< likewise
    template <class Archive>
    void serialize(Archive& archive) {
      archive("key", key);
      archive("uniform", uniform);
      archive("log_uniform", log_uniform, Range::positive());
      archive("normal", normal);
      archive("integer", integer);
      archive("choice", choice);
      archive("file", file);
      archive("weights", weights, Range::non_negative());
      archive("min", min);
      archive("max", max);
      check(archive);
    }
    /// What is chosen from; empty for numbers.
    std::vector<std::string> choices() const {
      std::vector<std::string> all = choice;
      for (const std::filesystem::path& one : file) {
        all.push_back(std::filesystem::absolute(one).lexically_normal().string());
      }
      return all;
    }

   private:
    template <class Archive>
    void check(Archive& archive) const {
      archive.require(!key.empty(), "key", "expected a key of the scenario");
      const int kinds = int(uniform.has_value()) + int(log_uniform.has_value()) +
                        int(normal.has_value()) + int(integer.has_value()) + int(!choice.empty()) +
                        int(!file.empty());
      archive.require(
          kinds == 1, "key",
          "expected exactly one of uniform, log_uniform, normal, integer, choice, file");
      const auto ascends = [&](const auto& span, const char* name) {
        if (span) archive.require((*span)[0] <= (*span)[1], name, "expected [least, most]");
      };
      ascends(uniform, "uniform");
      ascends(log_uniform, "log_uniform");
      ascends(integer, "integer");
      if (normal) archive.require((*normal)[1] >= 0, "normal", "expected [mean, deviation >= 0]");
      archive.require(normal || (!min && !max), "min", "min and max require normal");
      double sum = 0;
      for (const double weight : weights) sum += weight;
      archive.require(weights.empty() || (weights.size() == choices().size() && sum > 0), "weights",
                      "expected one for each choice, not all 0");
    }
  };
  std::vector<Draw> draws;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("draws", draws);
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const auto same = [&](const Draw& other) { return other.key == draws[i].key; };
      archive.require(std::ranges::count_if(draws, same) == 1, fmt::format("draws.{}.key", i),
                      "duplicate key");
    }
  }
};

using Draw = RandomisationConfig::Draw;

std::string chosen(const Draw& draw, double share) {
  const std::vector<std::string> choices = draw.choices();
  double sum = 0;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    sum += draw.weights.empty() ? 1 : draw.weights[i];
  }
  double left = share * sum;
  for (std::size_t i = 0; i + 1 < choices.size(); ++i) {
    left -= draw.weights.empty() ? 1 : draw.weights[i];
    if (left < 0) return choices[i];
  }
  return choices.back();
}

std::string value_of(const Draw& draw, const RandomStream& stream) {
  if (draw.uniform) {
    return fmt::format("{}", stream.uniform(0, (*draw.uniform)[0], (*draw.uniform)[1]));
  }
  if (draw.log_uniform) {
    const auto [least, most] = *draw.log_uniform;
    return fmt::format("{}", std::exp(stream.uniform(0, std::log(least), std::log(most))));
  }
  if (draw.normal) {
    const double value = (*draw.normal)[0] + (*draw.normal)[1] * stream.normal(0);
    const double least = draw.min.value_or(value);
    return fmt::format("{}",
                       std::min(std::max(value, least), draw.max.value_or(std::max(value, least))));
  }
  if (draw.integer) {
    const auto [least, most] = *draw.integer;
    const double count = static_cast<double>(most - least) + 1;
    return fmt::format("{}", least + static_cast<std::int64_t>(stream.uniform(0) * count));
  }
  return chosen(draw, stream.uniform(0));
}

/// The values that these seeds draw.
std::vector<std::string> values_of(const Draw& draw, const std::vector<std::int64_t>& seeds) {
  std::vector<std::string> values;
  for (const std::int64_t seed : seeds) {
    values.push_back(value_of(
        draw, RandomStream(static_cast<std::uint64_t>(seed), "randomisation." + draw.key)));
  }
  return values;
}

std::string narrowed_choice(const char* kind, const std::vector<std::string>& values) {
  std::vector<std::string> choice = values;
  std::ranges::sort(choice);
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  std::vector<std::ptrdiff_t> weights;
  for (const std::string& value : choice) weights.push_back(std::ranges::count(values, value));
  return fmt::format("{}: [{}], weights: [{}]", kind, fmt::join(choice, ", "),
                     fmt::join(weights, ", "));
}

std::string narrowed_normal(const Draw& draw, const std::vector<double>& values) {
  double mean = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  double variance = 0;
  for (const double value : values) {
    variance += (value - mean) * (value - mean) / static_cast<double>(values.size());
  }
  std::string text = fmt::format("normal: [{:.6g}, {:.6g}]", mean, std::sqrt(variance));
  if (draw.min) text += fmt::format(", min: {}", *draw.min);
  if (draw.max) text += fmt::format(", max: {}", *draw.max);
  return text;
}

/// The distribution of a draw that is left of these values.
std::string narrowed(const Draw& draw, const std::vector<std::string>& values) {
  if (!draw.choice.empty()) return narrowed_choice("choice", values);
  if (!draw.file.empty()) return narrowed_choice("file", values);
  std::vector<double> numbers;
  for (const std::string& value : values) numbers.push_back(std::stod(value));
  if (draw.normal) return narrowed_normal(draw, numbers);
  const auto [least, most] = std::ranges::minmax(numbers);
  const char* kind = draw.uniform ? "uniform" : draw.log_uniform ? "log_uniform" : "integer";
  return fmt::format("{}: [{:.6g}, {:.6g}]", kind, least, most);
}

}  // namespace

std::string narrowed_randomisation(const std::filesystem::path& file,
                                   const std::vector<std::int64_t>& seeds) {
  std::string text = "draws:\n";
  for (const Draw& draw : YamlDocument::load(file).read<RandomisationConfig>().draws) {
    text += fmt::format("  - {{key: {}, {}}}\n", draw.key, narrowed(draw, values_of(draw, seeds)));
  }
  return text;
}

std::vector<Override> draw_overrides(const std::filesystem::path& file, std::int64_t seed) {
  const auto config = YamlDocument::load(file).read<RandomisationConfig>();
  std::vector<Override> overrides;
  for (const Draw& draw : config.draws) {
    const RandomStream stream(static_cast<std::uint64_t>(seed), "randomisation." + draw.key);
    overrides.emplace_back(draw.key, value_of(draw, stream));
  }
  return overrides;
}

ScenarioConfig load_drawn_scenario(const std::filesystem::path& file,
                                   std::vector<Override> overrides,
                                   const std::filesystem::path& randomisation,
                                   std::optional<std::int64_t> seed) {
  if (!randomisation.empty()) {
    const std::int64_t drawn_by = seed ? *seed : load_scenario(file, overrides).seed;
    for (Override& o : draw_overrides(randomisation, drawn_by)) overrides.push_back(std::move(o));
  }
  ScenarioConfig scenario = load_scenario(file, overrides);
  if (seed) scenario.seed = *seed;
  return scenario;
}

std::vector<ConfigField> randomisation_fields() {
  return list_fields<RandomisationConfig>();
}

}  // namespace vinebench::harness
