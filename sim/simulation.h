// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "core/util/stage_timer.h"
#include "core/util/worker_pool.h"
#include "sim/render/renderer.h"
#include "sim/rover/route.h"
#include "sim/rover/rover.h"
#include "sim/scene/scene_index.h"
#include "sim/sensors/sensors.h"
#include "sim/truth/truth_images.h"
#include "sim/world/world.h"

namespace vinebench {

/// What only the judge may know of an instant.
struct Truth {
  Pose T_world_body;
  bool known = true;  ///< false where a recording has no ground truth; the pose means nothing then
  std::vector<double> box_share;  ///< of each camera's pixels, 0 to 1, those that show a carton box
  /// Indices into WorldConfig::tags that are wholly in the image of a tag camera, unoccluded at
  /// their centre and corners.
  std::vector<int> visible_tags;
  /// Of each camera's image, s, the time over which motion blurs it; empty where not known.
  std::vector<double> blur_time{};
  /// Of each camera the truth images that a CapturePlan asks for, without colours, with the true
  /// camera and its place; their motion is the wind's, to the next frame of the plan. Empty where
  /// no plan asks for any.
  std::vector<TruthView> views;
};

/// Something wrong with the data of a frame that its source survived, such as an image that cannot
/// be read.
struct SourceEvent {
  std::string event;   ///< its kind, for counting: "picture_missing"
  std::string sensor;  ///< name of the camera or other sensor
  std::string detail;  ///< what was found, for people
};

/// One tick of a source of frames. Only `frame` is passed on to a SLAM system.
struct Sample {
  Frame frame;
  Truth truth;
  std::vector<SourceEvent> events;
};

/// Frames in order, from a simulation, a recording or a test.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// The next sample, or nothing after the last.
  virtual std::optional<Sample> next() = 0;
  /// What a SLAM system said of the last sample, before the next one is asked for. Most sources do
  /// not care.
  virtual void answer(const Estimate&) {}
  /// How many there will be.
  virtual std::int64_t size() const = 0;
  /// The cameras as a SLAM system is told of them.
  virtual const Rig& rig() const = 0;
  virtual const StageTimes& times() const = 0;
};

/// A simulation, with what its truth images mean.
class SimulatedSource : public FrameSource {
 public:
  virtual const SceneIndex& scene() const = 0;
  /// The cameras that take the images.
  virtual const Rig& true_rig() const = 0;
};

/// What a recording asks of a simulation: more than a SLAM system needs, or less.
struct CapturePlan {
  // Which truth images come with each image (RenderedImage says what they are).
  bool labels = false;
  bool depth = false;
  bool instances = false;
  bool normals = false;
  bool motion = false;
  std::vector<bool> cameras;  ///< of the rig, which ones deliver images; all where empty
  std::int64_t first = 0;     ///< the first frame that is delivered
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t every = 1;  ///< from the first on, every n-th frame is delivered

  bool has_frame(std::int64_t index) const {
    return index >= first && index <= last && (index - first) % every == 0;
  }
  /// Of a run of so many frames.
  std::int64_t count(std::int64_t frames) const {
    const std::int64_t end = std::min(last, frames - 1);
    return end < first ? 0 : (end - first) / every + 1;
  }
  bool has_camera(std::size_t camera) const { return cameras.empty() || cameras.at(camera); }
};

struct SimulationConfig {
  WorldConfig world;
  RoverConfig rover;
  RouteConfig route;
  RendererConfig renderer;
  SensorsConfig sensors;
  std::optional<double> duration;  ///< s; the whole route where absent
  template <class Archive>
  void serialize(Archive& archive) {
    archive("world", world);
    archive("rover", rover);
    archive("route", route);
    archive("renderer", renderer);
    archive("sensors", sensors);
    archive("duration", duration, Range::positive());
  }
};

/// Drives the rover along its route and takes an image with every camera at each frame's instant.
/// rig() is what a SLAM system is told; the images are taken by the true one, which differs by
/// the calibration error. Stamps are what the cameras say; the truth is that of the frame's
/// instant. An image that is dropped is empty and shows nothing: its box share is 0 and no tag is
/// visible. Where the route says so the rover is steered by the estimates that it is answered:
/// the first one of a pose is taken to be where the rover stands, and while there is none it goes
/// on as commanded.
///
/// A frame that the plan leaves out is driven through and not delivered; its readings come with the
/// next one. No image that is delivered depends on the plan: where exposure is automatic, the
/// others are taken too.
std::unique_ptr<SimulatedSource> make_simulation(const SimulationConfig& config, std::uint64_t seed,
                                                 const std::filesystem::path& cache,
                                                 WorkerPool& pool, const CapturePlan& plan = {});

}  // namespace vinebench
