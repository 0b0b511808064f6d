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
#include "core/geometry/pose.h"
#include "core/slam_system.h"
#include "core/truth/site.h"
#include "sim/scene/scene.h"
#include "sim/world/daylight.h"
#include "sim/world/vines.h"

namespace vinebench::sim {

/// A vineyard as its YAML file describes it. World frame: x east, y north, z up; m.
struct WorldConfig {
  /// Where things may stand, m from the origin.
  static constexpr Range kPlace = Range::between(-5000, 5000);
  // What a laptop can still hold and draw; a larger vineyard is simulated a part at a time.
  static constexpr double kMostVines = 20'000;
  static constexpr double kMostRow = 20'000;       ///< m, of all rows together
  static constexpr double kMostGround = 200'000;   ///< m^2, of shaped ground
  static constexpr double kMostCells = 3'000'000;  ///< of the ground

  /// One row of the trellis.
  struct Row {
    Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< m; its first post
    Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< m; its last post
    template <class Archive>
    void serialize(Archive& archive) {
      archive("start", start, kPlace);
      archive("end", end, kPlace);
      archive.require((end - start).norm() > 0.1, "end", "expected a row of at least 0.1 m");
    }
  };
  using Vines = VinesConfig;
  /// Rows side by side, each `spacing` to the left of the one before.
  struct Block {
    int rows = 1;
    double length = 30;                                ///< m
    double spacing = 2.5;                              ///< m between rows
    double heading_deg = 0;                            ///< from east over north, along the rows
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, start of the first row
    template <class Archive>
    void serialize(Archive& archive) {
      archive("rows", rows, Range::between(1, 500));
      archive("length", length, Range::between(0.1, 2000));
      archive("spacing", spacing, Range::between(0.3, 50));
      archive("heading_deg", heading_deg, Range::between(-360, 360));
      archive("origin", origin, kPlace);
    }
  };
  /// The ground's shape: a slope with bumps on it, and ruts where wheels run.
  struct Terrain {
    std::int64_t seed = 1;
    double amplitude = 0;          ///< m, of the largest bumps up or down; 0 is even ground
    double wavelength = 3;         ///< m, from bump to bump
    double rut_depth = 0;          ///< m, of the wheel tracks
    double slope_percent = 0;      ///< rise over run
    double slope_heading_deg = 0;  ///< uphill, from east over north
    double cell = 0.1;             ///< m, side of a cell of the height field
    double margin = 6;  ///< m of ground round the rows that is shaped and can be driven on
    bool flat() const { return amplitude == 0 && rut_depth == 0 && slope_percent == 0; }
    template <class Archive>
    void serialize(Archive& archive) {
      archive("seed", seed, Range::non_negative());
      archive("amplitude", amplitude, Range::between(0, 0.5));
      archive("wavelength", wavelength, Range::between(0.5, 100));
      archive("rut_depth", rut_depth, Range::between(0, 0.3));
      archive("slope_percent", slope_percent, Range::between(0, 30));
      archive("slope_heading_deg", slope_heading_deg, Range::between(-360, 360));
      archive("cell", cell, Range::between(0.05, 0.5));
      archive("margin", margin, Range::between(2, 30));
    }
  };
  /// What covers the ground.
  struct Ground {
    enum class Aisles { kSoil, kGrass };
    Aisles aisles = Aisles::kSoil;
    double bare_strip = 0.8;    ///< m, width of the strip without grass under the vines
    double track_gauge = 1.25;  ///< m between the middles of the wheel tracks
    double track_width = 0.28;  ///< m
    friend std::vector<std::string> yaml_names(Aisles) { return {"soil", "grass"}; }
    template <class Archive>
    void serialize(Archive& archive) {
      archive("aisles", aisles);
      archive("bare_strip", bare_strip, Range::between(0, 5));
      archive("track_gauge", track_gauge, Range::between(0, 5));
      archive("track_width", track_width, Range::between(0.05, 2));
    }
  };
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
    int row = 0;
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
  struct Tag {
    std::string family = "tag36h11";
    int id = 0;
    double size = 0.161;                                 ///< m, side of the black square
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, its centre; z above the ground
    double facing_deg = 0;                               ///< heading of the printed face
    bool registered = true;                              ///< its pose is given to the SLAM system
    SurveyError survey_error;                            ///< of the pose that is given
    std::optional<PostSide> post;                        ///< sets position and facing_deg
    double ground = 0;  ///< m, height of the ground below; set by place()
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
  struct Box {
    std::string name = "carton";
    Eigen::Vector3d size{0.6, 0.4, 0.4};                 ///< m, along its own x, y, z
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, middle of its foot
    double yaw_deg = 0;
    Eigen::Vector3d colour{0.42, 0.29, 0.18};  ///< sRGB, 0 to 1
    bool printed = false;                      ///< a maker's mark, lines of text, symbols
    std::int64_t print_seed = 0;               ///< which print
    double ground = 0;                         ///< m, height of the ground below; set by place()
    template <class Archive>
    void serialize(Archive& archive) {
      archive("name", name);
      archive("size", size, Range::between(0.01, 10));
      archive("position", position, kPlace);
      archive("yaw_deg", yaw_deg, Range::between(-360, 360));
      archive("colour", colour, Range::between(0, 1));
      archive("printed", printed);
      archive("print_seed", print_seed, Range::non_negative());
    }
  };
  /// Who and what else may stand in the way.
  struct Obstacle {
    enum class Kind { kPerson, kCrate };
    Kind kind = Kind::kPerson;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, middle of its foot
    double yaw_deg = 0;                                  ///< where a person looks
    double height = 1.75;                                ///< m; a crate's is 0.30 m
    Eigen::Vector3d colour{0.16, 0.30, 0.55};            ///< sRGB, 0 to 1; of the shirt or crate
    friend std::vector<std::string> yaml_names(Kind) { return {"person", "crate"}; }
    template <class Archive>
    void serialize(Archive& archive) {
      archive("kind", kind);
      archive("position", position, kPlace);
      archive("yaw_deg", yaw_deg, Range::between(-360, 360));
      archive("height", height, Range::between(0.5, 2.5));
      archive("colour", colour, Range::between(0, 1));
    }
  };

