// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace vinebench::harness {

/// One thread that runs jobs in order. At most `capacity` jobs are queued; adding another one
/// blocks, so that memory is bounded.
class BackgroundWorker {
 public:
  explicit BackgroundWorker(std::size_t capacity);
  BackgroundWorker(const BackgroundWorker&) = delete;
  BackgroundWorker& operator=(const BackgroundWorker&) = delete;
  ~BackgroundWorker();  ///< completes queued jobs and ignores their exceptions

  /// Rethrows an exception of an earlier job; no job is run after that one.
  void submit(std::function<void()> job);

  /// Waits for all jobs; rethrows likewise.
  void wait();

 private:
  void work();
  void rethrow();

  std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  std::exception_ptr error_;
  bool busy_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace vinebench::harness
