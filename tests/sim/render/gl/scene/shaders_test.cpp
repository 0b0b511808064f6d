// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/shaders.h"

#include <set>
#include <vector>

#include "sim/render/gl/scene/mesh_shaders.h"
#include "tests/support/gl_fixture.h"

namespace vinebench::sim {
namespace {

using Shadows = MeshShader::Shadows;

/// Every combination of what a mesh's shader may have to do.
std::vector<MeshShader> all_shaders() {
  std::vector<MeshShader> shaders;
  for (const Shadows shadows : {Shadows::kVertices, Shadows::kPixels, Shadows::kLightMap}) {
    for (int bits = 0; bits < 256; ++bits) {
      const auto bit = [&](int i) { return (bits >> i & 1) != 0; };
      shaders.push_back({bit(0), bit(1), shadows, bit(2), bit(3), bit(4), bit(5), bit(6), bit(7)});
    }
  }
  return shaders;
}

TEST(MeshShaderTest, DifferentOnesHaveDifferentKeys) {
  std::set<int> keys;
  for (const MeshShader& shader : all_shaders()) keys.insert(shader.key());
  EXPECT_EQ(keys.size(), 3u * 256);
}

class ShadersTest : public test::GlTest {
 protected:
  void expect_links(const MeshShader& shader) const {
    EXPECT_NO_THROW(
        GlProgram(gl_, "mesh", mesh_vertex_shader(shader), mesh_fragment_shader(shader)))
        << shader.key();
  }
};

/// Outputs of the one must be what the other takes: for each place of shadows with and without
/// what adds any.
TEST_F(ShadersTest, VertexAndFragmentShadersOfAMeshFit) {
  for (const Shadows shadows : {Shadows::kVertices, Shadows::kPixels, Shadows::kLightMap}) {
    for (const bool moving : {false, true}) {
      for (const bool more : {false, true}) {
        MeshShader shader;
        shader.shadows = shadows;
        shader.moving = moving;
        shader.textured = shader.cutout = shader.haze = shader.wind = shader.truth = more;
        shader.coloured = more;
        expect_links(shader);
      }
    }
  }
  MeshShader baking;
  baking.shadows = Shadows::kPixels;
  baking.baking = true;
  expect_links(baking);
}

TEST_F(ShadersTest, SoDoTheOthers) {
  EXPECT_NO_THROW(GlProgram(gl_, "sky", sky_vertex_shader(), sky_fragment_shader()));
  for (const bool flag : {false, true}) {
    EXPECT_NO_THROW(GlProgram(gl_, "shadow", shadow_vertex_shader(), shadow_fragment_shader(flag)));
    EXPECT_NO_THROW(GlProgram(gl_, "wire", wire_vertex_shader(), wire_fragment_shader(flag)));
  }
}

TEST(ShaderSourceTest, AMeshsShaderIsAsLeanAsItsMaterial) {
  const std::string lean = mesh_fragment_shader({});
  for (const char* name :
       {"TEXTURED", "CUTOUT", "HAZE", "WIND", "TRUTH", "ROVER", "LIGHT_MAP", "COLOURED"}) {
    EXPECT_EQ(lean.find(std::string("#define ") + name + "\n"), std::string::npos) << name;
  }
  MeshShader shader;
  shader.cutout = true;
  EXPECT_NE(mesh_fragment_shader(shader).find("#define CUTOUT\n"), std::string::npos);
  EXPECT_EQ(lean.rfind("#version 420 core\n", 0), 0u);  // must come first
}

}  // namespace
}  // namespace vinebench::sim
