// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vinebench::harness {

/// What viewers of a run are told, as events of a text/event-stream (HTML standard, server-sent
/// events): `begin`, `state` and `end` with the latest value each, `ticks` with a list of all that
/// the viewer does not have, whose number is the event's id, and `picture` with the latest one. A
/// viewer that comes late or is slow misses pictures, and never holds up the run. For any number of
/// threads.
class ViewLog {
 public:
  /// What a viewer has.
  struct Reader {
    std::size_t ticks = 0;
    std::uint64_t begin = 0, state = 0, picture = 0, end = 0;  ///< versions; none if 0
  };

  void begin(const nlohmann::ordered_json& run) { set(begin_, run); }
  void set_state(const nlohmann::ordered_json& state) { set(state_, state); }
  void add_tick(const nlohmann::ordered_json& tick);
  void set_picture(const nlohmann::ordered_json& picture) { set(picture_, picture); }
  void end(const nlohmann::ordered_json& outcome) { set(end_, outcome); }

  /// Waits for what the reader lacks, until `until` at most, and counts it as read. Empty if
  /// nothing came. Of a long list of ticks, a part.
  std::string next(Reader& reader, std::chrono::steady_clock::time_point until);

  /// Viewers that are connected.
  void join();
  void leave();
  int readers() const;
  /// Whether a viewer has read the last picture, or there is none.
  bool picture_was_read() const;

  /// Wakes all that wait, for good.
  void close();
  bool closed() const;

 private:
  struct Value {
    std::string text;
    std::uint64_t version = 0;  ///< none if 0
  };
  void set(Value& value, const nlohmann::ordered_json& json);
  std::string take(Reader& reader);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Value begin_, state_, picture_, end_;
  std::vector<std::string> ticks_;
  std::uint64_t picture_read_ = 0;
  int readers_ = 0;
  bool closed_ = false;
};

}  // namespace vinebench::harness
