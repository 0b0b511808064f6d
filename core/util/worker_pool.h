// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace vinebench {

/// A few threads for independent work items. The assignment of items to threads does not affect
/// results: each item writes only to its own slot.
class WorkerPool {
 public:
  /// `threads` includes the calling thread; 1 runs everything in the caller.
  explicit WorkerPool(int threads);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls work(0) … work(n - 1), each once, and returns when all have finished. Rethrows the
  /// exception of the lowest item that threw. Not re-entrant.
  void for_each(std::size_t n, const std::function<void(std::size_t)>& work);

 private:
  void run_worker();
  void take_items(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  std::size_t finished_ = 0;
  std::vector<std::exception_ptr> errors_;
  bool stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace vinebench
