// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/renderer_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

GlBackend chosen(GlBackend configured, const std::string& name) {
  RendererConfig config;
  config.backend = configured;
  choose_backend(config, name);
  return config.backend;
}

TEST(RendererConfigTest, ANamedPlatformFillsWhatIsLeftOpen) {
  EXPECT_EQ(chosen(GlBackend::kAuto, "osmesa"), GlBackend::kOsmesa);
  EXPECT_EQ(chosen(GlBackend::kAuto, "egl"), GlBackend::kEgl);
  EXPECT_EQ(chosen(GlBackend::kAuto, "auto"), GlBackend::kAuto);
  EXPECT_EQ(chosen(GlBackend::kAuto, ""), GlBackend::kAuto);
}

TEST(RendererConfigTest, TheConfigurationsOwnChoiceStays) {
  EXPECT_EQ(chosen(GlBackend::kEgl, "osmesa"), GlBackend::kEgl);
  EXPECT_EQ(chosen(GlBackend::kOsmesa, ""), GlBackend::kOsmesa);
}

TEST(RendererConfigTest, AQualityIsALevelOfDetailAndSamples) {
  RendererConfig config;
  config.lod_scale = 0.7;
  choose_quality(config, RenderQuality::kFast);
  EXPECT_EQ(config.lod_scale, 0.7);
  EXPECT_EQ(config.supersampling, 1);
  choose_quality(config, RenderQuality::kFine);
  EXPECT_EQ(config.lod_scale, 3);
  EXPECT_EQ(config.supersampling, 2);
}

TEST(RendererConfigTest, AnUnknownNameIsAnErrorEvenWhereItWouldNotCount) {
  for (const GlBackend configured : {GlBackend::kAuto, GlBackend::kEgl}) {
    EXPECT_THAT(test::error_of([&] { chosen(configured, "glx"); }),
                testing::HasSubstr("GL platform 'glx': expected auto, osmesa or egl"));
  }
}

}  // namespace
}  // namespace vinebench::sim
