// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/light_map.h"

#include <cmath>

#include "sim/scene/block_mesh.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

/// A level square at the origin that faces up, of cells of a quarter of a metre: shadows are looked
/// up by vertices that must not lie far from the map.
Primitive slab(int material, int half_cells) {
  Primitive part;
  part.material = material;
  MeshBuilder builder(part);
  for (int i = -half_cells; i < half_cells; ++i) {
    for (int j = -half_cells; j < half_cells; ++j) {
      const Eigen::Vector3f middle(0.25f * (static_cast<float>(i) + 0.5f),
                                   0.25f * (static_cast<float>(j) + 0.5f), 0);
      add_face(builder, middle, {0.125f, 0, 0}, {0, 0.125f, 0}, {});
    }
  }
  return part;
}

/// Ground of 10 m a side and a roof of 1 m a side half a metre above its middle, under a sun in the
/// zenith.
class LightMapTest : public test::GlTest {
 protected:
  LightMapTest() {
    ground_ = test::add_material(scene_, Label::kGround, Eigen::Vector3f::Ones());
    scene_.materials.back().terrain = true;
    const int box = test::add_material(scene_, Label::kBox, Eigen::Vector3f::Ones());
    test::add_instance(scene_, test::add_model(scene_, slab(ground_, 20)), {0, 0, 0});
    test::add_instance(scene_, test::add_model(scene_, slab(box, 2)), {0, 0, 0.5});
    scene_.light.towards_sun = {0, 0, 1};
    scene_.light.sun.setConstant(0.5f);
    scene_.light.sky.setConstant(0.25f);
  }
  /// Red of the map at a place of the ground, 0 to 255.
  int light_at(double x, double y, int largest = 256) const {
    const GpuScene gpu(gl_, scene_);
    const ViewBuffer view(gl_);
    MeshPrograms programs(gl_);
    const ShadowMap shadows(gpu, 512);
    const LightMap map(gpu, shadows, programs, view, largest);
    const Eigen::Vector4f& m = map.map_from_world();
    bind_texture(gl_, 0, map.texture());
    return shade(1, 1,
                 R"(#version 420 core
layout(binding = 0) uniform sampler2D image;
layout(location = 0) out vec4 colour;
void main() { colour = textureLod(image, vec2()" +
                     std::to_string(m.x() * static_cast<float>(x) + m.z()) + ", " +
                     std::to_string(m.y() * static_cast<float>(y) + m.w()) + "), -2.0); }")
        .at<cv::Vec4b>(0, 0)[0];
  }
  /// The map's byte of a light.
  static double byte_of(double light) {
    return 255 * std::pow(light, 1 / 2.2) / LightMap::kBrightest;
  }
  Scene scene_;
  int ground_ = 0;
};

TEST_F(LightMapTest, OpenGroundHasSunAndSkyShadedGroundTheSkyAlone) {
  EXPECT_NEAR(light_at(0, 0), byte_of(0.25), 1.5);
  EXPECT_NEAR(light_at(0.4, -0.4), byte_of(0.25), 1.5);
  EXPECT_NEAR(light_at(0.65, 0), byte_of(0.75), 1.5);
  EXPECT_NEAR(light_at(0, -0.65), byte_of(0.75), 1.5);
}

TEST_F(LightMapTest, BeyondItTheGroundLiesOpen) {
  EXPECT_NEAR(light_at(4, -3), byte_of(0.75), 1.5);
}

// The roof's ball and a margin reach 1 m from the middle; the tile's ball has 0.7 m.
TEST_F(LightMapTest, ATileIsOpenIfNoneOfItIsOnTheMap) {
  const int tile = test::add_model(scene_, slab(ground_, 2));
  test::add_instance(scene_, tile, {1.6, 0, 0});
  test::add_instance(scene_, tile, {1.8, 0, 0});
  const GpuScene gpu(gl_, scene_);
  const ViewBuffer view(gl_);
  MeshPrograms programs(gl_);
  const ShadowMap shadows(gpu, 512);
  const LightMap map(gpu, shadows, programs, view, 256);
  EXPECT_FALSE(map.is_open(gpu.instances[0]));
  EXPECT_FALSE(map.is_open(gpu.instances[2]));
  EXPECT_TRUE(map.is_open(gpu.instances[3]));
  EXPECT_NEAR(255 * map.open_light().x(), byte_of(0.75), 1.5);
}

TEST_F(LightMapTest, AShadowLiesAwayFromALowSun) {
  scene_.light.towards_sun = Eigen::Vector3f(1, 0, 1).normalized();  // half a metre to -x
  EXPECT_NEAR(light_at(-0.8, 0), byte_of(0.25), 1.5);
  // The sun's light on level ground is that of its elevation's sine.
  EXPECT_NEAR(light_at(0.2, 0), byte_of(0.25 + 0.5 * std::sqrt(0.5)), 1.5);
}

TEST_F(LightMapTest, WithoutGroundItIsWhite) {
  scene_.materials[0].terrain = false;
  EXPECT_EQ(light_at(0, 0), 255);
}

TEST_F(LightMapTest, WithoutPixelsTheGroundLiesOpen) {
  EXPECT_NEAR(light_at(3, 3, 0), byte_of(0.75), 1.5);
}

}  // namespace
}  // namespace vinebench::sim
