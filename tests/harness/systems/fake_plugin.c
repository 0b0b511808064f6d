/* SPDX-FileCopyrightText: Vinebench authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A SLAM system in plain C that stands still, for plugin_slam_test. The settings' file name says
 * what goes wrong: *.create, *.process, *.finish, *.pose, *.covariance; it is the position's x in
 * millimetres that says how many bytes of images and samples it was given, and y how many ns after
 * the frame its third image was taken. With exit.*, crash.*,
 * hang.* and grow.* it takes its process along, in create, in finish or in the fourth frame. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/slam_plugin.h"

#ifndef FAKE_PLUGIN_VERSION
#define FAKE_PLUGIN_VERSION VINEBENCH_SLAM_PLUGIN_VERSION
#endif

struct fake {
  size_t cameras;
  size_t count;
  const char* settings;
  vinebench_stamped_pose poses[1000];
};

/* One MiB each millisecond, without end. */
static void grow(void) {
  for (;;) {
    memset(malloc(1 << 20), 1, 1 << 20);
    usleep(1000);
  }
}

/* Tells that it has begun by a file of the settings' name. */
static void hang(const char* settings) {
  if (settings[0] == '/') fclose(fopen(settings, "w"));
  for (;;) pause();
}

static void misbehave(const char* settings, const char* where) {
  if (strstr(settings, where) == NULL) return;
  if (strstr(settings, "exit.") != NULL) exit(0);
  if (strstr(settings, "crash.") != NULL) raise(SIGSEGV);
  if (strstr(settings, "grow.") != NULL) grow();
  if (strstr(settings, "hang.") != NULL) hang(settings);
}

static int fails(const struct fake* fake, const char* where, vinebench_message message) {
  if (strstr(fake->settings, where) == NULL) return 0;
  snprintf(message.text, message.size, "asked to fail in %s", where);
  return 1;
}

static void* create(const vinebench_setup* setup, vinebench_message message) {
  struct fake* fake = calloc(1, sizeof(struct fake));
  fake->cameras = setup->camera_count;
  fake->settings = setup->settings;
  misbehave(fake->settings, ".create");
  if (!fails(fake, "create", message)) return fake;
  free(fake);
  return NULL;
}

static int process(void* system, const vinebench_frame* frame, vinebench_estimate* estimate,
                   vinebench_message message) {
  struct fake* fake = system;
  vinebench_stamped_pose* pose = &fake->poses[fake->count];
  size_t i;
  double bytes = 0;
  if (fake->count == 3) misbehave(fake->settings, ".frame");
  if (fails(fake, "process", message)) return 7;
  for (i = 0; i < fake->cameras; ++i) {
    const vinebench_image* image = &frame->images[i];
    if (image->data != NULL) bytes += (double)image->channels * image->width * image->height;
    estimate->counts[i].inliers = (int32_t)i + 1;
  }
  pose->stamp = frame->stamp;
  pose->T_map_body.position[0] = 1e-3 * (bytes + (double)frame->imu_count);
  if (FAKE_PLUGIN_VERSION > 1) {
    pose->T_map_body.position[1] = (double)(frame->image_stamps[2] - frame->stamp);
  }
  pose->T_map_body.quaternion[3] = strstr(fake->settings, "pose") != NULL ? 2 : 1;
  estimate->status = VINEBENCH_TRACKING;
  if (strstr(fake->settings, "covariance") != NULL) estimate->covariance[7] = NAN;
  estimate->has_pose = 1;
  estimate->T_map_body = pose->T_map_body;
  estimate->keyframe = fake->count++ == 0;
  return 0;
}

static int finish(void* system, vinebench_summary* summary, vinebench_message message) {
  struct fake* fake = system;
  misbehave(fake->settings, ".finish");
  if (fails(fake, "finish", message)) return 1;
  if (strstr(fake->settings, "late") != NULL) fake->poses[fake->count - 1].stamp = INT64_MAX;
  summary->trajectory = fake->poses;
  summary->trajectory_count = fake->count;
  summary->keyframes = fake->poses;
  summary->keyframe_count = 1;
  summary->landmarks = 5;
  return 0;
}

const vinebench_slam_functions* vinebench_slam(void) {
  static const vinebench_slam_functions functions = {FAKE_PLUGIN_VERSION, "fake", create,
                                                     process,             finish, free};
  return &functions;
}
