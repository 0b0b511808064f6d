// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <string>

#include "tests/mutants/mutant.h"

namespace vinebench::mutants {
namespace {

const std::map<std::string, std::string>& causes() {
  static const std::map<std::string, std::string> all{
      {"baselines", "all pairs: baseline"},
      {"front-baseline", "front pair: baseline"},
      {"back-baseline", "back pair: baseline"},
      {"baselines-1", "all pairs: baseline"},
      {"focal", "all pairs: focal length"},
      {"front-focal", "front pair: focal length"},
      {"one-focal", "back_left: focal length"},
      {"aspect", "all pairs: focal length, y"},
      {"front-centre", "front pair: principal point, x"},
      {"back-centre-y", "back pair: principal point, y"},
      {"one-centre-y", "front_right: principal point, y"},
      {"side-focal", "side: focal length"},
      {"front-yaw", "front pair: orientation"},
      {"back-pitch", "back pair: orientation"},
      {"front-roll", "front pair: orientation"},
      {"back-position", "back pair: position"},
      {"one-yaw", "front pair: cameras to each other"},
      {"side-yaw", "side: orientation"},
      {"side-position", "side: position"},
      {"swapped-front", "front_left and front_right: swapped"},
      {"swapped-pairs", "front_left and back_left: swapped|front_right and back_right: swapped"},
      {"survey", "tag 0: orientation|tag 0: position"},
      {"survey-height", "tag 0: position"},
      {"survey-turn", "tag 0: orientation"},
      {"tag-size", "tag 0: size"},
      {"tag-id", "tag 100: not in the world"},
      {"late-pair", "back pair: exposure"},
      {"early-pair", "front pair: exposure"},
      {"late-camera", "front_right: exposure"},
      {"stamps", "all cameras: stamps"},
      {"wheel-radius", "wheels: radius"},
      {"accelerometer", "inertial unit: accelerometer"},
      {"drops", "dropped images|lost"},
      {"scale", "scale"},
      {"late", "late"},
      {"jump", "step"},
      {"jump-back", "step"},
      {"drift", "drifting"},
      {"climb", "climbing"},
      {"heading", "turning"},
      {"tilt", "tilted"},
      {"frozen", "step"},
      {"silent-loss", "step"},
      {"open-loss", "lost"},
      {"noise", "noise"},
      {"overconfident", "overconfident"},
      {"underconfident", "underconfident"},
      {"false-loop", "wrong_loop"},
      {"world", "world_offset"},
      {"forgotten-loop", "missed_loop"}};
  return all;
}

}  // namespace

std::string cause_of(const std::string& mutant) {
  const auto found = causes().find(mutant);
  return found == causes().end() ? "" : found->second;
}

}  // namespace vinebench::mutants
