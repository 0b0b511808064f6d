// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <httplib.h>

#include <stdexcept>
#include <string>

namespace vinebench::test {

/// A browser of a live view, which knows its address.
class ViewClient {
 public:
  explicit ViewClient(const std::string& address)
      : port_(std::stoi(address.substr(address.rfind(':') + 1))),
        root_(address.substr(address.find('/', address.rfind(':')))),
        client_("127.0.0.1", port_) {
    client_.set_read_timeout(20);
  }

  int port() const { return port_; }
  httplib::Response get(const std::string& path) { return get_absolute(root_ + path); }
  httplib::Response get_absolute(const std::string& path) { return of(client_.Get(path)); }
  httplib::Response post(const std::string& path, const std::string& body) {
    // A path such as "../control" is one of the server's root.
    const std::string at = path.starts_with("..") ? path.substr(2) : root_ + path;
    return of(client_.Post(at, body, "application/json"));
  }
  /// The events until this text is among them.
  std::string events_until(const std::string& text) {
    std::string all;
    client_.Get(root_ + "events", [&](const char* data, std::size_t size) {
      all.append(data, size);
      return all.find(text) == std::string::npos;
    });
    return all;
  }

 private:
  static httplib::Response of(const httplib::Result& result) {
    if (!result) throw std::runtime_error("no answer: " + httplib::to_string(result.error()));
    return *result;
  }

  int port_;
  std::string root_;
  httplib::Client client_;
};

}  // namespace vinebench::test
