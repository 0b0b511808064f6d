// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/planted_causes/case_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace vinebench::planted {
namespace {

struct Row {
  int cases = 0;
  int harmless = 0;  ///< what was planted did no harm; in none of the following
  int right = 0;
  int none = 0;    ///< none was named
  int others = 0;  ///< others were named first, or too few
  int failed = 0;
  int coincide = 0;
  std::map<std::string, int> wrong;
};

void count(const Case& one, const Verdict& verdict, Row& row) {
  ++row.cases;
  if (!verdict.error.empty()) {
    ++row.failed;
    return;
  }
  if (!one.causes.empty() && !verdict.harmed) {
    ++row.harmless;
    return;
  }
  row.coincide += is_right_by_coincidence(one, verdict) ? 1 : 0;
  if (is_right(one, verdict)) {
    ++row.right;
  } else if (verdict.named.empty()) {
    ++row.none;
  } else {
    ++row.others;
    ++row.wrong[fmt::format("{}", fmt::join(verdict.named, " + "))];
  }
}

std::string format_row(const std::string& name, const Row& row) {
  std::string wrong;
  for (const auto& [named, times] : row.wrong) {
    wrong += fmt::format("{}{}{}", wrong.empty() ? "" : ", ", named,
                         times > 1 ? fmt::format(" ({})", times) : "");
  }
  if (row.failed > 0) wrong += fmt::format(" ({} failed)", row.failed);
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", name, row.cases, row.harmless,
                     row.right, row.none, row.others, row.coincide, wrong);
}

void add(Row& sum, const Row& row) {
  sum.cases += row.cases;
  sum.harmless += row.harmless;
  sum.right += row.right;
  sum.none += row.none;
  sum.others += row.others;
  sum.failed += row.failed;
  sum.coincide += row.coincide;
}

}  // namespace

std::string format_table(const std::vector<Case>& cases, const std::vector<Verdict>& verdicts) {
  std::string text =
      "| planted | cases | did no harm | right | none named | others named first | right by "
      "coincidence | named instead |\n|---|---|---|---|---|---|---|---|\n";
  for (const std::size_t planted : {1, 2, 0}) {
    std::map<std::string, Row> rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (cases[i].causes.size() != planted) continue;
      std::vector<std::string> names = cases[i].names();
      std::ranges::sort(names);
      count(cases[i], verdicts[i], rows[fmt::format("`{}`", fmt::join(names, "` + `"))]);
    }
    Row sum;
    for (const auto& [name, row] : rows) {
      if (planted > 0) text += format_row(name, row);
      add(sum, row);
    }
    const char* kind = planted == 1 ? "one cause" : planted == 2 ? "two causes" : "nothing";
    if (sum.cases > 0) text += format_row(fmt::format("**{}**", kind), sum);
  }
  return text;
}

std::string format_cost(const std::vector<Verdict>& verdicts) {
  double run = 0;
  double rerun = 0;
  int runs = 0;
  int reruns = 0;
  for (const Verdict& verdict : verdicts) {
    if (verdict.reruns == 0) continue;
    run += verdict.run_seconds;
    rerun += verdict.rerun_seconds;
    ++runs;
    reruns += verdict.reruns;
  }
  if (runs == 0) return "";
  return fmt::format(
      "A run took {:.1f} s of processor time, a rerun {:.1f} s: {:.0f} %; {:.1f} reruns a case.\n",
      run / runs, rerun / reruns, 100 * (rerun / reruns) / (run / runs),
      static_cast<double>(reruns) / runs);
}

}  // namespace vinebench::planted
