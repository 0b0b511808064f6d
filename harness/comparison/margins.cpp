// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/margins.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

/// Empty unless the whole text is a finite number above zero.
std::optional<double> positive_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) && value > 0 ? std::optional(value) : std::nullopt;
}

/// "5%" as 0.05; empty if it is not a percentage.
std::optional<double> share_of(const std::string& text) {
  if (!text.ends_with('%')) return std::nullopt;
  const auto percent = positive_number(text.substr(0, text.size() - 1));
  return percent && *percent < 100 ? std::optional(*percent / 100) : std::nullopt;
}

}  // namespace

Margin Margins::of(const Metric& metric) const {
  const auto found = own.find(metric.key);
  return found == own.end() ? common : found->second;
}

Margins parse_margins(const std::vector<std::string>& texts, const std::string& option) {
  Margins margins;
  for (const std::string& text : texts) {
    if (text.find('=') != std::string::npos) continue;
    const auto share = share_of(text);
    if (!share) {
      fail(
          "{}: expected a percentage above 0% and below 100%, such as 5%, or METRIC=VALUE, found "
          "'{}'",
          option, text);
    }
    margins.common.share = *share;
  }
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) continue;
    const Metric& metric = metric_named(text.substr(0, equals));
    Margin& margin = margins.own.try_emplace(metric.key, margins.common).first->second;
    const std::string value = text.substr(equals + 1);
    if (const auto share = share_of(value)) {
      margin.share = *share;
    } else if (const auto absolute = positive_number(value)) {
      margin.absolute = *absolute;
    } else {
      fail("{} {}: expected a percentage below 100% or a number above 0 ({}), found '{}'", option,
           name_of(metric), metric.title, value);
    }
  }
  return margins;
}

std::vector<Metric> parse_metrics(const std::vector<std::string>& names) {
  std::vector<Metric> metrics;
  for (const std::string& name : names) {
    if (std::ranges::count(metrics, metric_named(name).key, &Metric::key) > 0) {
      fail("metric '{}': is repeated", name);
    }
    metrics.push_back(metric_named(name));
  }
  if (!metrics.empty()) return metrics;
  metrics.push_back(metric_named("passed"));
  metrics.insert(metrics.end(), shown_metrics().begin(), shown_metrics().end());
  return metrics;
}

}  // namespace vinebench::harness
