// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/view_log.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/datasets/files/json_file.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kMostTicks = 500;  // in one event

}  // namespace

void ViewLog::set(Value& value, const nlohmann::ordered_json& json) {
  std::string text = json_text(json);
  const std::lock_guard lock(mutex_);
  value.text = std::move(text);
  ++value.version;
  changed_.notify_all();
}

void ViewLog::add_tick(const nlohmann::ordered_json& tick) {
  std::string text = json_text(tick);
  const std::lock_guard lock(mutex_);
  ticks_.push_back(std::move(text));
  changed_.notify_all();
}

/// In the order in which a page can use them: the run, its ticks, their pictures.
std::string ViewLog::take(Reader& reader) {
  std::string text;
  const auto value = [&text](const char* event, const Value& latest, std::uint64_t& has) {
    if (latest.version == has) return;
    has = latest.version;
    text += fmt::format("event: {}\ndata: {}\n\n", event, latest.text);
  };
  value("begin", begin_, reader.begin);
  value("state", state_, reader.state);
  if (reader.ticks < ticks_.size()) {
    const std::size_t end = std::min(ticks_.size(), reader.ticks + kMostTicks);
    text += fmt::format("event: ticks\nid: {}\ndata: [", end);
    for (std::size_t i = reader.ticks; i < end; ++i) {
      text += (i == reader.ticks ? "" : ",") + ticks_[i];
    }
    text += "]\n\n";
    reader.ticks = end;
  }
  if (reader.ticks < ticks_.size()) return text;
  value("picture", picture_, reader.picture);
  picture_read_ = std::max(picture_read_, reader.picture);
  value("end", end_, reader.end);
  return text;
}

std::string ViewLog::next(Reader& reader, std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex_);
  std::string text;
  while ((text = take(reader)).empty() && !closed_) {
    if (changed_.wait_until(lock, until) == std::cv_status::timeout) break;
  }
  return text;
}

void ViewLog::join() {
  const std::lock_guard lock(mutex_);
  ++readers_;
}

void ViewLog::leave() {
  const std::lock_guard lock(mutex_);
  --readers_;
}

int ViewLog::readers() const {
  const std::lock_guard lock(mutex_);
  return readers_;
}

bool ViewLog::picture_was_read() const {
  const std::lock_guard lock(mutex_);
  return picture_read_ == picture_.version;
}

void ViewLog::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

bool ViewLog::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace vinebench::harness
