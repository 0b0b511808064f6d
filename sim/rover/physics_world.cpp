// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/physics_world.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <system_error>

#include "core/files/files.h"
#include "core/util/error.h"
#include "core/util/xml_text.h"
#include "sim/rover/mjcf_check.h"
#include "sim/vineyard/occluders/occluder_shape.h"
#include "sim/vineyard/trellis.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

constexpr double kGroundBase = 1.0;    // m of ground below its lowest point
constexpr double kTrunkRadius = 0.03;  // m
constexpr double kTrunkHeight = 0.5;   // m; higher than the rover

/// A temporary text file, removed at the end of its scope.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name_template, int suffix_length)
      : name_(name_template), descriptor_(mkstemps(name_.data(), suffix_length)) {
    if (descriptor_ < 0) {
      fail("cannot create a temporary file {}: {}", name_template,
           std::generic_category().message(errno));
    }
    close(descriptor_);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { unlink(name_.c_str()); }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  int descriptor_;
};

std::filesystem::path temporary_folder() {
  std::error_code problem;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(problem);
  if (problem) fail("no folder for temporary files (TMPDIR): {}", problem.message());
  return std::filesystem::canonical(folder);
}

/// By default MuJoCo prints warnings and writes MUJOCO_LOG.TXT; `check` reports them instead.
/// Errors, such as too little memory, would end the program.
void take_messages() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_warning = [](const char*) {};
    mju_user_error = [](const char* message) { fail("MuJoCo: {}", message); };
  });
}

std::string upright(const std::string& name, const Eigen::Vector3d& foot,
                    const Eigen::Vector3d& head, double radius) {
  return fmt::format(
      "    <geom name=\"{}\" type=\"cylinder\" fromto=\"{} {} {} {} {} {}\" size=\"{}\"/>\n", name,
      foot.x(), foot.y(), foot.z(), head.x(), head.y(), head.z(), radius);
}

std::string posts_mjcf(const WorldConfig& world, const WorldLayout& layout) {
  std::string geoms;
  const double height = world.trellis.post_height;
  const std::vector<TrellisPost>& posts = layout.posts;
  for (std::size_t i = 0; i < posts.size(); ++i) {
    const double ground = layout.terrain.height(posts[i].foot);
    const Eigen::Vector2d head = posts[i].at(height);
    geoms += upright(fmt::format("post {}", i), {posts[i].foot.x(), posts[i].foot.y(), ground},
                     {head.x(), head.y(), ground + height}, posts[i].radius);
  }
  const std::vector<Brace> braces = trellis_braces(world.trellis, layout);
  for (std::size_t i = 0; i < braces.size(); ++i) {
    geoms += upright(fmt::format("brace {}", i), braces[i].foot, braces[i].head, braces[i].radius);
  }
  return geoms;
}

std::string trunks_mjcf(const WorldConfig& world, const WorldLayout& layout, std::uint64_t seed) {
  std::string geoms;
  const std::vector<Eigen::Vector2d> vines = layout.vine_feet();
  for (std::size_t i = 0; i < vines.size(); ++i) {
    if (vine_at(world, seed, i) == VineKind::kNone) continue;
    const Eigen::Vector3d foot(vines[i].x(), vines[i].y(), layout.terrain.height(vines[i]));
    geoms += upright(fmt::format("trunk {}", i), foot,
                     foot + kTrunkHeight * Eigen::Vector3d::UnitZ(), kTrunkRadius);
  }
  return geoms;
}

std::string block_mjcf(const std::string& name, const Pose& T_parent_occluder, const Block& block) {
  const Eigen::Vector3d at = T_parent_occluder * block.centre;
  const Eigen::Quaterniond& q = T_parent_occluder.rotation;
  return fmt::format(
      "    <geom name=\"{}\" type=\"box\" pos=\"{} {} {}\" quat=\"{} {} {} {}\" size=\"{} {} "
      "{}\"/>\n",
      name, at.x(), at.y(), at.z(), q.w(), q.x(), q.y(), q.z(), block.half.x(), block.half.y(),
      block.half.z());
}

/// Class and place in the world's list.
std::string occluder_name(const WorldConfig& world, std::size_t index) {
  return fmt::format("{} {}", name_of(class_of(world.occluders[index])), index);
}

