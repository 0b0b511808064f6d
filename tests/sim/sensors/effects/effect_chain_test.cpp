// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/effect_chain.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

/// What the effects did, in order.
using Journal = std::vector<std::string>;

struct NotedView : ViewEffect {
  NotedView(Journal& to, std::string as, bool labels)
      : journal(to), name(std::move(as)), with_labels(labels) {}
  bool wants_labels(const DrawnView&) const override { return with_labels; }
  void apply(RenderedImage&, const DrawnView&) const override { journal.push_back(name); }
  Journal& journal;
  std::string name;
  bool with_labels;
};

/// Active from some second on; adds an eighth of white.
struct NotedLight : LightEffect {
  NotedLight(Journal& to, std::string as, double seconds)
      : journal(to), name(std::move(as)), from(seconds) {}
  bool is_active(Stamp instant) const override { return instant >= from_seconds(from); }
  void apply(cv::Mat& light, const Shot&) const override {
    EXPECT_EQ(light.type(), CV_32FC3);
    light += cv::Scalar::all(0.125);
    journal.push_back(name);
  }
  Journal& journal;
  std::string name;
  double from;
};

struct NotedCode : CodeEffect {
  NotedCode(Journal& to, std::string as) : journal(to), name(std::move(as)) {}
  void apply(cv::Mat& codes, const Shot&) override {
    EXPECT_EQ(codes.depth(), CV_8U);
    journal.push_back(name);
  }
  Journal& journal;
  std::string name;
};

class EffectChainTest : public testing::Test {
 protected:
  EffectChainTest() {
    chain_.add(std::make_unique<NotedCode>(journal_, "code 1"));
    chain_.add(std::make_unique<NotedLight>(journal_, "light 1", 1));
    chain_.add(std::make_unique<NotedCode>(journal_, "code 2"));
    chain_.add(std::make_unique<NotedLight>(journal_, "light 2", 1));
  }
  Journal journal_;
  EffectChain chain_;
};

TEST_F(EffectChainTest, LightComesBeforeCodesEachAsAdded) {
  cv::Mat image(2, 2, CV_8UC3, cv::Scalar::all(0));
  chain_.develop(image, test::shot_at(1));
  EXPECT_EQ(journal_, (Journal{"light 1", "light 2", "code 1", "code 2"}));
  // Two eighths of white: 255 * 0.25^(1 / 2.2) = 135.8.
  EXPECT_EQ(image.at<cv::Vec3b>(1, 1), cv::Vec3b::all(136));
}

TEST_F(EffectChainTest, InactiveLightEffectsAreLeftOutAndCodesStay) {
  cv::Mat image(1, 1, CV_8UC3, cv::Scalar(3, 100, 254));
  chain_.develop(image, test::shot_at(0.999));
  EXPECT_EQ(journal_, (Journal{"code 1", "code 2"}));
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(3, 100, 254));
}

TEST_F(EffectChainTest, OfLightEffectsTheActiveOnesAreApplied) {
  chain_.add(std::make_unique<NotedLight>(journal_, "light 3", 5));
  chain_.add(std::make_unique<NotedLight>(journal_, "light 4", 0));
  cv::Mat image(1, 1, CV_8UC3, cv::Scalar::all(0));
  chain_.develop(image, test::shot_at(1));
  EXPECT_EQ(journal_, (Journal{"light 1", "light 2", "light 4", "code 1", "code 2"}));
}

TEST_F(EffectChainTest, LightBecomesCodesWithoutAnyEffect) {
  cv::Mat image(1, 1, CV_32FC3, cv::Scalar(0, 0.25, 1.5));
  EffectChain().develop(image, {});
  ASSERT_EQ(image.type(), CV_8UC3);
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 136, 255));
}

TEST_F(EffectChainTest, EveryViewEffectIsApplied) {
  const PinholeCamera camera{};
  const Pose pose{};
  const DrawnView view{camera, pose, 1};
  EXPECT_FALSE(chain_.wants_labels(view));
  chain_.add(std::make_unique<NotedView>(journal_, "view 1", false));
  EXPECT_FALSE(chain_.wants_labels(view));
  chain_.add(std::make_unique<NotedView>(journal_, "view 2", true));
  EXPECT_TRUE(chain_.wants_labels(view));
  RenderedImage image;
  chain_.apply_to_view(image, view);
  EXPECT_EQ(journal_, (Journal{"view 1", "view 2"}));
}

TEST_F(EffectChainTest, NullIsLeftOut) {
  chain_.add(std::unique_ptr<ViewEffect>());
  chain_.add(std::unique_ptr<LightEffect>());
  chain_.add(std::unique_ptr<CodeEffect>());
  cv::Mat image(1, 1, CV_8UC3, cv::Scalar::all(0));
  chain_.develop(image, test::shot_at(1));
  EXPECT_EQ(journal_.size(), 4u);
}

}  // namespace
}  // namespace vinebench::sim
