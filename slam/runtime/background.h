// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <utility>

namespace vinebench::slam {

/// From here on others come first on the processors that this thread shares with them.
void lower_priority_of_thread();

/// One piece of work at a time, on a thread of its own that comes after others where processors are
/// scarce. Is waited for where it is let go.
template <class Result>
class Background {
 public:
  /// None may be under way, or there and not taken.
  void start(std::function<Result()> work) {
    result_ = std::async(std::launch::async, [work = std::move(work)] {
      lower_priority_of_thread();
      return work();
    });
  }

  bool busy() const { return result_.valid(); }
  bool done() const {
    return busy() && result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }

  /// Waits for it. Throws what the work threw.
  Result take() { return result_.get(); }

 private:
  std::future<Result> result_;
};

}  // namespace vinebench::slam
