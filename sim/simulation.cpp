// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/config/validate.h"
#include "sim/commanded_simulation.h"
#include "sim/drawn_scene.h"
#include "sim/rover/driven_rover.h"
#include "sim/truth/truth.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

Rig checked_rig(const SimulationConfig& config) {
  Rig rig = load_rig(config.rover.rig);
  check_sensors(config.sensors, rig);
  return rig;
}

enum class Driver { kRoute, kCommands };

std::int64_t frames_until(double seconds, double rate_hz) {
  return static_cast<std::int64_t>(std::floor(seconds * rate_hz + 1e-9)) + 1;
}

class Simulation : public CommandedSimulation {
 public:
  Simulation(const SimulationConfig& config, std::uint64_t seed, const CacheFolder& cache,
             WorkerPool& pool, const CapturePlan& plan, const std::shared_ptr<DrawnScene>& drawn,
             Driver driver)
      : config_(config),
        pool_(pool),
        plan_(plan),
        occluders_(occluder_classes(config.world)),
        tags_(world_tags(config.world)),
        nominal_rig_(checked_rig(config)),
        rig_(sim::true_rig(nominal_rig_, config.sensors.calibration, seed)),
        rover_(config.rover, config.world, config.route, seed),
        timing_(config.sensors.timing, config.sensors.drops, rig_, seed),
        exposure_(config.sensors.camera.exposure, rig_),
        inertial_(config.sensors.inertial, config.rover.imu_rate_hz, seed),
        first_reading_(inertial_.measured_at_start(rover_.first_reading())),
        wheels_(config.sensors.wheels) {
    window_ = from_seconds(config.sensors.camera.half_window()) + timing_.longest_delay();
    drawn_ = drawn && drawn->serves(config, seed)
                 ? drawn
                 : std::make_shared<DrawnScene>(config, seed, cache, lanes());
    for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
      cameras_.emplace_back(config.sensors.camera, rig_.cameras[i], static_cast<int>(i), seed,
                            drawn_->light());
    }
    if (driver == Driver::kCommands) {
      rover_.command(Eigen::Vector3d::Zero());
      frames_ = config.duration ? frames_until(*config.duration, rig_.rate_hz) : kEndless;
      return;
    }
    const double route_seconds = to_seconds(rover_.route().duration());
    const double seconds = std::min(config.duration.value_or(route_seconds), route_seconds);
    frames_ = frames_until(seconds, rig_.rate_hz);
  }

  std::optional<Sample> next() override {
    Sample sample;
    for (; index_ < frames_ && index_ <= plan_.last; ++index_) {
      sample.frame.index = index_;
      sample.frame.stamp = timing_.stamp(index_);
      sample.frame.image_stamps = timing_.image_stamps(index_);
      drive(sample);
      if (index_ == 0) {
        exposure_.meter([&](std::size_t camera) { return capture(camera, shot_of(camera)).rgb; });
      }
      rover_.hand_out_path(sample.frame.stamp, sample.truth.path);
      const bool wanted = plan_.has_frame(index_);
      if (!wanted && !takes_all()) continue;
      sample.truth.T_world_body = rover_.T_world_body(timing_.instant(index_));
      render(sample);
      exposure_.observe(sample.frame.images);
      if (!wanted) continue;
      keep_planned_cameras(sample.frame);
      ++index_;
      return sample;
    }
    return std::nullopt;
  }

  void answer(const Estimate& estimate) override {
    if (config_.route.steering != Steering::kEstimate || !estimate.T_map_body) return;
    const Stamp instant = timing_.instant(index_ - 1);
    if (!T_world_map_) {
      T_world_map_ = rover_.T_world_body(instant) * estimate.T_map_body->inverse();
    }
    rover_.steer_by(instant, *T_world_map_ * *estimate.T_map_body);
  }

  void command(const Eigen::Vector3d& twist) override { rover_.command(twist); }
  bool collided() const override { return rover_.collided(); }

  std::int64_t size() const override { return plan_.count(frames_); }
  const SceneIndex& scene() const override { return drawn_->index(); }
  const Rig& true_rig() const override { return rig_; }
  const Rig& rig() const override { return nominal_rig_; }
  std::optional<ImuSample> first_reading() const override { return first_reading_; }
  const StageTimes& times() const override { return times_; }

 private:
  static constexpr std::int64_t kEndless = std::numeric_limits<std::int64_t>::max();

  /// Past the frame's instant, if an image's exposure or the stamps require it; readings are taken
  /// up to the stamp.
  void drive(Sample& sample) {
    Frame& frame = sample.frame;
    const ScopedTimer timer(times_, "physics");
    const Stamp instant = timing_.instant(frame.index);
    rover_.forget_before(instant - window_);
    if (window_ > 0) {
      rover_.advance_and_remember(instant);
      rover_.advance_and_remember(instant + window_);
    } else {
      rover_.advance_to(instant);
    }
    if (frame.stamp > instant + window_) rover_.advance_and_remember(frame.stamp);
    const auto inertial = static_cast<std::ptrdiff_t>(frame.imu.size());
    const auto wheels = static_cast<std::ptrdiff_t>(frame.wheels.size());
    rover_.hand_out(frame.stamp, frame.imu, frame.wheels);
    std::for_each(frame.imu.begin() + inertial, frame.imu.end(), [&](ImuSample& reading) {
      sample.truth.imu_biases.push_back(inertial_.bias(reading.stamp));
      inertial_.measure(reading);
    });
    std::for_each(frame.wheels.begin() + wheels, frame.wheels.end(),
                  [&](WheelSample& reading) { wheels_.measure(reading); });
  }

  /// An automatic exposure needs every image.
  bool takes_all() const { return config_.sensors.camera.exposure.automatic; }
  bool takes(std::size_t camera) const { return takes_all() || plan_.has_camera(camera); }

  void keep_planned_cameras(Frame& frame) const {
    for (std::size_t i = 0; i < frame.images.size(); ++i) {
      if (!plan_.has_camera(i)) frame.images[i].release();
    }
  }

  bool plans_truth() const {
    return plan_.labels || plan_.depth || plan_.instances || plan_.normals || plan_.motion;
  }

  /// Threads that render cameras side by side.
  std::size_t lanes() const {
    std::size_t taken = 0;
    for (std::size_t i = 0; i < rig_.cameras.size(); ++i) taken += takes(i) ? 1 : 0;
    return std::clamp<std::size_t>(taken, 1, static_cast<std::size_t>(pool_.threads()));
  }

  /// Each lane takes the next camera; the assignment changes no pixel.
  void render(Sample& sample) {
    const std::size_t cameras = rig_.cameras.size();
    std::vector<double> spent(cameras);
    sample.frame.images.assign(cameras, {});
    sample.truth.occlusion.assign(cameras, {});
    const bool blurs = config_.sensors.camera.blur_subframes > 1;
    sample.truth.blur_time.assign(cameras, 0);
    for (std::size_t i = 0; blurs && i < cameras; ++i) {
      sample.truth.blur_time[i] = exposure_.of(i).time;
    }
    note_captures(sample);
    sample.truth.visible_tags.clear();
    if (plans_truth()) sample.truth.views.assign(cameras, {});
    std::vector<std::vector<int>> visible(cameras);
    std::atomic<std::size_t> next{0};
    const std::vector<std::size_t> order = largest_first();
    pool_.for_each(lanes(), [&](std::size_t) {
      for (std::size_t i = next++; i < cameras; i = next++) {
        const std::size_t camera = order[i];
        if (timing_.is_dropped(index_, camera) || !takes(camera)) continue;
        const auto start = std::chrono::steady_clock::now();
        render_camera(camera, sample, visible[camera]);
        spent[camera] =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count();
      }
    });
    for (std::size_t camera = 0; camera < cameras; ++camera) {
      if (!takes(camera)) continue;
      times_.add("render " + rig_.cameras[camera].name, spent[camera]);
      for (const int tag : visible[camera]) sample.truth.visible_tags.push_back(tag);
    }
    std::ranges::sort(sample.truth.visible_tags);
    std::vector<int>& tags = sample.truth.visible_tags;
    tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  }

  void note_captures(Sample& sample) const {
    sample.truth.captures.clear();
    for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
      const Stamp late = sample.frame.image_stamp(i) - timing_.instant(index_, i);
      sample.truth.captures.push_back({.gain_db = exposure_.of(i).gain_db,
                                       .readout_time = config_.sensors.camera.readout_time,
                                       .stamp_error = to_seconds(late)});
    }
  }

  Shot shot_of(std::size_t camera) const {
    Shot shot;
    shot.frame = index_;
    shot.instant = timing_.instant(index_, camera);
    shot.exposure = exposure_.of(camera);
    return shot;
  }

  RenderedImage capture(std::size_t camera, const Shot& shot) {
    return cameras_[camera].capture(
        shot, [&](Stamp stamp) { return rover_.T_world_body(stamp); },
        [&](const PinholeCamera& view, const Pose& T_world_cam, const RenderRequest& request) {
          RenderedImage drawn;
          drawn_->engines().with_engine(
              [&](RenderEngine& engine) { drawn = engine.render(view, T_world_cam, request); });
          return drawn;
        });
  }

  void render_camera(std::size_t camera, Sample& sample, std::vector<int>& visible) {
    const bool reads_tags = std::ranges::count(rig_.tag_cameras, static_cast<int>(camera)) > 0;
    Shot shot = shot_of(camera);
    const bool wants_labels = reads_tags || !occluders_.empty();
    if (plan_.has_camera(camera)) ask_for_truth(shot.request);
    shot.request.labels |= wants_labels;
    RenderedImage image = capture(camera, shot);
    if (wants_labels) {
      sample.truth.occlusion[camera] = occlusion_in(image.labels, occluders_);
    }
    if (reads_tags) visible = tags_seen(camera, shot.instant, image.labels);
    sample.frame.images[camera] = std::move(image.rgb);
    if (!plans_truth() || !plan_.has_camera(camera)) return;
    const RigCamera& mounted = rig_.cameras[camera];
    const Pose T_world_body = rover_.T_world_body(cameras_[camera].truth_instant(shot));
    sample.truth.views[camera] = {mounted.model, T_world_body * mounted.T_body_cam,
                                  std::move(image)};
  }

  void ask_for_truth(RenderRequest& request) const {
    request.labels = plan_.labels;
    request.depth = plan_.depth;
    request.instances = plan_.instances;
    request.normals = plan_.normals;
    request.motion = plan_.motion && (config_.world.wind.speed > 0 || drawn_->something_moves());
    request.other_time = to_seconds(timing_.instant(index_ + plan_.every));
  }

  std::vector<int> tags_seen(std::size_t camera, Stamp instant, const cv::Mat& labels) const {
    const RigCamera& mounted = rig_.cameras[camera];
    const Pose T_world_cam = rover_.T_world_body(instant) * mounted.T_body_cam;
    std::vector<int> seen;
    for (std::size_t t = 0; t < tags_.size(); ++t) {
      if (is_tag_visible(tags_[t], mounted.model, T_world_cam, labels)) {
        seen.push_back(static_cast<int>(t));
      }
    }
    return seen;
  }

  std::vector<std::size_t> largest_first() const {
    std::vector<std::size_t> order(rig_.cameras.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      const PinholeCamera& left = rig_.cameras[a].model;
      const PinholeCamera& right = rig_.cameras[b].model;
      return left.width * left.height > right.width * right.height;
    });
    return order;
  }

  SimulationConfig config_;
  WorkerPool& pool_;
  CapturePlan plan_;
  std::shared_ptr<DrawnScene> drawn_;
  std::vector<OccluderClass> occluders_;  ///< classes of the world's
  std::vector<WorldTag> tags_;
  Rig nominal_rig_;
  Rig rig_;  ///< the true rig
  DrivenRover rover_;
  std::optional<Pose> T_world_map_;  ///< aligns the estimator's map, once there is one
  FrameTiming timing_;
  ExposureControl exposure_;
  InertialSensor inertial_;
  ImuSample first_reading_;
  WheelSensor wheels_;
  std::vector<CameraSensor> cameras_;
  StageTimes times_;
  Stamp window_ = 0;  ///< maximum time between an image's exposure and the frame's instant
  std::int64_t frames_ = 0;
  std::int64_t index_ = 0;
};

}  // namespace

std::unique_ptr<SimulatedSource> make_simulation(const SimulationConfig& config, std::uint64_t seed,
                                                 const CacheFolder& cache, WorkerPool& pool,
                                                 const CapturePlan& plan,
                                                 const std::shared_ptr<DrawnScene>& drawn) {
  validate(config);
  return std::make_unique<Simulation>(config, seed, cache, pool, plan, drawn, Driver::kRoute);
}

std::unique_ptr<CommandedSimulation> make_commanded_simulation(
    const SimulationConfig& config, std::uint64_t seed, const CacheFolder& cache, WorkerPool& pool,
    const CapturePlan& plan, const std::shared_ptr<DrawnScene>& drawn) {
  validate(config);
  return std::make_unique<Simulation>(config, seed, cache, pool, plan, drawn, Driver::kCommands);
}

}  // namespace vinebench::sim
