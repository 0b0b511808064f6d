// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/live_view.h"

#include <fmt/format.h>

#include <thread>

#include "core/files/files.h"
#include "core/util/base64.h"
#include "core/util/error.h"
#include "harness/page/page_html.h"
#include "harness/report/timeline.h"
#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

// A picture costs some ms; a viewer that has not read the last one gets none.
constexpr std::chrono::milliseconds kPicture{150};
constexpr int kAloneHeight = 480;            // px, of a camera that is shown alone
constexpr std::chrono::seconds kLinger{30};  // for the report to be fetched, at most

std::string waiting_page() {
  const Json report{{"title", "vinebench"},     {"version", kVersion},   {"live", true},
                    {"columns", Json::array()}, {"runs", Json::array()}, {"comparison", nullptr},
                    {"history", nullptr}};
  return page_html("vinebench: live view", report, "");
}

/// Of all cameras together, then of each alone.
std::vector<FilmLayout> layouts_of(const Rig& rig) {
  std::vector<FilmLayout> layouts{film_layout(rig)};
  for (const RigCamera& camera : rig.cameras) {
    layouts.emplace_back(
        std::vector<FilmLayout::Camera>{{camera.name, camera.model.width, camera.model.height}},
        std::min(kAloneHeight, camera.model.height));
  }
  return layouts;
}

/// Those of one camera, which becomes the first.
template <class Seen>
std::vector<Seen> of_camera(const std::vector<Seen>& all, int camera) {
  std::vector<Seen> some;
  for (Seen seen : all) {
    if (seen.camera != camera) continue;
    seen.camera = 0;
    some.push_back(seen);
  }
  return some;
}

}  // namespace

LiveView::LiveView(const ViewAddress& address, std::function<bool()> stopped)
    : stopped_(std::move(stopped)),
      server_(address,
              {waiting_page(), [this](const auto& wish) { obey(wish); },
               [this] { return report_text(); }},
              log_) {
  log_.set_state(state_json());
}

void LiveView::begin(const WatchedRun& run) {
  layouts_ = layouts_of(run.rig);
  features_ = run.features;
  ticks_.emplace(run.rig, run.box_share);
  cameras_ = static_cast<int>(run.rig.cameras.size());
  log_.begin({{"title", run.title},
              {"total", run.total},
              {"rate_hz", run.rig.rate_hz},
              {"site", site_json(run.site, run.rig)},
              {"film", layouts_.front().json()}});
}

void LiveView::on_tick(const Sample& sample, const Estimate& estimate) {
  log_.add_tick(ticks_->of({.index = sample.frame.index,
                            .stamp = sample.frame.stamp,
                            .truth = sample.truth,
                            .estimate = estimate,
                            .events = sample.events}));
  const bool due = Clock::now() - last_picture_ >= kPicture && log_.picture_was_read();
  if (log_.readers() > 0 && (due || picture_wanted_.exchange(false) || control_.state().paused)) {
    log_.set_picture(picture_json(sample, estimate));
    last_picture_ = Clock::now();
  }
  control_.wait(sample.frame.stamp, stopped_);
}

Json LiveView::picture_json(const Sample& sample, const Estimate& estimate) const {
  const int camera = camera_;
  const FilmLayout& layout = layouts_.at(static_cast<std::size_t>(camera + 1));
  const std::vector<SupportingFeature> features =
      features_ ? features_() : std::vector<SupportingFeature>();
  std::vector<std::uint8_t> jpeg;
  Json picture{{"frame", sample.frame.index}};
  if (camera < 0) {
    jpeg = layout.picture(sample.frame.images);
    picture.update(seen_json(layout, features, estimate.tags));
  } else {
    jpeg = layout.picture({sample.frame.images.at(static_cast<std::size_t>(camera))});
    picture.update(
        seen_json(layout, of_camera(features, camera), of_camera(estimate.tags, camera)));
  }
  picture["layout"] = layout.json();
  picture["jpeg"] = base64({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
  return picture;
}

Json LiveView::state_json() const {
  const RunControl::State state = control_.state();
  return {{"paused", state.paused}, {"speed", state.speed}, {"camera", camera_.load()}};
}

/// A browser's wish: `paused`, `step`, `speed`, `camera`.
void LiveView::obey(const nlohmann::json& wish) {
  if (wish.contains("speed")) control_.set_speed(wish["speed"].get<double>());
  if (wish.contains("paused")) control_.pause(wish["paused"].get<bool>());
  if (wish.contains("step")) control_.step();
  if (wish.contains("camera")) choose_camera(wish["camera"]);
  picture_wanted_ = true;
  log_.set_state(state_json());
}

void LiveView::choose_camera(const nlohmann::json& camera) {
  const int index = camera.get<int>();
  if (index < -1 || index >= cameras_) {
    fail("camera: expected -1 for all, or 0 to {}, found {}", cameras_ - 1, index);
  }
  camera_ = index;
}

std::string LiveView::report_text() {
  const std::lock_guard lock(report_mutex_);
  if (report_.empty()) return "";
  ++reports_;
  return read_file(report_);
}

void LiveView::end(const std::string& verdict, const std::filesystem::path& report) {
  const int waiting = log_.readers();
  {
    const std::lock_guard lock(report_mutex_);
    report_ = report;
  }
  log_.end({{"verdict", verdict},
            {"report", report.empty() ? "" : std::filesystem::absolute(report).string()}});
  const Clock::time_point until = Clock::now() + kLinger;
  while (!report.empty() && reports_ < waiting && Clock::now() < until && !stopped_()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace vinebench::harness
