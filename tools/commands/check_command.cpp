// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "harness/datasets/dataset_check.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

constexpr std::size_t kShownFaults = 20;

std::string verdict(const harness::DatasetReport& report) {
  const std::string faults =
      report.faults.empty() ? "SOUND" : fmt::format("{} FAULTS", report.faults.size());
  if (report.interrupted.empty()) return faults;
  const bool nothing = report.frames == 0 && report.faults.empty();
  return fmt::format("INTERRUPTED, {}: {}", report.interrupted,
                     nothing ? "no frame to check" : "what there is: " + faults);
}

int check(const std::string& folder) {
  const harness::DatasetReport report = harness::check_dataset(folder);
  for (const std::string& note : report.notes) fmt::print("note: {}\n", note);
  for (std::size_t i = 0; i < std::min(kShownFaults, report.faults.size()); ++i) {
    fmt::print("{}: {}\n", report.faults[i].file, report.faults[i].problem);
  }
  if (report.faults.size() > kShownFaults) {
    fmt::print("and {} more\n", report.faults.size() - kShownFaults);
  }
  fmt::print("{}: {} ({} sequences, {} frames, {} files, {} label images compared)\n", folder,
             verdict(report), report.sequences, report.frames, report.files, report.label_images);
  return report.faults.empty() ? 0 : kExpectationFailed;
}

}  // namespace

Command check_command() {
  const auto folder = std::make_shared<std::string>();
  return {
      .name = "check",
      .description = "Check a data set of record: hashes, counts, stamps, and that labels agree",
      .options = {{.name = "DATASET",
                   .target = folder.get(),
                   .help = "Folder with dataset.yaml",
                   .required = true,
                   .existing = Existing::kFolder}},
      .footer =
          "Exit code: 0 for a sound data set or part of one, 1 for one with faults, 2 for bad "
          "input.",
      .run = [folder] { return check(*folder); }};
}

}  // namespace vinebench::tools
