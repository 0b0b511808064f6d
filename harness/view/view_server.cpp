// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/view_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <charconv>
#include <random>
#include <thread>

#include "core/files/json_depth.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kMostBody = 4096;   // bytes, of a control's request
constexpr std::chrono::seconds kBeat{2};  // between signs of life, so that a dead
                                          // connection is noticed
constexpr int kThreads = ViewServer::kMostReaders + 4;

/// 128 bits of the system's random numbers.
std::string random_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", random());
  return token;
}

/// How many ticks a browser has that connects again.
std::size_t ticks_of(const httplib::Request& request) {
  const std::string text = request.get_header_value("Last-Event-ID");
  std::size_t ticks = 0;
  std::from_chars(text.data(), text.data() + text.size(), ticks);
  return ticks;
}

void refuse(httplib::Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content("vinebench: " + text + "\n", "text/plain; charset=utf-8");
}

}  // namespace

class ViewServer::Http {
 public:
  Http(const ViewAddress& address, ViewContent content, ViewLog& log)
      : content_(std::move(content)), log_(log), host_(address.host) {
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // Without SO_REUSEPORT: two runs must not share a port.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    server_.set_payload_max_length(kMostBody);
    server_.set_default_headers({{"Cache-Control", "no-store"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"X-Frame-Options", "DENY"}});
    add_routes();
    port_ = address.port;
    if (address.port == 0) port_ = server_.bind_to_any_port(host_);
    if (port_ < 0 || (address.port != 0 && !server_.bind_to_port(host_, address.port))) {
      fail("--view: cannot serve at {}:{}: the port is in use, or this machine has no such address",
           host_, address.port);
    }
    thread_ = std::thread([this] {
      server_.listen_after_bind();
      ended_ = true;
    });
  }

  ~Http() {
    log_.close();
    // A stop() before it listens would be forgotten.
    while (!server_.is_running() && !ended_) std::this_thread::yield();
    server_.stop();
    thread_.join();
  }

  std::string address() const {
    const bool six = host_.find(':') != std::string::npos;
    return fmt::format("http://{}{}{}:{}/{}/", six ? "[" : "", host_, six ? "]" : "", port_,
                       token_);
  }

 private:
  void add_routes() {
    const std::string root = "/" + token_ + "/";
    server_.Get(root, [this](const auto&, httplib::Response& response) {
      response.set_content(content_.page, "text/html; charset=utf-8");
    });
    server_.Get(root + "events",
                [this](const httplib::Request& request, httplib::Response& response) {
                  stream(request, response);
                });
    server_.Get(root + "report", [this](const auto&, httplib::Response& response) {
      const std::string report = content_.report();
      if (report.empty()) return refuse(response, 404, "the run has no report yet");
      response.set_content(report, "text/html; charset=utf-8");
    });
    server_.Post(root + "control",
                 [this](const httplib::Request& request, httplib::Response& response) {
                   control(request, response);
                 });
    server_.set_error_handler([](const auto&, httplib::Response& response) {
      if (response.body.empty()) {
        refuse(response, response.status,
               "nothing here; the run's address, with its token, is what it printed");
      }
    });
  }

  void control(const httplib::Request& request, httplib::Response& response) {
    try {
      check_json_depth(request.body, "control");
      const auto wish = nlohmann::json::parse(request.body, nullptr, false);
      if (!wish.is_object()) fail("control: expected a JSON object");
      content_.control(wish);
      response.status = 204;
    } catch (const Error& error) {
      refuse(response, 400, error.what());
    } catch (const nlohmann::json::exception&) {
      refuse(response, 400, "control: a value of the wrong type");
    }
  }

  void stream(const httplib::Request& request, httplib::Response& response) {
    if (log_.readers() >= kMostReaders) return refuse(response, 503, "too many viewers");
    auto reader = std::make_shared<ViewLog::Reader>();
    reader->ticks = ticks_of(request);
    log_.join();
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, reader](std::size_t, httplib::DataSink& sink) {
          std::string text = log_.next(*reader, std::chrono::steady_clock::now() + kBeat);
          if (text.empty() && log_.closed()) {
            sink.done();
            return true;
          }
          if (text.empty()) text = ": still here\n\n";
          return sink.write(text.data(), text.size());
        },
        [this](bool) { log_.leave(); });
  }

  ViewContent content_;
  ViewLog& log_;
  std::string host_;
  std::string token_ = random_token();
  int port_ = 0;
  httplib::Server server_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

ViewServer::ViewServer(const ViewAddress& address, ViewContent content, ViewLog& log)
    : http_(std::make_unique<Http>(address, std::move(content), log)) {}
ViewServer::~ViewServer() = default;

std::string ViewServer::address() const {
  return http_->address();
}

}  // namespace vinebench::harness
