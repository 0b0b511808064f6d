// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/physics_world.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <system_error>

#include "slam/base/error.h"
#include "slam/base/files.h"

namespace vinebench {
namespace {

constexpr double kTrunkRadius = 0.03;  // m
constexpr double kTrunkHeight = 0.5;   // m; nothing of the rover's hull is higher

/// A text file under a name of its own, gone at the end of its scope.
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

/// MuJoCo prints warnings and writes MUJOCO_LOG.TXT unless told otherwise; `check` reports them.
void silence_warnings() {
  static std::once_flag once;
  std::call_once(once, [] { mju_user_warning = [](const char*) {}; });
}

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string upright(const std::string& name, const Eigen::Vector2d& foot, double height,
                    double radius) {
  return fmt::format(
      "    <geom name=\"{}\" type=\"cylinder\" fromto=\"{} {} 0 {} {} {}\" size=\"{}\"/>\n", name,
      foot.x(), foot.y(), foot.x(), foot.y(), height, radius);
}

std::string carton(const std::string& name, const WorldConfig::Box& box) {
  const Pose pose = box_pose(box);
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format(
      "    <geom name=\"{}\" type=\"box\" pos=\"{} {} {}\" quat=\"{} {} {} {}\" size=\"{} {} "
      "{}\"/>\n",
      name, pose.translation.x(), pose.translation.y(), pose.translation.z(), q.w(), q.x(), q.y(),
      q.z(), box.size.x() / 2, box.size.y() / 2, box.size.z() / 2);
}

}  // namespace

std::string world_mjcf(const WorldConfig& world, const std::filesystem::path& rover_include) {
  std::string geoms;
  const std::vector<Eigen::Vector2d> posts = post_positions(world);
  for (std::size_t i = 0; i < posts.size(); ++i) {
    geoms += upright(fmt::format("post {}", i), posts[i], world.trellis.post_height,
                     world.trellis.post_radius);
  }
  const std::vector<Eigen::Vector2d> vines = vine_positions(world);
  for (std::size_t i = 0; i < vines.size(); ++i) {
    geoms += upright(fmt::format("trunk {}", i), vines[i], kTrunkHeight, kTrunkRadius);
  }
  for (std::size_t i = 0; i < world.boxes.size(); ++i) {
    geoms += carton(fmt::format("box {}", i), world.boxes[i]);
  }
  return fmt::format(R"(<mujoco>
  <include file="{}"/>
  <default>
    <default class="ground"><geom contype="0" conaffinity="1" friction="0.8"/></default>
    <default class="obstacle"><geom contype="0" conaffinity="2" friction="0.4"/></default>
  </default>
  <worldbody>
    <geom name="ground" class="ground" type="plane" size="{} {} 1"/>
  </worldbody>
  <worldbody>
    <body name="obstacles" childclass="obstacle">
{}    </body>
  </worldbody>
</mujoco>
)",
                     xml_escaped(rover_include.string()), world.ground_size / 2,
                     world.ground_size / 2, geoms);
}

PhysicsWorld::PhysicsWorld(const std::filesystem::path& rover, const WorldConfig& world)
    : rover_(rover) {
  silence_warnings();
  if (mj_version() != mjVERSION_HEADER) {
    fail("MuJoCo's library is version {}, its headers {}: expected the same", mj_version(),
         mjVERSION_HEADER);
  }
  std::error_code problem;
  if (!std::filesystem::is_regular_file(rover, problem)) {
    fail("{}: no such file, expected the rover's MJCF model", rover.string());
  }
  const std::filesystem::path folder = temporary_folder();
  const TemporaryFile file((folder / "vinebench-XXXXXX.xml").string(), 4);
  // MuJoCo joins an included name to the folder of the including file, even an absolute one.
  const std::filesystem::path include = std::filesystem::relative(rover, folder, problem);
  if (problem) fail("{}: {}", rover.string(), problem.message());
  write_file_atomically(file.name(), world_mjcf(world, include));
  std::array<char, 1000> reason{};
  model_.reset(mj_loadXML(file.name().c_str(), nullptr, reason.data(), reason.size()));
  if (!model_) fail("{}: no valid MJCF model: {}", rover.string(), reason.data());
  state_.reset(mj_makeData(model_.get()));
  if (!state_) fail("{}: no memory for the physics' state", rover.string());
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

}  // namespace vinebench
