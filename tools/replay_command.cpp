// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <thread>

#include "harness/replay.h"
#include "tools/commands.h"
#include "tools/interactive.h"

namespace vinebench::tools {
namespace {

struct ReplayArguments {
  std::string dataset;
  std::string rig;
  std::string slam;
  std::string groundtruth;
  std::string out;
  std::vector<std::string> overrides;
  harness::MapFiles maps;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

int replay(const ReplayArguments& arguments) {
  harness::Recording recording = harness::open_recording(
      arguments.dataset, {.rig = arguments.rig, .groundtruth = arguments.groundtruth});
  const slam::SlamConfig slam =
      harness::replay_settings(recording, arguments.slam, parse_overrides(arguments.overrides));
  const std::string name = recording.name;
  const std::string format = recording.format;
  const std::filesystem::path folder = arguments.out.empty() ? std::filesystem::path("out") / name
                                                             : std::filesystem::path(arguments.out);
  harness::prepare_replay_folder(folder, slam);
  catch_interrupts();
  harness::RunOptions options = interactive_options(name);
  options.folder = folder;
  options.maps = arguments.maps;
  const harness::RunOutcome outcome =
      harness::run_replay(std::move(recording), slam, arguments.threads, options);
  if (outcome.interrupted) return report_interruption(outcome, folder);
  fmt::print("\n{} ({}): {} frames in {:.0f} s, hash {}\n{}results: {}\n", name, format,
             outcome.report.frames, outcome.report.cost.wall_seconds, outcome.report.hash,
             harness::format_replay(outcome.report), std::filesystem::absolute(folder).string());
  return 0;
}

}  // namespace

void add_replay_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = app.add_subcommand(
      "replay", "Run the SLAM core on a recorded data set (EuRoC/ASL or KITTI odometry folder)");
  command->add_option("DATASET", arguments->dataset, "Folder of the data set")->required();
  command->add_option("--rig", arguments->rig, "Rig file in place of the data set's calibration");
  command->add_option("--slam", arguments->slam,
                      "Settings of the SLAM core: a file with the keys of a scenario's slam");
  command->add_option("--groundtruth", arguments->groundtruth,
                      "True poses in place of the data set's: TUM, KITTI or EuRoC file");
  command->add_option("--out", arguments->out,
                      "Folder for the results (default: out/<data set's name>)");
  command
      ->add_option("--set", arguments->overrides,
                   "Set a key of the settings, e.g. slam.cameras=front; may stand many times")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--threads", arguments->threads, "Threads to share the work; changes no result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_map_options(*command, arguments->maps);
  command->callback([&chosen, arguments] { chosen = [arguments] { return replay(*arguments); }; });
}

}  // namespace vinebench::tools
