/* SPDX-FileCopyrightText: Vinebench authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Interface of a SLAM system in a shared object that the test bench runs frame by frame. Plain C,
 * so that compilers and libraries may differ on the two sides; include it from C or C++.
 *
 * The shared object exports vinebench_slam(), which returns a table of functions. For a run the
 * bench calls create once, process for each frame in order of the stamps, finish once and destroy
 * once, all on one thread. Frames contain sensor data only, no ground truth. The shared object is
 * loaded into a process of its own, which the bench ends at a limit of time or memory.
 *
 * Metres, radians, seconds; stamps are integer nanoseconds. T_a_b takes coordinates in b to
 * coordinates in a. body: x forward, y left, z up; cam: x right, y down, z into the scene; map: the
 * system's own world; tag: x right and y down on the printed face, z into the tag. Pixel (0, 0) is
 * the centre of the top left pixel.
 *
 * Pointers passed to a call are valid during that call; those in a setup until destroy.
 */
#ifndef VINEBENCH_SLAM_PLUGIN_H
#define VINEBENCH_SLAM_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Incremented by every change. Plug-ins of version 1, which do not know of a frame's image_stamps,
 * are loaded too. */
#define VINEBENCH_SLAM_PLUGIN_VERSION 2
#define VINEBENCH_SLAM_PLUGIN_OLDEST_VERSION 1

typedef struct vinebench_pose {
  double position[3];
  double quaternion[4]; /* x, y, z, w; of unit length */
} vinebench_pose;

typedef struct vinebench_camera {
  const char* name;
  int32_t width, height; /* px */
  double fx, fy, cx, cy; /* px */
  double distortion[4];  /* k1, k2, p1, p2 */
  vinebench_pose T_body_cam;
} vinebench_camera;

typedef struct vinebench_stereo_pair {
  const char* name;
  int32_t left, right; /* indices into the cameras */
} vinebench_stereo_pair;

/* An AprilTag whose pose in the world is known beforehand. */
typedef struct vinebench_tag {
  const char* family; /* "tag36h11" */
  int32_t id;
  double size; /* side of the black square, m */
  vinebench_pose T_world_tag;
} vinebench_tag;

/* The input of a system before the first frame. */
typedef struct vinebench_setup {
  const char* rig;
  double rate_hz;
  const vinebench_camera* cameras;
  size_t camera_count;
  const vinebench_stereo_pair* stereo_pairs;
  size_t stereo_pair_count;
  const int32_t* tag_cameras; /* in which AprilTags are detected */
  size_t tag_camera_count;
  const vinebench_tag* tags;
  size_t tag_count;
  double wheel_radius, half_track, half_wheelbase; /* of the mecanum wheels; 0 if unknown */
  const char* settings;                            /* a file; empty if the scenario has none */
  int32_t threads;                                 /* available, the calling one included */
} vinebench_setup;

typedef struct vinebench_image {
  const uint8_t* data; /* top row first; NULL if the camera delivered no image */
  int32_t width, height;
  int32_t channels; /* 1: grey, 3: red, green, blue */
  size_t stride;    /* bytes from a row to the next */
} vinebench_image;

typedef struct vinebench_imu_sample {
  int64_t stamp;
  double angular_velocity[3]; /* in the body frame */
  double specific_force[3];   /* likewise; +9.81 along z at rest */
} vinebench_imu_sample;

/* Front left, front right, rear left, rear right. */
typedef struct vinebench_wheel_sample {
  int64_t stamp;
  double angle[4]; /* accumulated */
  double velocity[4];
} vinebench_wheel_sample;

typedef struct vinebench_frame {
  int64_t index;
  int64_t stamp;
  const vinebench_image* images;   /* one a camera, in the setup's order */
  const vinebench_imu_sample* imu; /* since the previous frame, oldest first */
  size_t imu_count;
  const vinebench_wheel_sample* wheels; /* likewise */
  size_t wheel_count;
  const int64_t* image_stamps; /* when each image was taken; all are `stamp` if they have none */
} vinebench_frame;

enum { /* vinebench_estimate.status */
       VINEBENCH_INITIALIZING = 0,
       VINEBENCH_TRACKING = 1,
       VINEBENCH_DEAD_RECKONING = 2, /* by the wheels or the last velocity */
       VINEBENCH_LOST = 3
};

/* Feature counts of one camera in a frame; zeros if unknown. */
typedef struct vinebench_counts {
  int32_t features, stereo, matches, inliers;
} vinebench_counts;

typedef struct vinebench_loop_closure {
  int32_t tag_id;                 /* -1 if it was not closed by a tag */
  int64_t earlier, later;         /* stamps of the two constrained frames */
  vinebench_pose T_earlier_later; /* body to body */
  double correction;              /* how far this frame's body moved, m */
} vinebench_loop_closure;

/* The estimate at a frame. The bench passes it zeroed, with memory for the counts. */
typedef struct vinebench_estimate {
  int32_t status;
  int32_t has_pose;
  vinebench_pose T_map_body;
  double covariance[36]; /* of T_map_body in the body frame, translation first; zeros if unknown */
  int32_t keyframe;
  vinebench_counts* counts; /* one a camera */
  int32_t has_loop_closure;
  vinebench_loop_closure loop_closure;
} vinebench_estimate;

typedef struct vinebench_stamped_pose {
  int64_t stamp;
  vinebench_pose T_map_body;
} vinebench_stamped_pose;

/* The final result, after all corrections; the system owns the poses until destroy. */
typedef struct vinebench_summary {
  const vinebench_stamped_pose* trajectory; /* of every frame that has a pose, in order */
  size_t trajectory_count;
  const vinebench_stamped_pose* keyframes;
  size_t keyframe_count;
  int64_t landmarks;
} vinebench_summary;

/* Buffer for the reason of a failure: zero-terminated text, truncated to size. */
typedef struct vinebench_message {
  char* text;
  size_t size;
} vinebench_message;

typedef struct vinebench_slam_functions {
  uint32_t version; /* VINEBENCH_SLAM_PLUGIN_VERSION */
  const char* name;
  /* A system, or NULL and a message. */
  void* (*create)(const vinebench_setup* setup, vinebench_message message);
  /* 0, or another number and a message, which ends the run with that as its verdict. */
  int (*process)(void* system, const vinebench_frame* frame, vinebench_estimate* estimate,
                 vinebench_message message);
  int (*finish)(void* system, vinebench_summary* summary, vinebench_message message);
  void (*destroy)(void* system);
} vinebench_slam_functions;

/* The one symbol that the shared object exports. */
const vinebench_slam_functions* vinebench_slam(void);

#ifdef __cplusplus
}
#endif

#endif
