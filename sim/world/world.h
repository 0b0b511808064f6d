// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config_field.h"
#include "core/files/cache_folder.h"
#include "sim/scene/scene.h"
#include "sim/world/daylight.h"
#include "sim/world/ground_config.h"
#include "sim/world/occluders/occluder_lists.h"
#include "sim/world/rows.h"
#include "sim/world/vines.h"

namespace vinebench::sim {

/// A vineyard as its YAML file describes it. World frame: x east, y north, z up; m.
struct WorldConfig {
  // What a laptop can still hold and draw; a larger vineyard is simulated a part at a time.
  static constexpr double kMostVines = 20'000;
  static constexpr double kMostRow = 20'000;       ///< m, of all rows together
  static constexpr double kMostGround = 200'000;   ///< m^2, of shaped ground
  static constexpr double kMostCells = 3'000'000;  ///< of the ground
  static constexpr double kShortestRow = 0.1;      ///< m

  using Row = RowConfig;
  using Vines = VinesConfig;
  using Block = BlockConfig;
  using Terrain = TerrainConfig;
  using Ground = GroundConfig;
  struct Trellis {
    enum class Brace { kNone, kStrut, kAnchor };
    double post_spacing = 2.0;                      ///< m; one always stands at either end of a row
    double post_height = 1.6;                       ///< m
    double post_radius = 0.035;                     ///< m
    std::vector<double> wires{0.6, 0.9, 1.2, 1.5};  ///< m above ground
    double end_post_radius = 0.035;                 ///< m
    double end_lean_deg = 0;         ///< of the end posts' heads, outward along the row
    Brace end_brace = Brace::kNone;  ///< what holds an end post against the wires' pull
    double drip_line = 0;            ///< m above ground, of the water tube; 0 is none
    double drip_sag = 0.02;          ///< m, between two clips
    friend std::vector<std::string> yaml_names(Brace) { return {"none", "strut", "anchor"}; }
    template <class Archive>
    void serialize(Archive& archive) {
      archive("post_spacing", post_spacing, Range::between(0.3, 50));
      archive("post_height", post_height, Range::between(0.3, 6));
      archive("post_radius", post_radius, Range::between(0.005, 0.3));
      archive("wires", wires, Range::between(0.05, 6));
      archive.require(wires.size() <= 20, "wires", "expected at most 20");
      archive("end_post_radius", end_post_radius, Range::between(0.005, 0.3));
      archive("end_lean_deg", end_lean_deg, Range::between(0, 45));
      archive("end_brace", end_brace);
      archive("drip_line", drip_line, Range::between(0, 3));
      archive("drip_sag", drip_sag, Range::between(0, 0.5));
    }
  };
  /// A place on a post.
  struct PostSide {
    enum class Side { kLeft, kRight, kStart, kEnd };
    int row = 0;               ///< number of the row, from 0
    int index = 0;             ///< along the row; -1 is the last, -2 the one before
    Side side = Side::kRight;  ///< seen along the row from its start
    double height = 0.5;       ///< m above the ground
    friend std::vector<std::string> yaml_names(Side) { return {"left", "right", "start", "end"}; }
    template <class Archive>
    void serialize(Archive& archive) {
      archive("row", row, Range::non_negative());
      archive("index", index);
      archive("side", side);
      archive("height", height, Range::between(0.01, 6));
    }
  };
  /// By how much the registered pose of a tag is off the true one.
  struct SurveyError {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m, in the world frame
    double turn_deg = 0;                               ///< to the left, about the tag's centre
    template <class Archive>
    void serialize(Archive& archive) {
      archive("offset", offset, Range::between(-100, 100));
      archive("turn_deg", turn_deg, Range::between(-180, 180));
    }
  };
  /// Accuracy of the survey of all registered tags, standard deviations of each axis of a tag: an
  /// error is drawn for each, beside its own survey_error, and the SLAM system is told them.
  struct Survey {
    double position = 0;      ///< m
    double rotation_deg = 0;  ///< degrees
    template <class Archive>
    void serialize(Archive& archive) {
      archive("position", position, Range::between(0, 10));
      archive("rotation_deg", rotation_deg, Range::between(0, 90));
    }
  };
  struct Tag {
    std::string family = "tag36h11";                     ///< of AprilTag
    int id = 0;                                          ///< number in the family
    double size = 0.161;                                 ///< m, side of the black square
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, its centre; z above the ground
    double facing_deg = 0;                               ///< heading of the printed face
    bool registered = true;                              ///< its pose is given to the SLAM system
    SurveyError survey_error;                            ///< of the pose that is given
    std::optional<PostSide> post;                        ///< in place of position and facing_deg
    template <class Archive>
    void serialize(Archive& archive) {
      archive("family", family);
      archive("id", id, Range::non_negative());
      archive("size", size, Range::between(0.01, 5));
      archive("position", position, kPlace);
      archive("facing_deg", facing_deg, Range::between(-360, 360));
      archive("registered", registered);
      archive("survey_error", survey_error);
      archive("post", post);
      const std::string problem = tag_problem(family, id);
      archive.require(problem.empty(), "id", problem);
    }
  };
  std::string name = "world";  ///< of the world
  double ground_size = 40;     ///< m, side of the square of ground around the rows' middle
  std::optional<Block> block;  ///< rows in regular order, beside `rows`
  std::vector<Row> rows;
  Vines vines;
  Trellis trellis;
  Terrain terrain;
  Ground ground;
  std::vector<Tag> tags;
  Survey survey;
  std::vector<Occluder> occluders;
  SunConfig sun;
  SkyConfig sky;
  WindConfig wind;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("ground_size", ground_size, Range::between(1, 10000));
    archive("block", block);
    archive("rows", rows);
    archive("vines", vines);
    archive("trellis", trellis);
    archive("terrain", terrain);
    archive("ground", ground);
    archive("tags", tags);
    archive("survey", survey);
    serialize_occluders(archive, occluders, true);
    archive("sun", sun);
    archive("sky", sky);
    archive("wind", wind);
    archive.require(block || !rows.empty(), "rows", "expected at least one row");
    if (!has_sound_rows()) return;  // which is reported by now
    const auto [key, problem] = layout_problem();
    archive.require(problem.empty(), key, problem);
  }

  /// What lay_out() cannot do, beside which it is defined: the key at fault and why; both empty
  /// where all is well.
  std::pair<std::string, std::string> layout_problem() const;

  /// There are rows, or a block of them, and none is too short.
  bool has_sound_rows() const;

  /// Why (family, id) is no AprilTag; empty when it is one.
  static std::string tag_problem(const std::string& family, int id);
};

/// What stands at a vine's place.
enum class VineKind { kNone, kYoung, kGrown };

/// The one decision about the place of that index in WorldLayout::vines, for image and physics.
VineKind vine_at(const WorldConfig& world, std::uint64_t seed, std::size_t place);

/// Grows (or loads) the plants and assembles all that can be drawn. The plants of a seed are grown
/// once into `cache` as .glb files, or each time where it cannot be used. Throws Error that names
/// the mesh that cannot be loaded. Unless it is `painted`, its textures are not those to be seen,
/// which take most of the time.
Scene build_scene(const WorldConfig& world, std::uint64_t seed, const CacheFolder& cache,
                  bool painted = true);

}  // namespace vinebench::sim
