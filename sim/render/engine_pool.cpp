// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/engine_pool.h"

#include <algorithm>
#include <utility>

namespace vinebench::sim {

EnginePool::EnginePool(int users, int processors,
                       const std::function<std::unique_ptr<RenderEngine>()>& make) {
  for (int i = 0; i < std::clamp(std::min(users, processors), 1, kMost); ++i) {
    engines_.push_back(make());
    free_.push_back(engines_.back().get());
  }
}

void EnginePool::with_engine(const std::function<void(RenderEngine&)>& use) {
  struct Loan {
    explicit Loan(EnginePool& lender) : pool(lender), engine(lender.take()) {}
    ~Loan() { pool.give_back(engine); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    EnginePool& pool;
    RenderEngine& engine;
  };
  const Loan loan(*this);
  use(loan.engine);
}

RenderEngine& EnginePool::take() {
  std::unique_lock lock(mutex_);
  freed_.wait(lock, [this] { return !free_.empty(); });
  RenderEngine* engine = free_.back();
  free_.pop_back();
  return *engine;
}

void EnginePool::give_back(RenderEngine& engine) {
  {
    const std::scoped_lock lock(mutex_);
    free_.push_back(&engine);
  }
  freed_.notify_one();
}

}  // namespace vinebench::sim
