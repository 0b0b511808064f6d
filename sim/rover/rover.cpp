// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/rover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/util/error.h"
#include "core/util/random.h"
#include "sim/rover/inertial_average.h"
#include "sim/rover/physics_world.h"
#include "sim/rover/wheel_controller.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

constexpr std::array<const char*, 4> kWheelNames{"front_left", "front_right", "rear_left",
                                                 "rear_right"};
constexpr Stamp kSettling = 3 * kNanosecondsPerSecond;  // springs and speed loops settle
constexpr double kGeometryTolerance = 0.002;            // m, between model and configuration
constexpr double kSpread = 0.01;                        // variation of motors and friction by seed
constexpr double kGrip = 20;  // rad/s, of the critically damped hold of a carried rover

Eigen::Vector3d vector_of(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

/// The physics runs in steps of fixed length, up to one step past `now`. Between two steps the
/// truth is linear, consistent with semi-implicit Euler: the velocity of a step's end applies to
/// the whole step.
struct Rover::Physics {
  Physics(const RoverConfig& rover, const WorldConfig& world_config, std::uint64_t seed);

  void find_parts();
  void check_geometry() const;
  void vary(std::uint64_t seed);
  void settle(const Eigen::Vector3d& start);
  void place(const Eigen::Vector3d& start);
  void drop_on_ground(const Eigen::Vector3d& start);
  bool is_rover(int geom) const;
  const mjContact* contact_beside_ground() const;
  void check_clear(const Eigen::Vector3d& start) const;
  void check_on_ground() const;
  void step();
  void hold();
  void release();
  void sample(Stamp until, std::vector<ImuSample>& imu, std::vector<WheelSample>& wheels);

  Pose pose() const;
  WheelArray angles() const;
  Pose pose_at(Stamp stamp) const { return interpolate(previous_pose, pose(), fraction(stamp)); }
  ImuSample felt() const;
  WheelSample wheels_at(Stamp stamp) const;
  double fraction(Stamp stamp) const {
    return 1.0 - static_cast<double>(time - stamp) / static_cast<double>(step_length);
  }

  RoverConfig config;
  Terrain terrain;
  PhysicsWorld world;
  MecanumDrive drive;
  std::vector<SpeedLoop> loops;
  WheelArray motor_gain{1, 1, 1, 1};
  WheelArray wanted{};  ///< rad/s
  std::optional<Route::Reference> carried;
  Stamp carried_since = 0;  ///< instant of that reference
  WheelArray zero_angle{};  ///< rad, of the hubs at t = 0

  int chassis = 0;              ///< joint
  std::array<int, 4> wheels{};  ///< joints
  std::array<int, 4> motors{};
  int gyro = 0;
  int accelerometer = 0;

  Stamp step_length = 0;
  Stamp time = 0;  ///< of the physics; at least `now`, less than one step ahead
  Stamp now = 0;
  Pose previous_pose;  ///< one step before `time`
  WheelArray previous_angles{};
  InertialAverage inertial;
  std::int64_t imu_count = 0;  ///< samples taken so far
  std::int64_t wheel_count = 0;
};

Rover::Physics::Physics(const RoverConfig& rover, const WorldConfig& world_config,
                        std::uint64_t seed)
    : config(rover),
      terrain(lay_out(world_config).terrain),
      world(rover.model, world_config, seed),
      drive{rover.wheel_radius, rover.half_track, rover.half_wheelbase},
      step_length(from_seconds(world.model().opt.timestep)) {
  SpeedLoopConfig loop;
  loop.max_torque = rover.max_torque;
  loops.assign(kWheelNames.size(), SpeedLoop(loop));
  find_parts();
  world.refresh();
  check_geometry();
  vary(seed);
}

void Rover::Physics::find_parts() {
  chassis = world.find(mjOBJ_JOINT, "chassis");
  gyro = world.sensor_address("gyro");
  accelerometer = world.sensor_address("accelerometer");
  for (std::size_t i = 0; i < kWheelNames.size(); ++i) {
    wheels[i] = world.find(mjOBJ_JOINT, kWheelNames[i]);
    motors[i] = world.find(mjOBJ_ACTUATOR, kWheelNames[i]);
  }
}

/// A configuration that disagrees with the model would silently give wrong speeds.
void Rover::Physics::check_geometry() const {
  for (std::size_t i = 0; i < kWheelNames.size(); ++i) {
    const Eigen::Vector3d expected(i < 2 ? config.half_wheelbase : -config.half_wheelbase,
                                   i % 2 == 0 ? config.half_track : -config.half_track,
                                   config.wheel_radius);
    const Eigen::Vector3d found =
        pose().inverse() * vector_of(&world.state().xanchor[3 * wheels[i]]);
    if ((found - expected).cwiseAbs().maxCoeff() > kGeometryTolerance) {
      fail(
          "{}: wheel {} is at ({:.4f}, {:.4f}, {:.4f}) m of the body, expected ({:.4f}, {:.4f}, "
          "{:.4f}) from half_wheelbase, half_track and wheel_radius",
          config.model.string(), kWheelNames[i], found.x(), found.y(), found.z(), expected.x(),
          expected.y(), expected.z());
    }
  }
}

/// Motors and bearings vary by up to 1 %, one draw per seed.
void Rover::Physics::vary(std::uint64_t seed) {
  const RandomStream gain(seed, "rover.motor_gain");
  const RandomStream friction(seed, "rover.wheel_friction");
  mjModel& model = world.model();
  for (std::size_t i = 0; i < kWheelNames.size(); ++i) {
    motor_gain[i] = gain.uniform(i, 1 - kSpread, 1 + kSpread);
    model.dof_frictionloss[model.jnt_dofadr[wheels[i]]] *=
        friction.uniform(i, 1 - kSpread, 1 + kSpread);
    model.actuator_ctrlrange[2 * motors[i]] = -config.max_torque;
    model.actuator_ctrlrange[2 * motors[i] + 1] = config.max_torque;
  }
}

/// Lets the rover settle on its springs; the run starts from this state.
void Rover::Physics::settle(const Eigen::Vector3d& start) {
  drop_on_ground(start);
  place(start);
  check_on_ground();
  check_clear(start);
  for (Stamp t = 0; t < kSettling; t += step_length) step();
  world.check();
  place(start);
  zero_angle = angles();
  previous_angles = angles();
  previous_pose = pose();
  time = 0;
  inertial = {};
}

/// Places it just above uneven ground, tilted as the ground below its wheels.
void Rover::Physics::drop_on_ground(const Eigen::Vector3d& start) {
  if (terrain.flat()) return;
  const Pose lying = terrain.lie(start.head<2>(), start.z(), config.half_track);
  double lift = 0;  // m, until no wheel is below the ground
  for (const double x : {-config.half_wheelbase, config.half_wheelbase}) {
    for (const double y : {-config.half_track, config.half_track}) {
      const Eigen::Vector3d foot = lying * Eigen::Vector3d(x, y, 0);
      lift = std::max(lift, terrain.height(foot.head<2>()) - foot.z());
    }
  }
  mjtNum* position = &world.state().qpos[world.model().jnt_qposadr[chassis]];
  position[2] = lying.translation.z() + lift;
  const Eigen::Quaterniond& q = lying.rotation;
  const std::array<double, 4> turned{q.w(), q.x(), q.y(), q.z()};
  std::copy(turned.begin(), turned.end(), position + 3);
}

/// Moves the rover horizontally; height, roll and pitch do not change.
void Rover::Physics::place(const Eigen::Vector3d& start) {
  const Pose here = pose();
  const Eigen::Quaterniond turn = from_roll_pitch_yaw({0, 0, start.z() - yaw_of(here.rotation)});
  const Eigen::Quaterniond rotation = (turn * here.rotation).normalized();
  mjtNum* position = &world.state().qpos[world.model().jnt_qposadr[chassis]];
  mjtNum* velocity = &world.state().qvel[world.model().jnt_dofadr[chassis]];
  const Eigen::Vector3d linear = turn * vector_of(velocity);
  const std::array<double, 7> placed{start.x(),    start.y(),    here.translation.z(), rotation.w(),
                                     rotation.x(), rotation.y(), rotation.z()};
  std::copy(placed.begin(), placed.end(), position);
  std::copy(linear.begin(), linear.end(), velocity);
  world.refresh();
}

bool Rover::Physics::is_rover(int geom) const {
  const mjModel& model = world.model();
  return model.body_rootid[model.geom_bodyid[geom]] == model.jnt_bodyid[chassis];
}

/// The first contact that is not with the ground; null if there is none.
const mjContact* Rover::Physics::contact_beside_ground() const {
  const int ground = world.find(mjOBJ_GEOM, "ground");
  for (int i = 0; i < world.state().ncon; ++i) {
    const mjContact& contact = world.state().contact[i];
    if (contact.geom1 != ground && contact.geom2 != ground) return &contact;
  }
  return nullptr;
}

void Rover::Physics::check_clear(const Eigen::Vector3d& start) const {
  const mjModel& model = world.model();
  // A model need not name its parts.
  const auto named = [&](int type, int index) {
    const char* name = mj_id2name(&model, type, index);
    return name != nullptr ? std::string(name) : fmt::format("number {}", index);
  };
  const mjContact* contact = contact_beside_ground();
  if (contact == nullptr) return;
  const int one = contact->geom1;
  const int other = contact->geom2;
  if (is_rover(one) && is_rover(other)) {
    fail("the rover's model collides with itself: bodies {} and {}",
         named(mjOBJ_BODY, model.geom_bodyid[one]), named(mjOBJ_BODY, model.geom_bodyid[other]));
  }
  fail("the rover cannot start at ({:.3f}, {:.3f}) m: it collides with {} of the world", start.x(),
       start.y(), named(mjOBJ_GEOM, is_rover(one) ? other : one));
}

void Rover::Physics::check_on_ground() const {
  if (terrain.flat()) return;
  const Eigen::Vector2d here = pose().translation.head<2>();
  if (terrain.box().contains(terrain.frame().from_world(here))) return;
  fail(
      "the rover left the uneven ground at ({:.2f}, {:.2f}) m: make the world's terrain.margin "
      "larger or the route shorter",
      here.x(), here.y());
}

void Rover::Physics::step() {
  previous_pose = pose();
  previous_angles = angles();
  if (carried) hold();
  const double dt = to_seconds(step_length);
  for (std::size_t i = 0; i < kWheelNames.size(); ++i) {
    const double speed = world.state().qvel[world.model().jnt_dofadr[wheels[i]]];
    world.state().ctrl[motors[i]] = motor_gain[i] * loops[i].torque(wanted[i], speed, dt);
  }
  world.step();
  time += step_length;
  inertial.add(felt());
}

/// The hands: a critically damped hold at the reference. The weight is theirs from the first
/// millimetre of height on, at which the wheels leave the ground.
void Rover::Physics::hold() {
  constexpr double kAloft = 0.001;  // m
  const double ahead = to_seconds(time - carried_since);
  const Eigen::Vector3d place = carried->pose + ahead * carried->velocity;
  Pose target = terrain.lie(place.head<2>(), place.z(), config.half_track);
  target.translation.z() += carried->lift + ahead * carried->lift_speed;

  const mjModel& model = world.model();
  const int body = model.jnt_bodyid[chassis];
  const double mass = model.body_subtreemass[body];
  const double wheels_mass = mass - model.body_mass[body];
  const double inertia =
      vector_of(&model.body_inertia[3 * body]).maxCoeff() +
      wheels_mass * (std::pow(config.half_track, 2) + std::pow(config.half_wheelbase, 2));
  const Pose here = pose();
  const mjtNum* velocity = &world.state().qvel[model.jnt_dofadr[chassis]];
  const Eigen::Vector3d moving(carried->velocity.x(), carried->velocity.y(), carried->lift_speed);
  const Eigen::Vector3d turning(0, 0, carried->velocity.z());
  // The angular velocity of MuJoCo's free joint is in the body frame.
  const Eigen::Vector3d spin = here.rotation * vector_of(velocity + 3);
  const Eigen::AngleAxisd off(target.rotation * here.rotation.conjugate());

  Eigen::Vector3d force = kGrip * kGrip * (target.translation - here.translation) +
                          2 * kGrip * (moving - vector_of(velocity));
  force -= std::min(1.0, carried->lift / kAloft) * vector_of(model.opt.gravity);
  const Eigen::Vector3d torque =
      kGrip * kGrip * off.angle() * off.axis() + 2 * kGrip * (turning - spin);
  mjtNum* applied = &world.state().xfrc_applied[6 * body];
  Eigen::Map<Vector6d> wrench(applied);
  wrench << mass * force, inertia * torque;
}

void Rover::Physics::release() {
  if (!carried) return;
  carried.reset();
  const int body = world.model().jnt_bodyid[chassis];
  std::fill_n(&world.state().xfrc_applied[6 * body], 6, 0.0);
}

void Rover::Physics::sample(Stamp until, std::vector<ImuSample>& imu,
                            std::vector<WheelSample>& wheel_samples) {
  for (;; ++imu_count) {
    const Stamp stamp = stamp_of_frame(imu_count + 1, config.imu_rate_hz);
    if (stamp > until) break;
    imu.push_back(inertial.take(stamp, felt()));
  }
  for (;; ++wheel_count) {
    const Stamp stamp = stamp_of_frame(wheel_count + 1, config.wheel_rate_hz);
    if (stamp > until) break;
    wheel_samples.push_back(wheels_at(stamp));
  }
}

Pose Rover::Physics::pose() const {
  const mjtNum* q = &world.state().qpos[world.model().jnt_qposadr[chassis]];
  return {Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized(), vector_of(q)};
}

WheelArray Rover::Physics::angles() const {
  WheelArray result{};
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = world.state().qpos[world.model().jnt_qposadr[wheels[i]]];
  }
  return result;
}

