// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace vinebench::harness {
namespace {

constexpr int kBarWidth = 30;
constexpr std::int64_t kPercentStep = 5;

std::string clock_text(double seconds) {
  const int whole = static_cast<int>(seconds + 0.5);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

const char* status_text(const Estimate& estimate) {
  switch (estimate.status) {
    case TrackingStatus::kInitializing:
      return "initializing";
    case TrackingStatus::kTracking:
      return "tracking";
    case TrackingStatus::kDeadReckoning:
      return "DEAD RECKONING";
    case TrackingStatus::kLost:
      return "LOST";
  }
  return "";
}

}  // namespace

Progress::Progress(std::ostream& out, bool terminal, std::string title, std::int64_t total,
                   std::function<std::string()> note)
    : out_(out),
      terminal_(terminal),
      title_(std::move(title)),
      total_(total),
      note_(std::move(note)) {}

double Progress::seconds_per_frame() const {
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  return elapsed.count() / static_cast<double>(std::max<std::int64_t>(1, done_));
}

std::string Progress::line(const Estimate& estimate) const {
  const double left =
      seconds_per_frame() * static_cast<double>(std::max<std::int64_t>(0, total_ - done_));
  return fmt::format("frame {}/{}, {:.1f} frames/s, {} left, {}", done_, total_,
                     1 / std::max(1e-9, seconds_per_frame()), clock_text(left),
                     note_ ? note_() : status_text(estimate));
}

void Progress::on_tick(const Sample&, const Estimate& estimate) {
  ++done_;
  const std::int64_t percent = total_ > 0 ? 100 * done_ / total_ : 100;
  if (!terminal_) {
    if (percent < next_percent_ && done_ != total_) return;
    next_percent_ = percent - percent % kPercentStep + kPercentStep;
    out_ << fmt::format("{} {:3}% {}\n", title_, percent, line(estimate)) << std::flush;
    return;
  }
  const Clock::time_point now = Clock::now();
  if (now - drawn_ < std::chrono::milliseconds(100) && done_ != total_) return;
  drawn_ = now;
  const auto filled =
      static_cast<std::size_t>(kBarWidth * std::min<std::int64_t>(100, percent) / 100);
  out_ << fmt::format("\r\033[K{} [{:-<{}}] {}", title_, std::string(filled, '#'), kBarWidth,
                      line(estimate))
       << std::flush;
}

void Progress::on_finish(const SlamSummary&) {
  if (terminal_ && done_ > 0) out_ << "\n" << std::flush;
}

}  // namespace vinebench::harness
