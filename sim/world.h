// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene.h"
#include "sim/vines.h"
#include "slam/base/pose.h"
#include "slam/base/slam_system.h"
#include "slam/base/yaml.h"

namespace vinebench {

/// A vineyard as its YAML file describes it. World frame: x east, y north, z up; m.
struct WorldConfig {
  /// One row of the trellis.
  struct Row {
    Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< m; its first post
    Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< m; its last post
    template <class Archive>
    void serialize(Archive& archive) {
      archive("start", start);
      archive("end", end);
      archive.require((end - start).norm() > 0.1, "end", "expected a row of at least 0.1 m");
    }
  };
  using Vines = VinesConfig;
  struct Trellis {
    double post_spacing = 2.0;                      ///< m; one always stands at either end of a row
    double post_height = 1.6;                       ///< m
    double post_radius = 0.035;                     ///< m
    std::vector<double> wires{0.6, 0.9, 1.2, 1.5};  ///< m above ground
    template <class Archive>
    void serialize(Archive& archive) {
      archive("post_spacing", post_spacing, Range::between(0.3, 50));
      archive("post_height", post_height, Range::between(0.3, 6));
      archive("post_radius", post_radius, Range::between(0.005, 0.3));
      archive("wires", wires, Range::between(0.05, 6));
    }
  };
  struct Tag {
    std::string family = "tag36h11";
    int id = 0;
    double size = 0.161;                                 ///< m, side of the black square
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, its centre
    double facing_deg = 0;                               ///< heading of the printed face
    bool registered = true;                              ///< its pose is given to the SLAM system
    template <class Archive>
    void serialize(Archive& archive) {
      archive("family", family);
      archive("id", id, Range::non_negative());
      archive("size", size, Range::between(0.01, 5));
      archive("position", position);
      archive("facing_deg", facing_deg, Range::between(-360, 360));
      archive("registered", registered);
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
    template <class Archive>
    void serialize(Archive& archive) {
      archive("name", name);
      archive("size", size, Range::between(0.01, 10));
      archive("position", position);
      archive("yaw_deg", yaw_deg, Range::between(-360, 360));
      archive("colour", colour, Range::between(0, 1));
    }
  };
  struct Sun {
    double azimuth_deg = 140;   ///< heading from north over east, where the sun stands
    double elevation_deg = 50;  ///< above the horizon
    template <class Archive>
    void serialize(Archive& archive) {
      archive("azimuth_deg", azimuth_deg, Range::between(-360, 360));
      archive("elevation_deg", elevation_deg, Range::between(1, 90));
    }
  };

  std::string name = "world";
  double ground_size = 40;  ///< m, side of the square of ground around the origin
  std::vector<Row> rows;
  Vines vines;
  Trellis trellis;
  std::vector<Tag> tags;
  std::vector<Box> boxes;
  Sun sun;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("ground_size", ground_size, Range::between(1, 10000));
    archive("rows", rows);
    archive("vines", vines);
    archive("trellis", trellis);
    archive("tags", tags);
    archive("boxes", boxes);
    archive("sun", sun);
    archive.require(!rows.empty(), "rows", "expected at least one row");
  }

  /// Why (family, id) is no AprilTag; empty when it is one.
  static std::string tag_problem(const std::string& family, int id);
};

/// Where posts stand, m; each once, row by row.
std::vector<Eigen::Vector2d> post_positions(const WorldConfig& world);

/// Where vines stand, m; row by row.
std::vector<Eigen::Vector2d> vine_positions(const WorldConfig& world);

/// Tag frame: x right and y down on the printed face, z into the tag.
Pose tag_pose(const WorldConfig::Tag& tag);

/// Frame of a box: its centre, z up.
Pose box_pose(const WorldConfig::Box& box);

/// The tags whose pose the SLAM system is told.
std::vector<RegisteredTag> registered_tags(const WorldConfig& world);

/// Grows (or loads) the plants and assembles all that can be drawn. The plants of a seed are grown
/// once into `cache` as .glb files. Throws Error that names the mesh that cannot be loaded.
Scene build_scene(const WorldConfig& world, std::uint64_t seed, const std::filesystem::path& cache);

}  // namespace vinebench
