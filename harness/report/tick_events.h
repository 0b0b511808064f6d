// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// Of a reason in files: "ambiguous", "misplaced", "duplicate".
const char* name_of(TagRejection reason);

/// Division, not multiplication: gives the double nearest to the decimal number.
double exact_seconds(Stamp stamp);

/// What can be said of a run while it goes on: converts ticks to events, in their order, and keeps
/// the state of intervals that have not ended. An event has `t` (s), `frame` and `event`.
class TickEvents {
 public:
  /// A camera is occluded from this share of its image on.
  TickEvents(const Rig& rig, double box_share) : rig_(rig), box_share_(box_share) {}

  /// Of the next tick.
  std::vector<nlohmann::ordered_json> of(const Tick& tick);

  /// An event of this tick, with further members.
  static nlohmann::ordered_json event(
      const Tick& tick, const char* name,
      const nlohmann::ordered_json& more = nlohmann::ordered_json::object());

 private:
  struct TagKey {
    int camera;
    std::string family;
    int id;
    auto operator<=>(const TagKey&) const = default;
  };
  using Rejection = std::pair<TagKey, TagRejection>;
  struct Sighting {
    std::int64_t last = 0;  ///< tick
    int frames = 0;
  };
  struct Begin {
    Stamp stamp = 0;
    double length = 0;  ///< of the true path until there, m
  };

  void add(const char* event,
           const nlohmann::ordered_json& more = nlohmann::ordered_json::object());
  void measure_path();
  void add_source_events();
  void add_losses();
  void add_occlusion(std::size_t camera);
  void add_sightings();
  void add_rejections();
  void add_calibration();
  void add_world();
  nlohmann::ordered_json describe(const TagKey& tag, std::optional<double> distance) const;

  Rig rig_;
  double box_share_;
  std::vector<nlohmann::ordered_json> events_;  ///< of the tick
  const Tick* tick_ = nullptr;
  std::int64_t at_ = -1;  ///< its number
  std::optional<Eigen::Vector3d> last_place_;
  double length_ = 0;  ///< of the true path, m
  bool had_pose_ = false;
  bool ever_had_pose_ = false;
  bool in_world_ = false;
  bool reckoned_ = false;
  std::map<std::size_t, Begin> occlusions_;  ///< by camera
  std::map<TagKey, Sighting> sightings_;
  std::set<Rejection> rejected_;  ///< in the previous frame
};

}  // namespace vinebench::harness
