// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "harness/replay.h"
#include "harness/systems/other_system.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/interactive.h"
#include "tools/commands/report/run_page.h"

namespace vinebench::tools {
namespace {

struct ReplayArguments {
  std::string dataset;
  std::string rig;
  std::string slam;
  std::string groundtruth;
  std::vector<std::string> topics;
  std::string out;
  std::vector<std::string> overrides;
  harness::MapFiles maps;
  int threads = default_threads();
  PageArguments page;
  bool untrusted = false;
  std::filesystem::path plugin_host;
};

int replay(const ReplayArguments& arguments) {
  harness::Recording recording = harness::open_recording(
      arguments.dataset,
      {.rig = arguments.rig, .groundtruth = arguments.groundtruth, .topics = arguments.topics});
  const harness::SlamChoice slam =
      harness::replay_choice(recording, arguments.slam, parse_overrides(arguments.overrides));
  if (arguments.untrusted) harness::expect_no_code(slam, arguments.slam);
  const std::string name = recording.name;
  const std::string format = recording.format;
  const std::filesystem::path folder = arguments.out.empty() ? std::filesystem::path("out") / name
                                                             : std::filesystem::path(arguments.out);
  const FolderLock lock = harness::prepare_replay_folder(folder, slam);
  catch_interrupts();
  RunPage page(arguments.page, interrupted);
  harness::RunOptions options = interactive_options(name);
  options.folder = folder;
  options.maps = arguments.maps;
  page.join(options);
  const harness::RunOutcome outcome = harness::run_replay(
      std::move(recording), slam, arguments.threads, options, arguments.plugin_host);
  if (outcome.interrupted) return report_interruption(outcome, folder);
  fmt::print("\n{} ({}): {} frames in {:.0f} s, hash {}\n{}results: {}\n", name, format,
             outcome.report.frames, outcome.report.cost.wall_seconds, outcome.report.hash,
             harness::format_replay(outcome.report), std::filesystem::absolute(folder).string());
  page.finish(folder, "replayed");
  return outcome.report.failure ? 1 : 0;
}

}  // namespace

Command replay_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<ReplayArguments>();
  arguments->plugin_host = surroundings.machine.plugin_host;
  Command command{
      .name = "replay",
      .description =
          "Run the SLAM core, or another system, on a recorded data set (EuRoC/ASL, TUM-VI "
          "or KITTI folder, bag of ROS 1 or 2)",
      .options =
          {{.name = "DATASET",
            .target = &arguments->dataset,
            .help = "Folder of the data set, or file of a bag",
            .required = true},
           {.name = "--rig",
            .target = &arguments->rig,
            .help =
                "Rig file, the name of a rig, or a camera chain of Kalibr, in place of the data "
                "set's calibration",
            .data = harness::DataKind::kRig},
           {.name = "--slam",
            .target = &arguments->slam,
            .help = "Settings of the SLAM core: a file with the keys of a scenario's `slam`"},
           {.name = "--groundtruth",
            .target = &arguments->groundtruth,
            .help = "True poses in place of the data set's: TUM, KITTI or EuRoC file"},
           {.name = "--topics",
            .target = &arguments->topics,
            .help = "Topics of a bag's images: left and right of a pair, of a second one, "
                    "others (default: by their names)",
            .commas = true},
           {.name = "--out",
            .target = &arguments->out,
            .help = "Folder for the results (default: out/<data set's name>)"},
           overrides_option(arguments->overrides,
                            "Set a key of the settings, e.g. slam.cameras=front"),
           threads_option(arguments->threads),
           {.name = "--untrusted",
            .target = &arguments->untrusted,
            .help = "Refuse settings that execute programs or load code"}},
      .run = [arguments] { return replay(*arguments); }};
  append(command.options, report_options(arguments->page));
  append(command.options, view_options(arguments->page));
  append(command.options, map_options(arguments->maps));
  return command;
}

}  // namespace vinebench::tools
