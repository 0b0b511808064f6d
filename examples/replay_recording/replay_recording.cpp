// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// The SLAM core on a recorded data set in any format that Vinebench reads, with the error against
// the recording's ground truth. Usage: replay_recording FOLDER
#include <harness/harness.h>

#include <cstdio>

using namespace vinebench;

int main(int argc, char** argv) try {
  if (argc != 2) fail("usage: replay_recording FOLDER");
  const harness::Recording recording = harness::open_recording(argv[1]);
  std::printf("%s: %s, %zu cameras\n", recording.name.c_str(), recording.format.c_str(),
              recording.rig.cameras.size());
  const slam::SlamConfig settings = harness::replay_settings(recording, "", {});
  const harness::RunOutcome outcome = harness::run_replay(recording, settings, 2, {});
  std::printf("%lld frames\n%s", static_cast<long long>(outcome.report.frames),
              harness::format_replay(outcome.report).c_str());
} catch (const Error& error) {
  std::fprintf(stderr, "replay_recording: %s\n", error.what());
  return 1;
}
