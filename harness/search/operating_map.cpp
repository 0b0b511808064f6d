// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/operating_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/files/csv_field.h"
#include "core/util/error.h"
#include "core/util/xml_text.h"
#include "harness/statistics/shares.h"

namespace vinebench::harness {
namespace {

constexpr double kAlpha = 0.05;
constexpr int kCell = 64;     // px
constexpr int kLeft = 190;    // px
constexpr int kTop = 54;      // px
constexpr int kBottom = 110;  // px
constexpr int kLegend = 420;  // px, of its longest line

double severity_of(std::size_t index, std::size_t size) {
  return std::round(static_cast<double>(index) / static_cast<double>(size - 1) / kSeverityStep) *
         kSeverityStep;
}

Condition condition_of(const SearchProblem& problem, const OperatingMap& map,
                       const OperatingMap::Cell& cell) {
  Condition condition{Severities(problem.space.difficulties.size())};
  condition.severities[map.across] = cell.across;
  condition.severities[map.up] = cell.up;
  return condition;
}

OperatingMap empty_map(std::size_t across, std::size_t up, std::size_t size) {
  if (across == up) fail("a map: expected two difficulties, not one twice");
  OperatingMap map{across, up, size, {}};
  for (std::size_t y = 0; y < size; ++y) {
    for (std::size_t x = 0; x < size; ++x) {
      map.cells.push_back({severity_of(x, size), severity_of(y, size)});
    }
  }
  return map;
}

void ask_cells(SearchRuns& runs, OperatingMap& map, const std::vector<std::size_t>& cells,
               std::int64_t seed) {
  std::vector<Query> queries;
  for (const std::size_t c : cells) {
    queries.push_back({condition_of(runs.problem(), map, map.cells[c]), Role::kSystem, seed});
  }
  const std::vector<Answer> answers = runs.ask(queries);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    OperatingMap::Cell& cell = map.cells[cells[k]];
    const RunVerdict verdict = answers[k].verdict;
    cell.impossible = cell.impossible || verdict == RunVerdict::kImpossible;
    cell.runs += verdict == RunVerdict::kPassed || verdict == RunVerdict::kFailed;
    cell.passed += verdict == RunVerdict::kPassed;
  }
}

bool differs(const OperatingMap::Cell& a, const OperatingMap::Cell& b) {
  return a.runs > 0 && b.runs > 0 && (a.passed > 0) != (b.passed > 0);
}

/// Those with a neighbour, also across a corner, of another verdict.
std::vector<std::size_t> at_the_edge(const OperatingMap& map) {
  std::vector<std::size_t> edge;
  for (std::size_t c = 0; c < map.cells.size(); ++c) {
    const std::size_t x = c % map.size;
    const std::size_t y = c / map.size;
    bool other = false;
    for (std::size_t v = y == 0 ? 0 : y - 1; v <= std::min(y + 1, map.size - 1); ++v) {
      for (std::size_t u = x == 0 ? 0 : x - 1; u <= std::min(x + 1, map.size - 1); ++u) {
        other = other || differs(map.cells[c], map.at(u, v));
      }
    }
    if (other) edge.push_back(c);
  }
  return edge;
}

Interval rate_of(const OperatingMap::Cell& cell) {
  return clopper_pearson(static_cast<std::size_t>(cell.passed), static_cast<std::size_t>(cell.runs),
                         kAlpha);
}

/// From red over yellow to green by the share that passed; paler where the rate is less sure.
std::string colour_of(const OperatingMap::Cell& cell) {
  if (cell.runs == 0) return "#dddddd";
  const double share = static_cast<double>(cell.passed) / cell.runs;
  const Interval rate = rate_of(cell);
  const double sure = 1.2 - 0.9 * (rate.high - rate.low);
  const auto mix = [&](double bad, double middle, double good) {
    const double pure =
        share < 0.5 ? bad + (middle - bad) * 2 * share : middle + (good - middle) * (2 * share - 1);
    return static_cast<int>(std::lround(255 + (pure - 255) * std::clamp(sure, 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(205, 240, 60), mix(60, 205, 160), mix(50, 90, 90));
}

/// "speed (route.acceleration, route.speed)".
std::string title_of(const Difficulty& difficulty) {
  std::string keys;
  for (const auto& [key, value] : values_at(difficulty, 1)) {
    keys += (keys.empty() ? "" : ", ") + key;
  }
  return difficulty.name + " (" + keys + ")";
}

/// What a difficulty sets at a severity, without its keys.
std::string label_of(const SearchSpace& space, std::size_t difficulty, double severity) {
  Severities severities(space.difficulties.size());
  severities[difficulty] = severity;
  std::string text;
  for (const auto& [key, value] : overrides_at(space, severities)) {
    text += (text.empty() ? "" : " ") + value;
  }
  return text.empty() ? "as it is" : text;
}

std::string label(double x, double y, const std::string& anchor, const std::string& text,
                  int size = 12) {
  return fmt::format(
      "<text x=\"{:.0f}\" y=\"{:.0f}\" font-size=\"{}\" text-anchor=\"{}\">{}</text>\n", x, y, size,
      anchor, xml_escaped(text));
}

std::string cell_svg(const OperatingMap::Cell& cell, double x, double y) {
  std::string text = "–";
  if (cell.runs > 0) text = fmt::format("{}/{}", cell.passed, cell.runs);
  if (cell.impossible) text = "×";
  return fmt::format(
             "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" fill=\"{}\" "
             "stroke=\"white\"/>\n",
             x, y, kCell, kCell, colour_of(cell)) +
         label(x + kCell / 2.0, y + kCell / 2.0 + 5, "middle", text, 14);
}

}  // namespace

std::vector<Query> lattice_queries(const SearchProblem& problem, std::size_t across, std::size_t up,
                                   std::size_t size, std::int64_t seed) {
  const OperatingMap map = empty_map(across, up, size);
  std::vector<Query> queries;
  for (const OperatingMap::Cell& cell : map.cells) {
    queries.push_back({condition_of(problem, map, cell), Role::kSystem, seed});
  }
  return queries;
}

OperatingMap map_envelope(SearchRuns& runs, std::size_t across, std::size_t up, std::size_t size,
                          const std::vector<std::int64_t>& seeds, const Tell& tell) {
  OperatingMap map = empty_map(across, up, size);
  std::vector<std::size_t> all(map.cells.size());
  for (std::size_t c = 0; c < all.size(); ++c) all[c] = c;
  ask_cells(runs, map, all, seeds.front());
  const std::vector<std::size_t> edge = at_the_edge(map);
  tell(fmt::format("{} of {} cells lie where the verdict changes", edge.size(), all.size()));
  for (std::size_t k = 1; k < seeds.size(); ++k) ask_cells(runs, map, edge, seeds[k]);
  return map;
}

std::string map_csv(const OperatingMap& map, const SearchSpace& space) {
  std::string text = fmt::format(
      "{},{},severity_across,severity_up,runs,passed,rate_low,rate_high\n",
      csv_field(space.difficulties[map.across].name), csv_field(space.difficulties[map.up].name));
  for (const OperatingMap::Cell& cell : map.cells) {
    const Interval rate = cell.runs > 0 ? rate_of(cell) : Interval{0, 1};
    text += fmt::format("{},{},{:.4f},{:.4f},{},{},{:.3f},{:.3f}\n",
                        csv_field(label_of(space, map.across, cell.across)),
                        csv_field(label_of(space, map.up, cell.up)), cell.across, cell.up,
                        cell.runs, cell.passed, rate.low, rate.high);
  }
  return text;
}

std::string map_svg(const OperatingMap& map, const SearchSpace& space, const std::string& title) {
  const int side = kCell * static_cast<int>(map.size);
  const int width = kLeft + std::max(side, kLegend) + 30;
  const int height = kTop + side + kBottom;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n",
      width, height);
  svg += label(12, 20, "start", title, 16);
  for (std::size_t y = 0; y < map.size; ++y) {
    const double top = kTop + kCell * static_cast<double>(map.size - 1 - y);
    svg += label(kLeft - 8, top + kCell / 2.0 + 4, "end", label_of(space, map.up, map.at(0, y).up));
    for (std::size_t x = 0; x < map.size; ++x) {
      svg += cell_svg(map.at(x, y), kLeft + kCell * static_cast<double>(x), top);
    }
  }
  for (std::size_t x = 0; x < map.size; ++x) {
    svg += label(kLeft + kCell * (static_cast<double>(x) + 0.5), kTop + side + 18, "middle",
                 label_of(space, map.across, map.at(x, 0).across));
  }
  svg += label(kLeft + side / 2.0, kTop + side + 42, "middle",
               title_of(space.difficulties[map.across]), 14);
  svg += label(12, kTop - 8, "start", title_of(space.difficulties[map.up]), 14);
  svg += label(kLeft, kTop + side + 70, "start",
               "runs that pass, of those made: green all, red none; paler where few tell");
  svg += label(kLeft, kTop + side + 88, "start", "× no such scenario, – not run");
  return svg + "</svg>\n";
}

}  // namespace vinebench::harness
