// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/util/error.h"

namespace vinebench::harness {

// Messages between the bench and the process of a plug-in, which are of the same build: values are
// sent as they are in memory.

enum class MessageKind : std::uint32_t {
  kCreate,    ///< to the plug-in: library and setup
  kCreated,   ///< from it: its name
  kProcess,   ///< to it: a frame, whose images are in shared memory
  kEstimate,  ///< from it
  kFinish,    ///< to it
  kSummary,   ///< from it
  kRefused,   ///< from it: bad input, as text
  kFailed,    ///< from it: it has failed, as text
};

struct Message {
  MessageKind kind{};
  std::string content;
};

class MessageWriter {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    content_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <class T>
  void add_list(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(static_cast<std::uint64_t>(count));
    if (count > 0) content_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  void add_text(const std::string& text) { add_list(text.data(), text.size()); }
  const std::string& content() const { return content_; }

 private:
  std::string content_;
};

/// Reads what a MessageWriter wrote. Throws Error at the end of the message.
class MessageReader {
 public:
  explicit MessageReader(const std::string& content) : content_(content) {}

  template <class T>
  T read() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> read_list() {
    const std::size_t count = read_count(sizeof(T));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), take(count * sizeof(T)), count * sizeof(T));
    return values;
  }
  std::string read_text() {
    const std::size_t count = read_count(1);
    return {take(count), count};
  }

 private:
  std::size_t read_count(std::size_t size_of_one);
  const char* take(std::size_t size);

  const std::string& content_;
  std::size_t at_ = 0;
};

/// Waits until a socket is ready for `events` (POLLIN or POLLOUT). Throws to give up.
using WaitForSocket = std::function<void(int socket, short events)>;

/// Without a limit of time.
void wait_for_ever(int socket, short events);

/// Sends a whole message. Throws Error if the other side is gone.
void send_message(int socket, MessageKind kind, const std::string& content,
                  const WaitForSocket& wait);

/// Nothing if the other side is gone. Throws Error for what is no message.
std::optional<Message> receive_message(int socket, const WaitForSocket& wait);

}  // namespace vinebench::harness