/// Named by the occluder, and where there are several, the block.
std::string blocks_mjcf(const WorldConfig& world, std::size_t index,
                        const Pose& T_parent_occluder) {
  const Occluder& occluder = world.occluders[index];
  const std::vector<Block> blocks = shape_of(occluder).blocks(occluder);
  std::string geoms;
  for (std::size_t part = 0; part < blocks.size(); ++part) {
    const std::string of_part = blocks.size() > 1 ? fmt::format(" block {}", part) : "";
    geoms += block_mjcf(occluder_name(world, index) + of_part, T_parent_occluder, blocks[part]);
  }
  return geoms;
}

/// Geoms of the occluders that keep still.
std::string occluders_mjcf(const WorldConfig& world, const WorldLayout& layout) {
  std::string geoms;
  for (std::size_t i = 0; i < world.occluders.size(); ++i) {
    if (!world.occluders[i].path) geoms += blocks_mjcf(world, i, layout.occluders[i]);
  }
  return geoms;
}

/// Bodies of the occluders that move: what they push away does not slow them.
std::string moving_mjcf(const WorldConfig& world, const WorldLayout& layout) {
  std::string bodies;
  for (std::size_t i = 0; i < world.occluders.size(); ++i) {
    if (!world.occluders[i].path) continue;
    const Pose& pose = layout.occluders[i];
    const Eigen::Vector3d& p = pose.translation;
    const Eigen::Quaterniond& q = pose.rotation;
    bodies += fmt::format(
        "    <body name=\"{}\" mocap=\"true\" childclass=\"obstacle\" pos=\"{} {} {}\" "
        "quat=\"{} {} {} {}\">\n{}    </body>\n",
        occluder_name(world, i), p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(),
        blocks_mjcf(world, i, {}));
  }
  return bodies;
}

/// Lowest and highest node, m.
std::pair<double, double> extent(const Terrain& terrain) {
  double low = 0, high = 0;
  for (int row = 0; row < terrain.rows(); ++row) {
    for (int column = 0; column < terrain.columns(); ++column) {
      const double height = terrain.node_height(column, row);
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  return {low, high};
}

/// The ground's elements under <mujoco> and under <worldbody>.
using GroundText = std::pair<std::string, std::string>;

GroundText plane_mjcf(const WorldConfig& world) {
  return {"", fmt::format("    <geom name=\"ground\" class=\"ground\" type=\"plane\" size=\"{} {} "
                          "1\"/>\n",
                          world.ground_size / 2, world.ground_size / 2)};
}

/// The height field's elevations are filled in after loading.
GroundText height_field_mjcf(const Terrain& terrain) {
  const auto [low, high] = extent(terrain);
  const Eigen::AlignedBox2d box = terrain.box();
  const Eigen::Vector2d middle = terrain.frame().to_world(box.center());
  const Eigen::Vector2d half = box.sizes() / 2;
  const double heading = terrain.frame().heading();
  return {
      fmt::format("  <asset><hfield name=\"ground\" nrow=\"{}\" ncol=\"{}\" size=\"{} {} {} "
                  "{}\"/></asset>\n",
                  terrain.rows(), terrain.columns(), half.x(), half.y(), high - low, kGroundBase),
      fmt::format("    <geom name=\"ground\" class=\"ground\" type=\"hfield\" "
                  "hfield=\"ground\" pos=\"{} {} {}\" quat=\"{} 0 0 {}\"/>\n",
                  middle.x(), middle.y(), low, std::cos(heading / 2), std::sin(heading / 2))};
}

}  // namespace

std::string world_mjcf(const WorldConfig& world, const WorldLayout& layout,
                       const std::filesystem::path& rover_include, std::uint64_t seed) {
  const Terrain& terrain = layout.terrain;
  std::string geoms = posts_mjcf(world, layout) + trunks_mjcf(world, layout, seed);
  geoms += occluders_mjcf(world, layout);
  const auto [asset, ground] = terrain.flat() ? plane_mjcf(world) : height_field_mjcf(terrain);
  return fmt::format(R"(<mujoco>
  <include file="{}"/>
  <default>
    <default class="ground"><geom contype="0" conaffinity="1" friction="0.8"/></default>
    <default class="obstacle"><geom contype="0" conaffinity="2" friction="0.4"/></default>
  </default>
{}  <worldbody>
{}  </worldbody>
  <worldbody>
    <body name="obstacles" childclass="obstacle">
{}    </body>
{}  </worldbody>
</mujoco>
)",
                     xml_escaped(rover_include.string()), asset, ground, geoms,
                     moving_mjcf(world, layout));
}

