// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/planted_causes/harm.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "harness/explain/rerun.h"

namespace vinebench::planted {
namespace {

constexpr int kFirstPattern = 1001;  // of the noise; explain's are small

/// Makes plain runs of a case, which share a scene where they can.
class PlainRunner {
 public:
  PlainRunner(const Case& one, const harness::Machine& machine) : case_(one), machine_(machine) {}

  PlainRuns run(const std::vector<std::size_t>& planted) {
    const harness::Variant variant{planted_drive(case_, planted)};
    const sim::SimulationConfig& config = variant.scenario.simulation;
    const auto seed = static_cast<std::uint64_t>(case_.seed);
    if (!drawn_ || !drawn_->serves(config, seed)) {
      drawn_ = std::make_shared<sim::DrawnScene>(config, seed, machine_.plant_cache, 1);
    }
    const harness::Stretch stretch{.first = static_cast<std::int64_t>(kStretchFrom * kRate),
                                   .last = std::numeric_limits<std::int64_t>::max()};
    const auto splice = stretch.first - static_cast<std::int64_t>(std::ceil(kLead * kRate));
    PlainRuns runs;
    for (int i = 0; i < kDraws; ++i) {
      const harness::Rerun rerun =
          harness::run_variant(harness::with_other_noise(variant, kFirstPattern + i), {},
                               stretch.last, machine_, {.drawn = drawn_});
      runs.drifts.push_back(harness::drift_of(rerun.steps, stretch, splice - 1));
    }
    return runs;
  }

 private:
  const Case& case_;
  const harness::Machine& machine_;
  std::shared_ptr<sim::DrawnScene> drawn_;
};

std::string text_of(const PlainRuns& runs) {
  return fmt::format("{:.1f} mm, {:.1f} lost", 1e3 * (runs.metres() - kFloor), runs.lost());
}

}  // namespace

double PlainRuns::metres() const {
  double sum = 0;
  for (const harness::StretchDrift& drift : drifts) sum += std::log(drift.metres + kFloor);
  return std::exp(sum / static_cast<double>(drifts.size()));
}

double PlainRuns::lost() const {
  double sum = 0;
  for (const harness::StretchDrift& drift : drifts) sum += drift.lost;
  return sum / static_cast<double>(drifts.size());
}

bool PlainRuns::are_worse_than(const PlainRuns& others) const {
  return metres() >= kHarm * others.metres() ||
         (lost() >= kHarm * others.lost() && lost() >= others.lost() + kHarmLost);
}

bool Harm::is_done() const {
  if (alone.empty()) return with.are_worse_than(without);
  const bool first_adds = with.are_worse_than(alone[1]);
  const bool second_adds = with.are_worse_than(alone[0]);
  if (first_adds != second_adds) return false;
  return first_adds || (with.are_worse_than(without) && alone[0].are_worse_than(without) &&
                        alone[1].are_worse_than(without));
}

std::string Harm::text() const {
  std::string text = fmt::format("with {}; without {}", text_of(with), text_of(without));
  for (const PlainRuns& one : alone) text += "; one alone " + text_of(one);
  return text;
}

Harm measure_harm(const Case& one, const harness::Machine& machine) {
  PlainRunner runner(one, machine);
  Harm harm{.with = runner.run(one.causes), .without = runner.run({}), .alone = {}};
  for (const std::size_t cause : one.causes) {
    if (one.causes.size() > 1) harm.alone.push_back(runner.run({cause}));
  }
  return harm;
}

}  // namespace vinebench::planted
