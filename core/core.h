// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Shared by simulation and SLAM core: time, poses, camera model, rig, frame, trajectory, strict
/// YAML and the interface of a SLAM system. Independent of both.

#include "core/frame.h"
#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "core/time.h"
#include "core/trajectory.h"
#include "core/util/error.h"
#include "core/util/random.h"
#include "core/util/stage_timer.h"
#include "core/util/worker_pool.h"