  std::string name = "world";
  double ground_size = 40;     ///< m, side of the square of ground around the rows' middle
  std::optional<Block> block;  ///< rows in regular order; place() turns it into `rows`
  std::vector<Row> rows;
  Vines vines;
  Trellis trellis;
  Terrain terrain;
  Ground ground;
  std::vector<Tag> tags;
  std::vector<Box> boxes;
  std::vector<Obstacle> obstacles;
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
    archive("boxes", boxes);
    archive("obstacles", obstacles);
    archive("sun", sun);
    archive("sky", sky);
    archive("wind", wind);
    archive.require(block || !rows.empty(), "rows", "expected at least one row");
    if (!has_sound_rows()) return;  // which is reported by now
    const auto [key, problem] = placing_problem();
    archive.require(problem.empty(), key, problem);
    if (problem.empty()) place();
  }

  /// Lays out what stands in relation to something else: the block's rows, the tags on posts, and
  /// everything on its ground. Reading a file does so; after changes in code, it may be called
  /// again. Throws Error where placing_problem() finds one.
  void place();

  /// What place() cannot do: the key at fault and why; both empty where all is well.
  std::pair<std::string, std::string> placing_problem() const;

  /// What makes the world larger than its limits: key and problem, as placing_problem().
  std::pair<std::string, std::string> size_problem() const;

  /// Turns the block into rows.
  void expand_block();

  /// There are rows, or a block of them, and none is shorter than 0.1 m.
  bool has_sound_rows() const;

  /// Why (family, id) is no AprilTag; empty when it is one.
  static std::string tag_problem(const std::string& family, int id);
};

/// A post as it stands.
struct TrellisPost {
  Eigen::Vector2d foot;  ///< m
  Eigen::Vector2d lean;  ///< m of its head outward for each m of height
  double radius = 0;     ///< m
  int row = 0;
  int index = 0;  ///< along its row
  bool end = false;
  Eigen::Vector2d at(double height) const { return foot + height * lean; }
};

/// All posts, row by row, from each row's start.
std::vector<TrellisPost> trellis_posts(const WorldConfig& world);

/// Where posts stand, m; each once, row by row.
std::vector<Eigen::Vector2d> post_positions(const WorldConfig& world);

/// A vine's place.
struct VinePlace {
  Eigen::Vector2d foot;  ///< m
  double heading = 0;    ///< rad, of its row
};

/// All places for vines, row by row; vine_at() tells which are empty.
std::vector<VinePlace> vine_places(const WorldConfig& world);

/// The feet of vine_places(), m.
std::vector<Eigen::Vector2d> vine_positions(const WorldConfig& world);

/// What stands at a vine's place.
enum class VineKind { kNone, kYoung, kGrown };

/// The one decision about the place of that index in vine_places(), for image and physics.
VineKind vine_at(const WorldConfig& world, std::uint64_t seed, std::size_t place);

/// Tag frame: x right and y down on the printed face, z into the tag.
Pose tag_pose(const WorldConfig::Tag& tag);

/// Frame of a box: its centre, z up.
Pose box_pose(const WorldConfig::Box& box);

/// The tags whose pose the SLAM system is told, with the errors of their survey.
std::vector<RegisteredTag> registered_tags(const WorldConfig& world);

/// All tags as they truly stand, in the order of the file.
std::vector<WorldTag> world_tags(const WorldConfig& world);

/// The world seen from above.
Site site_of(const WorldConfig& world);

/// Grows (or loads) the plants and assembles all that can be drawn. The plants of a seed are grown
/// once into `cache` as .glb files. Throws Error that names the mesh that cannot be loaded.
Scene build_scene(const WorldConfig& world, std::uint64_t seed, const std::filesystem::path& cache);

}  // namespace vinebench::sim
