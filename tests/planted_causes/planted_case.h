// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/planted_causes/planted_cause.h"

namespace vinebench::planted {

/// What became of a case.
struct Verdict {
  bool harmed = false;                  ///< Harm::is_done()
  std::string harm{};                   ///< what was measured of it
  std::vector<std::string> named{};     ///< by explain, the strongest first
  std::vector<std::string> coincide{};  ///< by the diagnosis, likewise
  double run_seconds = 0;               ///< processor time of the run
  double rerun_seconds = 0;             ///< of all reruns
  int reruns = 0;
  std::string text{};   ///< explain's
  std::string error{};  ///< why there is none of this
};

/// Runs its drive, explains it unless `harm_only`, and measures the harm; as text. For a process of
/// its own.
std::string run_case(const Case& one, int placebos, bool harm_only);
Verdict read_verdict(const std::string& text);

/// The first ones named are those that were planted, in any order; none, where none was.
bool is_right(const Case& one, const Verdict& verdict);
/// The same for the diagnosis.
bool is_right_by_coincidence(const Case& one, const Verdict& verdict);

}  // namespace vinebench::planted
