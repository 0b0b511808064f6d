// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/truth/frame_source.h"
#include "tests/support/synthetic_texture.h"

// A textured wall 2 m ahead of a pair with 0.1 m of baseline: 200 px * 0.1 m / 2 m = 10 px of
// disparity. The pair moves 20 mm to its right a frame: 2 px.
namespace vinebench::test::wall {

inline constexpr int kFrames = 12;
inline constexpr int kWidth = 320;
inline constexpr int kHeight = 200;
inline constexpr double kFocal = 200;     // px
inline constexpr int kDisparity = 10;     // px
inline constexpr int kShift = 2;          // px a frame
inline constexpr double kStep = 0.02;     // m a frame
inline constexpr double kBaseline = 0.1;  // m
inline constexpr double kRate = 15;       // frames a second

/// Whole pixels of one wide image, so that each view is exact.
inline cv::Mat view(int shift) {
  static const cv::Mat wall =
      render_image(kWidth + kShift * kFrames + kDisparity, kHeight, SyntheticTexture(3));
  return wall.colRange(shift, shift + kWidth);
}

inline cv::Mat left_image(int frame) {
  return view(kShift * frame);
}
inline cv::Mat right_image(int frame) {
  return view(kShift * frame + kDisparity);
}

/// To the right of the camera is -y of the body.
inline Sample sample(int frame) {
  Sample sample;
  sample.frame.index = frame;
  sample.frame.stamp = stamp_of_frame(frame, kRate);
  sample.frame.images = {left_image(frame), right_image(frame)};
  sample.truth.T_world_body.translation = {0, -kStep * frame, 0};
  return sample;
}

inline Rig rig() {
  Rig rig;
  rig.name = "wall";
  rig.rate_hz = kRate;
  const PinholeCamera model{.width = kWidth,
                            .height = kHeight,
                            .fx = kFocal,
                            .fy = kFocal,
                            .cx = (kWidth - 1) / 2.0,
                            .cy = (kHeight - 1) / 2.0};
  rig.cameras = {{"left", model, Rig::mount({0, 0, 0}, {0, 0, 0})},
                 {"right", model, Rig::mount({0, -kBaseline, 0}, {0, 0, 0})}};
  rig.stereo_pairs = {{"front", 0, 1}};
  return rig;
}

class Source : public FrameSource {
 public:
  std::optional<Sample> next() override {
    return next_ < kFrames ? std::optional(sample(next_++)) : std::nullopt;
  }
  std::int64_t size() const override { return kFrames; }
  const Rig& rig() const override { return rig_; }
  const StageTimes& times() const override { return times_; }

 private:
  Rig rig_ = wall::rig();
  int next_ = 0;
  StageTimes times_;
};

}  // namespace vinebench::test::wall