PhysicsWorld::PhysicsWorld(const std::filesystem::path& rover, const WorldConfig& world,
                           std::uint64_t seed)
    : rover_(rover) {
  take_messages();
  if (mj_version() != mjVERSION_HEADER) {
    fail("MuJoCo's library is version {}, its headers {}: expected the same", mj_version(),
         mjVERSION_HEADER);
  }
  std::error_code problem;
  if (!std::filesystem::is_regular_file(rover, problem)) {
    fail("{}: no such file, expected the rover's MJCF model", rover.string());
  }
  check_mjcf_files(rover);
  const WorldLayout layout = lay_out(world);
  const std::filesystem::path folder = temporary_folder();
  const TemporaryFile file((folder / "vinebench-XXXXXX.xml").string(), 4);
  // MuJoCo prepends the including file's folder to an included name, even an absolute one.
  const std::filesystem::path include = std::filesystem::relative(rover, folder, problem);
  if (problem) fail("{}: {}", rover.string(), problem.message());
  write_file_atomically(file.name(), world_mjcf(world, layout, include, seed));
  std::array<char, 1000> reason{};
  model_.reset(mj_loadXML(file.name().c_str(), nullptr, reason.data(), reason.size()));
  if (!model_) fail("{}: is not a valid MJCF model: {}", rover.string(), reason.data());
  if (!layout.terrain.flat()) raise_ground(layout.terrain);
  state_.reset(mj_makeData(model_.get()));
  if (!state_) fail("{}: no memory for the physics' state", rover.string());
  for (std::size_t i = 0; i < world.occluders.size(); ++i) {
    if (!world.occluders[i].path) continue;
    const int body = find(mjOBJ_BODY, occluder_name(world, i));
    moving_.push_back(
        {model_->body_mocapid[body], OccluderMotion(world.occluders[i], layout.terrain)});
  }
}

void PhysicsWorld::move_occluders(Stamp stamp) {
  for (const auto& [body, motion] : moving_) {
    const Pose pose = motion.at(stamp);
    const Eigen::Quaterniond& q = pose.rotation;
    Eigen::Map<Eigen::Vector3d>(state_->mocap_pos + 3 * body) = pose.translation;
    Eigen::Map<Eigen::Vector4d>(state_->mocap_quat + 4 * body) << q.w(), q.x(), q.y(), q.z();
  }
}

/// MuJoCo stores elevations relative to the height field's maximum.
void PhysicsWorld::raise_ground(const Terrain& terrain) {
  const int field = model_->geom_dataid[find(mjOBJ_GEOM, "ground")];
  const double low = model_->geom_pos[3 * find(mjOBJ_GEOM, "ground") + 2];
  const double range = model_->hfield_size[4 * field + 2];
  float* elevation = model_->hfield_data + model_->hfield_adr[field];
  for (int row = 0; row < terrain.rows(); ++row) {
    for (int column = 0; column < terrain.columns(); ++column) {
      *elevation++ = static_cast<float>((terrain.node_height(column, row) - low) / range);
    }
  }
}

void PhysicsWorld::check() const {
  for (int i = 0; i < mjNWARNING; ++i) {
    if (state_->warning[i].number > 0) {
      fail("{}: the physics failed at {:.4f} s: {}", rover_.string(), state_->time,
           mju_warningText(i, static_cast<std::size_t>(state_->warning[i].lastinfo)));
    }
  }
}

int PhysicsWorld::find(mjtObj type, const std::string& name) const {
  const int index = mj_name2id(model_.get(), type, name.c_str());
  if (index < 0) {
    fail("{}: expected a {} named '{}', found none", rover_.string(), mju_type2Str(type), name);
  }
  return index;
}

int PhysicsWorld::sensor_address(const std::string& name) const {
  return model_->sensor_adr[find(mjOBJ_SENSOR, name)];
}

}  // namespace vinebench::sim
