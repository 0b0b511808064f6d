// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/rig.h"
#include "core/time.h"
#include "sim/sensors/effects/fault_scope.h"

namespace vinebench::sim {

/// When images are taken and what their stamps say. All cameras at each frame's instant, exactly
/// stamped, by default.
struct FrameTimingConfig {
  struct Trigger {
    std::string camera;    ///< name in the rig
    double delay = 0;      ///< s, that it exposes later than the frame's instant
    bool stamped = false;  ///< whether its images' stamps say so (Frame::image_stamps)
    template <class Archive>
    void serialize(Archive& archive) {
      archive("camera", camera);
      archive("delay", delay, Range::between(-0.05, 0.05));
      archive("stamped", stamped);
    }
  };
  double stamp_jitter = 0;  ///< s, standard deviation of the stamp's error, at most 3 of them
  double stamp_offset = 0;  ///< s, that every stamp says too much
  std::vector<Trigger> triggers;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("stamp_jitter", stamp_jitter, Range::between(0, 0.05));
    archive("stamp_offset", stamp_offset, Range::between(-0.2, 0.2));
    archive("triggers", triggers);
  }
};

/// Images that never arrive. None by default.
struct FrameDropConfig {
  double camera_rate = 0;  ///< share of a camera's images, each camera by itself
  double frame_rate = 0;   ///< share of frames that lose the images of all cameras
  std::vector<FaultScope> bursts;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("camera_rate", camera_rate, Range::between(0, 1));
    archive("frame_rate", frame_rate, Range::between(0, 1));
    archive("bursts", bursts);
  }
};

/// Instants, stamps and drops of a rig's frames, each a function of the seed and the frame.
class FrameTiming {
 public:
  /// Throws Error where jitter or offset could bring a stamp to or before the one before it, a
  /// trigger's camera is not in the rig, or a stamped image would be nearer to another frame.
  FrameTiming(const FrameTimingConfig& timing, const FrameDropConfig& drops, const Rig& rig,
              std::uint64_t seed);

  Stamp instant(std::int64_t frame) const { return stamp_of_frame(frame, rate_hz_); }
  Stamp instant(std::int64_t frame, std::size_t camera) const {
    return instant(frame) + delays_[camera];
  }
  /// What the frame says of its instant; ascends from frame to frame.
  Stamp stamp(std::int64_t frame) const;
  /// Of each camera's image; empty where all have the frame's.
  std::vector<Stamp> image_stamps(std::int64_t frame) const;
  bool is_dropped(std::int64_t frame, std::size_t camera) const;
  /// The most that a camera exposes before or after the frame's instant.
  Stamp longest_delay() const;

 private:
  FrameTimingConfig timing_;
  FrameDropConfig drops_;
  double rate_hz_;
  std::uint64_t seed_;
  std::vector<std::string> cameras_;
  std::vector<Stamp> delays_;
  std::vector<Stamp> stamped_delays_;  ///< of each camera, as its stamps tell; empty if none does
};

}  // namespace vinebench::sim
