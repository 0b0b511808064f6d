// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "sim/render/render_engine.h"

namespace vinebench::sim {

/// A few engines of one scene, borrowed by more threads than there are engines: each costs memory
/// and time for its copy of the scene, and beyond a few of them, or one for each processor, no
/// image is finished sooner.
class EnginePool {
 public:
  static constexpr int kMost = 3;

  /// As many engines as `users`, the threads that draw at the same time, or `processors`, if these
  /// are fewer; one to kMost.
  EnginePool(int users, int processors, const std::function<std::unique_ptr<RenderEngine>()>& make);

  /// Lends an engine to `use`; waits until one is free.
  void with_engine(const std::function<void(RenderEngine&)>& use);

  std::size_t size() const { return engines_.size(); }

 private:
  RenderEngine& take();
  void give_back(RenderEngine& engine);

  std::vector<std::unique_ptr<RenderEngine>> engines_;
  std::mutex mutex_;
  std::condition_variable freed_;
  std::vector<RenderEngine*> free_;
};

}  // namespace vinebench::sim
