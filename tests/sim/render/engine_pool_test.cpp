// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/engine_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace vinebench::sim {
namespace {

/// Notes whether two threads were in one engine at once.
class CountingEngine : public RenderEngine {
 public:
  RenderedImage render(const PinholeCamera&, const Pose&, const RenderRequest&) override {
    if (inside_++ != 0) shared = true;
    std::this_thread::yield();
    ++images;
    --inside_;
    return {};
  }
  std::atomic<bool> shared = false;
  std::atomic<int> images = 0;

 private:
  std::atomic<int> inside_ = 0;
};

class EnginePoolTest : public testing::Test {
 protected:
  std::unique_ptr<RenderEngine> make() {
    auto engine = std::make_unique<CountingEngine>();
    made_.push_back(engine.get());
    return engine;
  }
  std::vector<CountingEngine*> made_;
};

TEST_F(EnginePoolTest, HasAnEngineAUserOrProcessorUpToAFew) {
  const auto size = [this](int users, int processors = 64) {
    return EnginePool(users, processors, [this] { return make(); }).size();
  };
  EXPECT_EQ(size(0), 1u);
  EXPECT_EQ(size(1), 1u);
  EXPECT_EQ(size(2), 2u);
  EXPECT_EQ(size(64), static_cast<std::size_t>(EnginePool::kMost));
  EXPECT_EQ(size(64, 2), 2u);
  EXPECT_EQ(size(2, 0), 1u);  // the number of processors is not known
}

TEST_F(EnginePoolTest, AnEngineHasOneUserAtATime) {
  EnginePool pool(8, 8, [this] { return make(); });
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 200; ++i) {
        pool.with_engine([](RenderEngine& engine) { engine.render({}, {}, {}); });
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  int images = 0;
  for (const CountingEngine* engine : made_) {
    EXPECT_FALSE(engine->shared);
    images += engine->images;
  }
  EXPECT_EQ(images, 1600);
}

TEST_F(EnginePoolTest, AnEngineComesBackAfterAnError) {
  EnginePool pool(1, 1, [this] { return make(); });
  EXPECT_THROW(pool.with_engine([](RenderEngine&) { throw std::runtime_error("lens"); }),
               std::runtime_error);
  bool lent = false;
  pool.with_engine([&](RenderEngine&) { lent = true; });
  EXPECT_TRUE(lent);
}

}  // namespace
}  // namespace vinebench::sim
