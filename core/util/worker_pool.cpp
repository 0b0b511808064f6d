// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/worker_pool.h"

#include <algorithm>

namespace vinebench {

WorkerPool::WorkerPool(int threads) {
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { run_worker(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::for_each(std::size_t n, const std::function<void(std::size_t)>& work) {
  std::unique_lock lock(mutex_);
  work_ = &work;
  next_ = 0;
  count_ = n;
  finished_ = 0;
  errors_.assign(n, nullptr);
  // The caller takes items too; to wake more workers than there are items costs time alone.
  for (std::size_t i = 1; i < std::min(n, workers_.size() + 1); ++i) wake_.notify_one();
  take_items(lock);
  done_.wait(lock, [this] { return finished_ == count_; });
  work_ = nullptr;
  for (const std::exception_ptr& error : errors_) {
    if (error) std::rethrow_exception(error);
  }
}

void WorkerPool::run_worker() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || (work_ != nullptr && next_ < count_); });
    if (stopping_) return;
    take_items(lock);
  }
}

void WorkerPool::take_items(std::unique_lock<std::mutex>& lock) {
  while (work_ != nullptr && next_ < count_) {
    const std::size_t item = next_++;
    const auto* work = work_;
    lock.unlock();
    std::exception_ptr error;
    try {
      (*work)(item);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    errors_[item] = error;
    if (++finished_ == count_) done_.notify_all();
  }
}

}  // namespace vinebench
