// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/recording_notes.h"
#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// The rig in its YAML form: config_of(rig).make() is the rig, but for rounding.
RigConfig config_of(const Rig& rig);

/// Metadata for writing a recording anew. What a recording does not tell is left at its default;
/// the rate of the inertial unit is that of most of its readings, and the true cameras are taken to
/// be those of the rig.
RecordingNotes notes_of(const Recording& recording);

}  // namespace vinebench::harness
