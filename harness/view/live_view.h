// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "harness/run/watcher.h"
#include "harness/view/run_control.h"
#include "harness/view/tick_json.h"
#include "harness/view/view_server.h"

namespace vinebench::harness {

/// Shows a run in browsers while it goes on, and lets them pause it. What they do and how fast they
/// are changes no byte of it.
class LiveView : public Watcher {
 public:
  /// Serves at once. A pause ends when `stopped` returns true. Throws Error as ViewServer.
  LiveView(const ViewAddress& address, std::function<bool()> stopped);

  /// For a browser, with the token.
  std::string address() const { return server_.address(); }
  /// Browsers that are connected.
  int viewers() const { return log_.readers(); }

  void begin(const WatchedRun& run) override;
  void on_tick(const Sample& sample, const Estimate& estimate) override;
  double waited_seconds() const override { return control_.waited_seconds(); }

  /// Tells the viewers that the run has ended, with its verdict and the file of its report, and
  /// gives those that are connected some seconds to fetch it. Of a run without a report, empty.
  void end(const std::string& verdict, const std::filesystem::path& report);

 private:
  using Clock = std::chrono::steady_clock;
  void obey(const nlohmann::json& wish);
  void choose_camera(const nlohmann::json& camera);
  std::string report_text();
  nlohmann::ordered_json state_json() const;
  nlohmann::ordered_json picture_json(const Sample& sample, const Estimate& estimate) const;

  std::function<bool()> stopped_;
  RunControl control_;
  std::vector<FilmLayout> layouts_;  ///< of all cameras together, then of each alone
  Film::Features features_;
  std::optional<TickJson> ticks_;
  std::atomic<int> cameras_{0};
  std::atomic<int> camera_{-1};  ///< that is shown alone; all if -1
  std::atomic<bool> picture_wanted_{true};
  Clock::time_point last_picture_{};
  std::mutex report_mutex_;
  std::filesystem::path report_;
  std::atomic<int> reports_{0};  ///< fetched
  ViewLog log_;
  ViewServer server_;  // last: its threads use all others
};

}  // namespace vinebench::harness
