// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/host/wire.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace vinebench::harness {
namespace {

struct MessageHead {
  std::uint32_t kind;
  std::uint32_t size;
};

/// The summary of a day at 100 Hz is 1 GB.
constexpr std::uint32_t kLargestMessage = 1U << 30;  // bytes
constexpr std::size_t kPart = 1U << 20;              // bytes that are read at once

bool would_block() {
  return errno == EAGAIN || errno == EWOULDBLOCK;
}

void send_bytes(int socket, const char* data, std::size_t size, const WaitForSocket& wait) {
  while (size > 0) {
    const ssize_t sent = send(socket, data, size, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent >= 0) {
      data += sent;
      size -= static_cast<std::size_t>(sent);
    } else if (would_block()) {
      wait(socket, POLLOUT);
    } else if (errno != EINTR) {
      fail("the other side of a socket is gone: {}", std::strerror(errno));
    }
  }
}

/// False if the other side is gone.
bool receive_bytes(int socket, char* data, std::size_t size, const WaitForSocket& wait) {
  while (size > 0) {
    const ssize_t received = recv(socket, data, size, MSG_DONTWAIT);
    if (received > 0) {
      data += received;
      size -= static_cast<std::size_t>(received);
    } else if (received < 0 && would_block()) {
      wait(socket, POLLIN);
    } else if (received == 0 || errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::size_t MessageReader::read_count(std::size_t size_of_one) {
  const auto count = read<std::uint64_t>();
  if (count > (content_.size() - at_) / size_of_one) fail("a message is shorter than it says");
  return static_cast<std::size_t>(count);
}

const char* MessageReader::take(std::size_t size) {
  if (size > content_.size() - at_) fail("a message is shorter than it says");
  const char* place = content_.data() + at_;
  at_ += size;
  return place;
}

void wait_for_ever(int socket, short events) {
  pollfd entry{socket, events, 0};
  poll(&entry, 1, -1);
}

void send_message(int socket, MessageKind kind, const std::string& content,
                  const WaitForSocket& wait) {
  if (content.size() > kLargestMessage) fail("a message of {} bytes is too large", content.size());
  const MessageHead head{static_cast<std::uint32_t>(kind),
                         static_cast<std::uint32_t>(content.size())};
  std::array<char, sizeof(head)> bytes{};
  std::memcpy(bytes.data(), &head, sizeof(head));
  send_bytes(socket, bytes.data(), bytes.size(), wait);
  send_bytes(socket, content.data(), content.size(), wait);
}

std::optional<Message> receive_message(int socket, const WaitForSocket& wait) {
  MessageHead head{};
  std::array<char, sizeof(head)> bytes{};
  if (!receive_bytes(socket, bytes.data(), bytes.size(), wait)) return std::nullopt;
  std::memcpy(&head, bytes.data(), sizeof(head));
  if (head.kind > static_cast<std::uint32_t>(MessageKind::kFailed) || head.size > kLargestMessage) {
    fail("what came is no message: kind {}, {} bytes", head.kind, head.size);
  }
  Message message{static_cast<MessageKind>(head.kind), {}};
  // By parts: a size alone takes no memory.
  while (message.content.size() < head.size) {
    const std::size_t before = message.content.size();
    const std::size_t part = std::min(kPart, head.size - before);
    message.content.resize(before + part);
    if (!receive_bytes(socket, message.content.data() + before, part, wait)) return std::nullopt;
  }
  return message;
}

}  // namespace vinebench::harness
