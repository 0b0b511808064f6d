// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/world_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/angle.h"
#include "core/geometry/rig.h"
#include "core/util/error.h"
#include "core/util/random.h"
#include "harness/datasets/files/image_file.h"
#include "sim/render/factory/make_render_engine.h"
#include "sim/sensors/camera/camera_sensor.h"
#include "sim/sensors/camera/exposure.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

constexpr double kFromWall = 0.4;               // m, from the next row's middle at least
constexpr int kExposures = 12;                  // after which an automatic exposure has settled
constexpr double kPeriod = 1.0 / 15;            // s
constexpr double kSideFocal = 26.0 / 36;        // of the width
constexpr double kAheadFocal = 263.2786 / 752;  // likewise

PinholeCamera camera_of(const ViewsRequest& request) {
  PinholeCamera camera;
  camera.width = request.width;
  camera.height = static_cast<int>(std::lround(480.0 * request.width / 752));
  const double focal = request.kind == ViewKind::kSide ? kSideFocal : kAheadFocal;
  camera.fx = camera.fy = focal * request.width;
  camera.cx = (camera.width - 1) / 2.0;
  camera.cy = (camera.height - 1) / 2.0;
  return camera;
}

Eigen::Vector2d along(const sim::RowConfig& row) {
  return (row.end - row.start).normalized();
}

/// m from a row to the next one to its left (side 1) or right (-1); infinite if there is none.
double aisle_beside(const std::vector<sim::RowConfig>& rows, const sim::RowConfig& row, int side) {
  const Eigen::Vector2d direction = along(row);
  const Eigen::Vector2d left(-direction.y(), direction.x());
  double width = std::numeric_limits<double>::infinity();
  for (const sim::RowConfig& other : rows) {
    const double offset = side * left.dot(0.5 * (other.start + other.end) - row.start);
    if (offset > 0.1) width = std::min(width, offset);
  }
  return width;
}

/// Draws one view after another.
class ViewDraw {
 public:
  explicit ViewDraw(const ViewsRequest& request)
      : request_(request),
        layout_(sim::lay_out(request.simulation.world)),
        draw_(RandomStream(request.seed, "realism.views")),
        camera_(camera_of(request)) {}

  View next() {
    const sim::RowConfig& row =
        layout_.rows[static_cast<std::size_t>(draw_.below(static_cast<int>(layout_.rows.size())))];
    const int side = draw_.uniform() < 0.5 ? 1 : -1;
    return request_.kind == ViewKind::kSide ? from_the_side(row, side) : ahead(row, side);
  }

 private:
  View from_the_side(const sim::RowConfig& row, int side) {
    const double wall = aisle_beside(layout_.rows, row, side) - kFromWall;
    const double distance = std::max(0.3, std::min(draw_.uniform(0.9, 1.8), wall));
    const double share = draw_.uniform(0.05, 0.95);
    const double height = draw_.uniform(0.7, 1.3);
    const double off = draw_.uniform(-12, 12) * kRadiansPerDegree;
    const double down = draw_.uniform(-6, 10) * kRadiansPerDegree;
    const double heading = std::atan2(along(row).y(), along(row).x());
    const double facing = heading - side * std::numbers::pi / 2;
    return looking(place(row, share, side * distance), height, facing + off, down);
  }

  View ahead(const sim::RowConfig& row, int side) {
    const double aisle = aisle_beside(layout_.rows, row, side);
    const double offset = std::isfinite(aisle) ? 0.5 * aisle : draw_.uniform(0.6, 1.2);
    const double share = draw_.uniform(-0.05, 0.6);
    const double height = draw_.uniform(0.4, 1.2);
    const double off = draw_.uniform(-8, 8) * kRadiansPerDegree;
    const double down = draw_.uniform(-3, 8) * kRadiansPerDegree;
    const double heading = std::atan2(along(row).y(), along(row).x());
    return looking(place(row, share, side * offset), height, heading + off, down);
  }

  /// A point at a share of the row's length, so far to its left; m.
  static Eigen::Vector2d place(const sim::RowConfig& row, double share, double left) {
    const Eigen::Vector2d direction = along(row);
    return row.start + share * (row.end - row.start) +
           left * Eigen::Vector2d(-direction.y(), direction.x());
  }

  View looking(const Eigen::Vector2d& foot, double height, double yaw, double down) const {
    const double ground = layout_.terrain.height(foot);
    return {camera_, Rig::mount({foot.x(), foot.y(), ground + height}, {0, down, yaw})};
  }

  const ViewsRequest& request_;
  sim::WorldLayout layout_;
  RandomSequence draw_;
  PinholeCamera camera_;
};

/// The exposure of a scene that has been looked at for a while.
class Photographer {
 public:
  Photographer(const ViewsRequest& request, const sim::Scene& scene)
      : request_(request),
        engine_(sim::make_render_engine(scene, request.simulation.renderer)),
        light_(scene.light) {}

  cv::Mat take(const View& view, std::int64_t index) {
    Rig rig;
    rig.rate_hz = 1 / kPeriod;
    rig.cameras.push_back({"camera", view.camera, Pose()});
    const sim::ExposureConfig& exposure = request_.simulation.sensors.camera.exposure;
    sim::ExposureControl control(exposure, rig);
    sim::CameraSensor sensor(request_.simulation.sensors.camera, rig.cameras.front(), 0,
                             request_.seed, light_);
    const auto look = [&](std::size_t) {
      sim::Shot shot;
      shot.frame = index;
      shot.instant = stamp_of_frame(index, rig.rate_hz);
      shot.exposure = control.of(0);
      return sensor
          .capture(
              shot, [&](Stamp) { return view.T_world_cam; },
              [&](const PinholeCamera& camera, const Pose& T_world_cam,
                  const sim::RenderRequest& request) {
                return engine_->render(camera, T_world_cam, request);
              })
          .rgb;
    };
    control.meter(look);
    for (int i = 0; exposure.automatic && i < kExposures; ++i) control.observe({look(0)});
    return look(0);
  }

 private:
  const ViewsRequest& request_;
  std::unique_ptr<sim::RenderEngine> engine_;
  sim::Light light_;
};

}  // namespace

std::vector<View> draw_views(const ViewsRequest& request) {
  ViewDraw draw(request);
  std::vector<View> views;
  for (int i = 0; i < request.count; ++i) views.push_back(draw.next());
  return views;
}

std::vector<cv::Mat> take_pictures(const ViewsRequest& request, const CacheFolder& cache) {
  const sim::Scene scene = sim::build_scene(request.simulation.world, request.seed, cache);
  Photographer photographer(request, scene);
  std::vector<cv::Mat> pictures;
  for (const View& view : draw_views(request)) {
    pictures.push_back(photographer.take(view, static_cast<std::int64_t>(pictures.size())));
  }
  return pictures;
}

PictureSet measure_views(const ViewsRequest& request, const CacheFolder& cache, WorkerPool& pool,
                         const std::filesystem::path& keep) {
  const std::vector<cv::Mat> pictures = take_pictures(request, cache);
  PictureSet set{request.simulation.world.name, request.width, {}};
  set.pictures.resize(pictures.size());
  pool.for_each(pictures.size(), [&](std::size_t i) {
    MeasuredPicture& picture = set.pictures[i];
    picture.name = picture.group = fmt::format("{}-{:03}", request.seed, i);
    picture.statistics = picture_statistics(pictures[i]);
    if (keep.empty()) return;
    picture.file = keep / (picture.name + ".png");
    write_image(picture.file, pictures[i]);
  });
  return set;
}

}  // namespace vinebench::harness
