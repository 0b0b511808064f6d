// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "sim/truth.h"
#include "slam/base/error.h"

namespace vinebench {
namespace {

/// The position loop runs at 50 Hz.
constexpr Stamp kControlPeriod = kNanosecondsPerSecond / 50;

class Simulation : public FrameSource {
 public:
  Simulation(const SimulationConfig& config, std::uint64_t seed, const std::filesystem::path& cache,
             WorkerPool& pool)
      : config_(config),
        seed_(seed),
        pool_(pool),
        rig_(load_rig(config.rover.rig)),
        route_(config.route),
        rover_(config.rover, config.world, route_.start(), seed) {
    const Scene scene = build_scene(config.world, seed, cache);
    for (int i = 0; i < pool.threads(); ++i) renderers_.emplace_back(scene, config.renderer);
    const double route_seconds = to_seconds(route_.duration());
    const double seconds = std::min(config.duration.value_or(route_seconds), route_seconds);
    frames_ = static_cast<std::int64_t>(std::floor(seconds * rig_.rate_hz + 1e-9)) + 1;
  }

  std::optional<Sample> next() override {
    if (index_ >= frames_) return std::nullopt;
    Sample sample;
    sample.frame.index = index_;
    sample.frame.stamp = stamp_of_frame(index_, rig_.rate_hz);
    drive(sample.frame);
    sample.truth.T_world_body = rover_.T_world_body();
    render(sample);
    ++index_;
    return sample;
  }

  std::int64_t size() const override { return frames_; }
  const Rig& rig() const override { return rig_; }
  const StageTimes& times() const override { return times_; }

 private:
  void drive(Frame& frame) {
    const ScopedTimer timer(times_, "physics");
    for (; next_control_ <= frame.stamp; next_control_ += kControlPeriod) {
      rover_.advance_to(next_control_, frame.imu, frame.wheels);
      rover_.command(follow(route_.at(next_control_), rover_.T_world_body()));
    }
    rover_.advance_to(frame.stamp, frame.imu, frame.wheels);
  }

  /// Each renderer draws every so-manieth camera; who draws what changes no pixel.
  void render(Sample& sample) {
    const std::size_t cameras = rig_.cameras.size();
    std::vector<double> spent(cameras);
    sample.frame.images.resize(cameras);
    sample.truth.box_share.assign(cameras, 0);
    std::vector<std::vector<int>> visible(cameras);
    std::atomic<std::size_t> next{0};
    const std::vector<std::size_t> order = largest_first();
    pool_.for_each(renderers_.size(), [&](std::size_t lane) {
      for (std::size_t i = next++; i < cameras; i = next++) {
        const std::size_t camera = order[i];
        const auto start = std::chrono::steady_clock::now();
        render_camera(renderers_[lane], camera, sample, visible[camera]);
        spent[camera] =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count();
      }
    });
    for (std::size_t camera = 0; camera < cameras; ++camera) {
      times_.add("render " + rig_.cameras[camera].name, spent[camera]);
      for (const int tag : visible[camera]) sample.truth.visible_tags.push_back(tag);
    }
    std::ranges::sort(sample.truth.visible_tags);
    const auto repeated = std::ranges::unique(sample.truth.visible_tags);
    sample.truth.visible_tags.erase(repeated.begin(), repeated.end());
  }

  void render_camera(Renderer& renderer, std::size_t camera, Sample& sample,
                     std::vector<int>& visible) const {
    const RigCamera& mounted = rig_.cameras[camera];
    const Pose T_world_cam = sample.truth.T_world_body * mounted.T_body_cam;
    const bool reads_tags = std::ranges::count(rig_.tag_cameras, static_cast<int>(camera)) > 0;
    Renderer::Request request;
    request.labels = reads_tags || !config_.world.boxes.empty();
    Picture picture = renderer.render(mounted.model, T_world_cam, request);
    if (request.labels) sample.truth.box_share[camera] = label_share(picture.labels, Label::kBox);
    if (reads_tags) {
      for (std::size_t t = 0; t < config_.world.tags.size(); ++t) {
        if (is_tag_visible(config_.world.tags[t], mounted.model, T_world_cam, picture.labels)) {
          visible.push_back(static_cast<int>(t));
        }
      }
    }
    add_image_noise(picture.rgb, config_.noise, seed_, static_cast<int>(camera),
                    sample.frame.index);
    sample.frame.images[camera] = std::move(picture.rgb);
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
  std::uint64_t seed_;
  WorkerPool& pool_;
  Rig rig_;
  Route route_;
  Rover rover_;
  std::vector<Renderer> renderers_;
  StageTimes times_;
  std::int64_t frames_ = 0;
  std::int64_t index_ = 0;
  Stamp next_control_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> make_simulation(const SimulationConfig& config, std::uint64_t seed,
                                             const std::filesystem::path& cache, WorkerPool& pool) {
  validate(config);
  return std::make_unique<Simulation>(config, seed, cache, pool);
}

}  // namespace vinebench
