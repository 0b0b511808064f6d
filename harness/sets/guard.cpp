// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/guard.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>

#include "core/config/yaml_block.h"
#include "core/files/files.h"
#include "core/files/output_file.h"
#include "core/util/error.h"
#include "core/util/percentile.h"
#include "harness/experiment/scenario.h"
#include "harness/judge/consistency.h"
#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

constexpr int kDigits = 3;

/// Away from the median, to kDigits.
double rounded(double value, bool down) {
  if (value == 0) return 0;
  const double exponent = kDigits - 1 - std::floor(std::log10(std::abs(value)));
  const double scale = std::pow(10.0, std::abs(exponent));
  const double scaled = exponent >= 0 ? value * scale : value / scale;
  // What is a whole number but for the last bits stays it.
  const double whole = down ? std::floor(scaled + 1e-9) : std::ceil(scaled - 1e-9);
  return exponent >= 0 ? whole / scale : whole * scale;
}

double value_of(const GuardBound& of) {
  const bool least = of.bound->at_least;
  switch (of.bound->spread) {
    case Spread::kCount:
      return of.worst;
    case Spread::kShare:
      return rounded(std::clamp(of.median + 2 * (of.worst - of.median), 0.0, 1.0), least);
    case Spread::kError:
      return rounded(std::max(of.median + 2 * (of.worst - of.median), kGuardMargin * of.median),
                     false);
    case Spread::kRatio:
      break;
  }
  const double ratio = of.worst / of.median;
  const double margin = least ? 1 / kGuardMargin : kGuardMargin;
  const double factor = least ? std::min(ratio * ratio, margin) : std::max(ratio * ratio, margin);
  const double value = rounded(of.median * factor, least);
  return least ? std::min(value, kConsistentNees) : value;  // consistent ones fail no guard
}

/// Of every run, or none.
std::vector<double> measured(const Bound& bound, const std::vector<StoredRun>& runs) {
  std::vector<double> values;
  for (const StoredRun& run : runs) {
    const std::optional<double> value = run.value(bound.metric);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

/// A complete file beside another one, with its ending `.partial`, while this exists.
class FileBeside {
 public:
  FileBeside(const std::filesystem::path& file, const std::string& text) : file_(file) {
    file_ += fmt::format(".{}{}", getpid(), kPartialEnding);
    const int error = write_bytes(create_file(file_), text);
    if (error == 0) return;
    std::filesystem::remove(file_);
    fail("{}: cannot be written: {}", file_.string(), std::strerror(error));
  }
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;
  ~FileBeside() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace

std::vector<GuardBound> derive_guard(const std::vector<StoredRun>& runs) {
  if (runs.size() < kSeedsForGuard) {
    fail("guard: expected at least {} seeds, found {}", kSeedsForGuard, runs.size());
  }
  std::vector<GuardBound> guard;
  for (const Bound& bound : bounds()) {
    const std::vector<double> values = measured(bound, runs);
    if (values.empty()) continue;
    GuardBound found{.bound = &bound, .median = percentile(values, 0.5)};
    found.worst = bound.at_least ? std::ranges::min(values) : std::ranges::max(values);
    found.value = value_of(found);
    const bool can_be_written = bound.spread == Spread::kCount || found.value > 0;
    if (can_be_written) guard.push_back(found);
  }
  return guard;
}

std::string format_guard(const std::vector<GuardBound>& bounds, const std::string& scenario,
                         const std::string& seeds) {
  std::string text = fmt::format(
      "guard:\n  # By `vinebench guard {} --seeds {} --write`; beside each bound what these runs "
      "measured.\n  seeds: {}\n  version: \"{}\"\n",
      scenario, seeds, seeds, kVersion);
  for (const GuardBound& of : bounds) {
    const std::string key = fmt::format("{}: {}", of.bound->key, number(of.value));
    text += fmt::format("  {:<36}  # median {}, worst {}, spread {}\n", key, number(of.median),
                        number(of.worst), number(std::abs(of.worst - of.median)));
  }
  return text;
}

std::string with_guard(const std::string& text, const std::string& block) {
  return with_block(text, "guard", block);
}

void check_guard_place(const std::filesystem::path& scenario) {
  std::error_code ignored;
  if (std::filesystem::is_symlink(scenario, ignored)) {
    fail("{}: is a link: name the file that it leads to", scenario.string());
  }
  const std::string text = read_file(scenario);
  if (access(scenario.c_str(), W_OK) != 0) {
    fail("{}: cannot be written: {}", scenario.string(), std::strerror(errno));
  }
  const FileBeside trial(scenario, with_guard(text, format_guard({}, "", "1..5")));
  try {
    if (load_scenario(trial.file()).guard) return;
    fail("what follows is not read");
  } catch (const Error& error) {
    fail("{}: would be no scenario with a block 'guard:' at its end: {}", scenario.string(),
         error.what());
  }
}

}  // namespace vinebench::harness
