// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/realism.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/util/error.h"
#include "core/util/percentile.h"
#include "harness/realism/separability.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

StatisticComparison compare(const std::string& name, const std::vector<double>& real,
                            const std::vector<double>& ours) {
  StatisticComparison result{.name = name,
                             .low = percentile(real, 0.1),
                             .middle = percentile(real, 0.5),
                             .high = percentile(real, 0.9),
                             .ours = percentile(ours, 0.5)};
  const auto below = std::ranges::count_if(real, [&](double v) { return v < result.ours; });
  result.share = static_cast<double>(below) / static_cast<double>(real.size());
  return result;
}

/// How far from the middle of the real pictures, 0 to 0.5.
double oddness(const StatisticComparison& statistic) {
  return std::abs(statistic.share - 0.5);
}

}  // namespace

int Realism::inside() const {
  return static_cast<int>(std::ranges::count_if(statistics, &StatisticComparison::inside));
}

Realism compare_pictures(const PictureSet& real, const PictureSet& ours) {
  if (real.width != ours.width) {
    fail("{} and {}: expected pictures of one width, found {} and {} px", real.name, ours.name,
         real.width, ours.width);
  }
  Realism realism;
  realism.real = real.name;
  realism.ours = ours.name;
  for (const std::string& name : real.statistics()) {
    const std::vector<double> values = ours.values(name);
    if (!values.empty()) realism.statistics.push_back(compare(name, real.values(name), values));
  }
  realism.separability = separability(real, ours);
  return realism;
}

std::string format_realism(const Realism& realism) {
  std::vector<StatisticComparison> sorted = realism.statistics;
  std::ranges::stable_sort(sorted, std::greater(), oddness);
  std::string text =
      fmt::format("{} against {}\n  {:<20} {:>10} {:>10} {:>10} {:>10} {:>6}\n", realism.ours,
                  realism.real, "", "real 10 %", "median", "90 %", "ours", "at");
  for (const StatisticComparison& s : sorted) {
    text +=
        fmt::format("  {:<20} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>4.0f} %{}\n", s.name,
                    s.low, s.middle, s.high, s.ours, 100 * s.share, s.inside() ? "" : "  outside");
  }
  text += fmt::format("  {} of {} medians inside the real 10 to 90 % range; separability {}\n",
                      realism.inside(), realism.statistics.size(),
                      realism.separability ? fmt::format("{:.2f}", *realism.separability)
                                           : "unknown (too few pictures)");
  return text;
}

Json to_json(const Realism& realism) {
  Json statistics = Json::array();
  for (const StatisticComparison& s : realism.statistics) {
    statistics.push_back({{"name", s.name},
                          {"real_p10", s.low},
                          {"real_median", s.middle},
                          {"real_p90", s.high},
                          {"ours_median", s.ours},
                          {"share_below", s.share},
                          {"inside", s.inside()}});
  }
  return {{"real", realism.real},
          {"ours", realism.ours},
          {"inside", realism.inside()},
          {"of", realism.statistics.size()},
          {"separability", realism.separability ? Json(*realism.separability) : Json()},
          {"statistics", statistics}};
}

}  // namespace vinebench::harness
