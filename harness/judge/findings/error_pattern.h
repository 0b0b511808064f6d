// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "harness/judge/results.h"

namespace vinebench::harness {

/// What the error of an estimate looks like over the whole run.
enum class ErrorPatternKind {
  kLate,            ///< `size` s behind the truth, ahead of it if negative
  kScale,           ///< distances from the first pose too large by the share `size`
  kTurned,          ///< the path turned to the left by `size` rad about the first pose
  kClimbing,        ///< rising by the share `size` of the path
  kDrifting,        ///< sideways, ahead or back, in one direction by the share `size` of the path
  kTurning,         ///< the heading's error grows to the left by `size` rad a metre of path
  kStep,            ///< the error changes by `size` m from one frame to the next
  kNoise,           ///< of `size` m (RMS), of each frame by itself
  kTilted,          ///< roll and pitch wrong by `size` rad (RMS), hardly changing
  kWorldOffset,     ///< the map's place in the world is wrong by `size` m
  kWorldTurn,       ///< the map is turned in the world by `size` rad
  kOverconfident,   ///< squared errors are `size` times what the covariances say
  kUnderconfident,  ///< likewise, below one
  kLost,            ///< tracking was lost `size` times
  kWrongLoop,       ///< `size` wrong loop closures
  kMissedLoop,      ///< `size` missed loop closures
};

/// The name in metrics.json, such as "late".
const char* name_of(ErrorPatternKind kind);

struct ErrorPattern {
  ErrorPatternKind kind{};
  double size = 0;   ///< as its kind says
  double share = 1;  ///< of the squared position error that it explains, 0 to 1
  Stamp stamp = 0;   ///< of kStep alone
};

/// The patterns of a run's error. kLate, kScale, kTurned, kClimbing and kDrifting are least-squares
/// fits, each by itself, to the position errors aligned by the first pose: e = tau v, s d, a (z x
/// d), c l z and l c with the true velocity v, displacement d and path length l, and a horizontal
/// c. One is named if it explains 60 % and 1 mm (RMS), the one that explains most first. kTurning
/// is a fit of the heading's errors to k l that explains 60 %, and 0.25 degrees in the end. A step
/// is ten times the median change and at least 5 mm; an error is noise if that of a frame says
/// little of the next one's (autocorrelation below 0.3, at least 2 mm); the body is tilted by 0.25
/// degrees (RMS) if the worst frame has less than twice that; the map is off in the world if
/// aligning the first poses takes 60 % of the squared error there away; the covariances are wrong
/// if the mean NEES is four times too large or too small.
std::vector<ErrorPattern> error_patterns(const RunRecord& record, const RunResults& results);

/// Such as "67 ms late (93 %)".
std::string text_of(const ErrorPattern& pattern);

/// One readable line of them all; empty without any.
std::string format_patterns(const std::vector<ErrorPattern>& patterns);

}  // namespace vinebench::harness
