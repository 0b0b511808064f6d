// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/planted_causes/planted_case.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/files/output_folder.h"
#include "harness/explain/explanation_text.h"
#include "harness/explain/run_to_explain.h"
#include "harness/jobs/run_scenario.h"
#include "harness/judge/diagnosis.h"
#include "harness/sets/child_process.h"
#include "tests/planted_causes/harm.h"

namespace vinebench::planted {
namespace {

using harness::DegradedSegment;
using Json = nlohmann::json;

/// The diagnosis of the run: causes of segments that reach into the stretch.
std::vector<std::string> coinciding(const std::vector<DegradedSegment>& diagnosis,
                                    std::int64_t first) {
  std::vector<std::string> names;
  for (const DegradedSegment& segment : diagnosis) {
    if (static_cast<std::int64_t>(segment.last) < first) continue;
    const std::string name = harness::name_of(segment.cause);
    if (std::ranges::count(names, name) == 0) names.push_back(name);
  }
  return names;
}

/// Runs the drive into the folder; with what coincides and its cost.
Json run_drive(const Case& one, const harness::Machine& machine,
               const std::filesystem::path& folder) {
  harness::RunOptions options;
  options.folder = folder;
  options.images = 0;
  const FolderLock lock = harness::prepare_scenario_folder(folder, planted_drive(one));
  // As explain will read it: the file has fewer digits than the draws.
  const harness::ScenarioConfig scenario =
      harness::load_scenario(folder / "scenario.resolved.yaml");
  const harness::RunReport report = harness::run_scenario(scenario, machine, 1, options).report;
  const auto first = static_cast<std::int64_t>(kStretchFrom * kRate);
  return {{"coincide", coinciding(report.diagnosis, first)}, {"run", report.cost.cpu_seconds}};
}

void explain_drive(const harness::Machine& machine, const std::filesystem::path& folder,
                   int placebos, Json& json) {
  harness::ExplainRequest request =
      harness::read_run(folder, {.number = {}, .from = kStretchFrom, .to = {}});
  request.machine = machine;
  request.lead = kLead;
  request.placebos = placebos;
  const harness::Explanation explanation = harness::explain(request);
  for (const std::size_t i : explanation.stretches[0].causes()) {
    json["named"].push_back(explanation.factors[i].name);
  }
  json["rerun"] = explanation.rerun_seconds;
  json["reruns"] = explanation.reruns;
  json["text"] = harness::format_explanation(explanation, kRate);
}

bool coincides(std::size_t cause, const std::string& name) {
  return std::ranges::any_of(all_causes()[cause].coinciding,
                             [&](harness::Cause known) { return name == harness::name_of(known); });
}

}  // namespace

std::string run_case(const Case& one, int placebos, bool harm_only) {
  const harness::Machine machine = harness::machine_of_environment();
  const std::string harm = harness::run_in_child("harm", [&] {
    sim::draws_in_calling_thread({});
    const Harm measured = measure_harm(one, machine);
    return Json{{"harmed", measured.is_done()}, {"harm", measured.text()}}.dump();
  });
  Json json = Json::parse(harm);
  // A case that did no harm counts neither as right nor as wrong.
  if (harm_only || (!one.causes.empty() && !json["harmed"])) return json.dump();
  const TemporaryFolder folder;
  json.update(Json::parse(
      harness::run_in_child("run", [&] { return run_drive(one, machine, folder.path()).dump(); })));
  explain_drive(machine, folder.path(), placebos, json);
  return json.dump();
}

Verdict read_verdict(const std::string& text) {
  const Json json = Json::parse(text);
  Verdict verdict;
  verdict.harmed = json.at("harmed");
  verdict.harm = json.at("harm");
  verdict.named = json.value("named", std::vector<std::string>());
  verdict.coincide = json.value("coincide", std::vector<std::string>());
  verdict.run_seconds = json.value("run", 0.0);
  verdict.rerun_seconds = json.value("rerun", 0.0);
  verdict.reruns = json.value("reruns", 0);
  verdict.text = json.value("text", "");
  return verdict;
}

bool is_right(const Case& one, const Verdict& verdict) {
  std::vector<std::string> expected = one.names();
  if (expected.empty()) return verdict.named.empty();
  if (verdict.named.size() < expected.size()) return false;
  std::vector<std::string> first(verdict.named.begin(),
                                 verdict.named.begin() + std::ssize(expected));
  std::ranges::sort(first);
  std::ranges::sort(expected);
  return first == expected;
}

bool is_right_by_coincidence(const Case& one, const Verdict& verdict) {
  std::vector<std::string> names = verdict.coincide;
  if (one.causes.empty()) return names.empty();
  if (names.size() < one.causes.size()) return false;
  names.resize(one.causes.size());
  return std::ranges::all_of(one.causes, [&](std::size_t cause) {
    return std::ranges::any_of(names, [&](const auto& name) { return coincides(cause, name); });
  });
}

}  // namespace vinebench::planted
