// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/mesh_programs.h"

#include "tests/support/gl_fixture.h"

namespace vinebench::sim {
namespace {

using Shadows = MeshShader::Shadows;

Material material_of(Label label) {
  Material material;
  material.label = label;
  return material;
}

TEST(ShaderForTest, LargeEvenThingsShowShadowsPixelByPixel) {
  for (const Label label : {Label::kTag, Label::kBox, Label::kCrate, Label::kRover}) {
    EXPECT_EQ(shader_for(material_of(label)).shadows, Shadows::kPixels);
  }
  for (const Label label : {Label::kLeaf, Label::kTrunk, Label::kBunch, Label::kPost}) {
    EXPECT_EQ(shader_for(material_of(label)).shadows, Shadows::kVertices);
  }
}

TEST(ShaderForTest, TheGroundHasItsLightMapWhateverItsLabel) {
  Material ground = material_of(Label::kGrass);
  ground.terrain = true;
  EXPECT_EQ(shader_for(ground).shadows, Shadows::kLightMap);
  EXPECT_EQ(shader_for(material_of(Label::kGrass)).shadows, Shadows::kVertices);
}

TEST(ShaderForTest, OnlyATextureCanBeCutOut) {
  Material leaf = material_of(Label::kLeaf);
  leaf.cutout = true;
  EXPECT_FALSE(shader_for(leaf).textured);
  EXPECT_FALSE(shader_for(leaf).cutout);
  leaf.texture = 0;
  EXPECT_TRUE(shader_for(leaf).textured);
  EXPECT_TRUE(shader_for(leaf).cutout);
}

TEST(SurfaceTest, IsTheColourWithTheLabelAsAlpha) {
  Material material = material_of(Label::kBox);
  material.colour = {0.2f, 0.4f, 0.6f};
  const Eigen::Vector4f surface = surface_of(material);
  EXPECT_EQ(surface.head<3>(), material.colour);
  EXPECT_NEAR(255 * surface.w(), static_cast<double>(Label::kBox), 1e-5);  // a byte of the image
}

class MeshProgramsTest : public test::GlTest {};

TEST_F(MeshProgramsTest, EachIsCompiledOnce) {
  MeshPrograms programs(gl_);
  MeshShader plain, hazy;
  hazy.haze = true;
  const MeshProgram* first = &programs.get(plain);
  EXPECT_NE(&programs.get(hazy), first);
  EXPECT_EQ(&programs.get(plain), first);
}

TEST_F(MeshProgramsTest, EveryUniformIsSetForAMaterial) {
  MeshPrograms programs(gl_);
  Material leaf = material_of(Label::kLeaf);
  leaf.double_sided = true;
  for (const Shadows shadows : {Shadows::kVertices, Shadows::kPixels, Shadows::kLightMap}) {
    MeshShader shader;
    shader.shadows = shadows;
    programs.get(shader).use_for(leaf, 0.01, Eigen::Vector3f::Ones());
    EXPECT_EQ(gl_.GetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
}

}  // namespace
}  // namespace vinebench::sim
