// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "harness/view/view_log.h"

namespace vinebench::harness {

/// Where a view is served.
struct ViewAddress {
  std::string host = "127.0.0.1";
  int port = 0;  ///< any that is free if 0
};

/// What a server gives and takes. Called by its threads.
struct ViewContent {
  std::string page;                                         ///< HTML
  std::function<void(const nlohmann::json& wish)> control;  ///< may throw Error
  std::function<std::string()> report;                      ///< HTML; empty while there is none
};

/// Serves the page of a run and a ViewLog to browsers (HTTP/1.1), below a path with a random token
/// that nobody else knows: `/TOKEN/`, `/TOKEN/events`, `/TOKEN/report`, and POST
/// `/TOKEN/control`. Its threads touch nothing of the run.
class ViewServer {
 public:
  static constexpr int kMostReaders = 12;

  /// Throws Error if there is no such address, or the port is in use.
  ViewServer(const ViewAddress& address, ViewContent content, ViewLog& log);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// For a browser, with the token.
  std::string address() const;

 private:
  class Http;
  std::unique_ptr<Http> http_;
};

}  // namespace vinebench::harness
