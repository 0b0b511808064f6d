// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/euroc_sink.h"
#include "tests/support/wall.h"

// Writes FOLDER, an EuRoC recording of the wall of tests/support/wall.h.

namespace {

namespace wall = vinebench::test::wall;

vinebench::RigConfig::Camera camera(const std::string& name, double y) {
  vinebench::RigConfig::Camera camera;
  camera.name = name;
  camera.width = wall::kWidth;
  camera.height = wall::kHeight;
  camera.fx = camera.fy = wall::kFocal;
  camera.position = {0, y, 0};
  return camera;
}

vinebench::harness::RecordingNotes notes() {
  vinebench::harness::RecordingNotes notes;
  notes.scenario = "wall";
  notes.rig.name = "wall";
  notes.rig.rate_hz = wall::kRate;
  notes.rig.cameras = {camera("left", 0), camera("right", -wall::kBaseline)};
  notes.rig.stereo_pairs = {{"front", "left", "right"}};
  return notes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  vinebench::harness::EurocSink writer(argv[1], notes());
  for (int i = 0; i < wall::kFrames; ++i) writer.on_tick(wall::sample(i), {});
  writer.on_finish({});
}