/// What an inertial unit feels in the latest step, in which velocity and acceleration are constant.
ImuSample Rover::Physics::felt() const {
  const mjtNum* data = world.state().sensordata;
  return {now, vector_of(data + gyro), vector_of(data + accelerometer)};
}

WheelSample Rover::Physics::wheels_at(Stamp stamp) const {
  WheelSample result;
  result.stamp = stamp;
  const WheelArray current = angles();
  for (std::size_t i = 0; i < current.size(); ++i) {
    const double angle = previous_angles[i] + fraction(stamp) * (current[i] - previous_angles[i]);
    result.angle[i] = angle - zero_angle[i];
    result.velocity[i] = world.state().qvel[world.model().jnt_dofadr[wheels[i]]];
  }
  return result;
}

Rover::Rover(const RoverConfig& config, const WorldConfig& world, const Eigen::Vector3d& start,
             std::uint64_t seed)
    : physics_(std::make_unique<Physics>(config, world, seed)) {
  physics_->settle(start);
}

Rover::Rover(Rover&&) noexcept = default;
Rover& Rover::operator=(Rover&&) noexcept = default;
Rover::~Rover() = default;

void Rover::command(const Eigen::Vector3d& twist) {
  physics_->wanted = physics_->drive.wheel_speeds(twist);
  physics_->release();
}

void Rover::carry(const Route::Reference& reference) {
  physics_->wanted = {};
  physics_->carried = reference;
  physics_->carried_since = physics_->now;
}

void Rover::advance_to(Stamp stamp, std::vector<ImuSample>& imu, std::vector<WheelSample>& wheels) {
  Physics& physics = *physics_;
  if (stamp < physics.now) {
    fail("cannot advance the rover to {} s: it is already at {} s", format_seconds(stamp),
         format_seconds(physics.now));
  }
  physics.sample(std::min(stamp, physics.time), imu, wheels);
  while (physics.time < stamp) {
    physics.world.move_occluders(physics.time + physics.step_length);
    physics.step();
    physics.sample(std::min(stamp, physics.time), imu, wheels);
  }
  physics.world.check();
  physics.check_on_ground();
  physics.now = stamp;
}

Stamp Rover::now() const {
  return physics_->now;
}

Pose Rover::T_world_body() const {
  return physics_->pose_at(physics_->now);
}

ImuSample Rover::inertial_reading() const {
  return physics_->felt();
}

bool Rover::touches_obstacle() const {
  return physics_->contact_beside_ground() != nullptr;
}

}  // namespace vinebench::sim
