// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the simulation and the SLAM core share: time, poses, camera model, rig, frame, trajectory,
/// strict YAML and the interface of a SLAM system. Nothing here knows of either side.

#include "slam/base/camera.h"
#include "slam/base/error.h"
#include "slam/base/frame.h"
#include "slam/base/pose.h"
#include "slam/base/random.h"
#include "slam/base/rig.h"
#include "slam/base/slam_system.h"
#include "slam/base/stage_timer.h"
#include "slam/base/time.h"
#include "slam/base/trajectory.h"
#include "slam/base/worker_pool.h"
