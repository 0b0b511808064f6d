// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/mesh_shaders.h"

#include "sim/render/gl/scene/shader_parts.h"

namespace vinebench::sim {
namespace {

constexpr const char* kMeshVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in float occlusion;
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;

uniform vec4 surface;  // linear colour, label
uniform vec4 leaf;     // translucency, double-sided, shadow offset along the normal and to the sun
uniform float sway;
out vec2 v_uv;

#ifdef COLOURED
layout(location = 9) in vec3 vertex_colour;  // encoded
#endif
#ifdef TRUTH
layout(location = 7) in uint instance;
layout(location = 8) in float part;
flat out uvec2 v_id;
out vec3 v_place;
#ifdef WIND
out vec3 v_motion;
#endif
#endif
#ifdef HAZE
out float v_haze;
#endif
#ifdef PIXEL_SHADOWS
out vec3 v_shade;
out vec3 v_sun;
out vec3 v_shadow;
#elif defined(LIGHT_MAP)
#ifndef OPEN
out vec2 v_map;
#endif
#ifdef MOVING
out vec3 v_shade;
#endif
#else
out vec3 v_light;
#endif
#if defined(MOVING) && (defined(PIXEL_SHADOWS) || defined(LIGHT_MAP))
out vec3 v_moving;
#endif

void main() {
  vec4 p = vec4(position, 1.0);
  vec3 p_cam = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  vec3 n_cam = normalize(
      vec3(dot(row_x.xyz, normal), dot(row_y.xyz, normal), dot(row_z.xyz, normal)));
#ifdef WIND
  vec3 p_rest = (world_from_cam * vec4(p_cam, 1.0)).xyz;
  vec3 moved = sway * sway_at(p_rest, gust.z);
  p_cam += mat3(cam_from_world) * moved;
#ifdef TRUTH
  v_motion = sway * sway_at(p_rest, gust.w) - moved;
#endif
#endif
  if (leaf.y > 0.5 && dot(n_cam, p_cam) > 0.0) n_cam = -n_cam;
#ifdef BAKING
  vec2 on_map = (world_from_cam * vec4(p_cam, 1.0)).xy * light_map.xy + light_map.zw;
  gl_Position = vec4(2.0 * on_map - 1.0, 0.0, 1.0);
#else
  gl_Position = clip_from_cam * vec4(p_cam, 1.0);
#endif
  v_uv = uv;
#ifdef TRUTH
  v_id = uvec2(instance, uint(part + 0.5));
  v_place = p_cam;
#endif
#ifdef HAZE
  v_haze = 1.0 - exp(-haze.a * length(p_cam));
#endif
#ifdef LIGHT_MAP
#ifndef OPEN
  v_map = (world_from_cam * vec4(p_cam, 1.0)).xy * light_map.xy + light_map.zw;
#endif
#ifdef MOVING
  v_shade = encode(surface.rgb * ambient_light(n_cam, occlusion));
  v_moving = (moving_shadow_from_cam * vec4(p_cam, 1.0)).xyz;
#endif
#else
  vec3 shade = surface.rgb * ambient_light(n_cam, occlusion);
  vec3 lit = surface.rgb * sun_light(n_cam, leaf.x);
  vec3 p_bias = p_cam + n_cam * leaf.z + towards_sun.xyz * leaf.w;
  vec3 p_shadow = (shadow_from_cam * vec4(p_bias, 1.0)).xyz;
  p_shadow.z = min(p_shadow.z, 1.0);
#ifdef PIXEL_SHADOWS
  v_shade = encode(shade);
  v_sun = encode(shade + lit) - v_shade;
#ifdef COLOURED
  v_shade *= vertex_colour;
  v_sun *= vertex_colour;
#endif
  v_shadow = p_shadow;
#ifdef MOVING
  v_moving = (moving_shadow_from_cam * vec4(p_bias, 1.0)).xyz;
#endif
#else
#ifdef MOVING
  vec3 p_moving = (moving_shadow_from_cam * vec4(p_bias, 1.0)).xyz;
  p_moving.z = min(p_moving.z, 1.0);
  lit *= textureLod(moving_shadow_map, p_moving, 0.0);
#endif
  v_light = encode(shade + lit * textureLod(coarse_shadow_map, p_shadow, 0.0));
#ifdef COLOURED
  v_light *= vertex_colour;
#endif
#endif
#endif
}
)";

constexpr const char* kMeshFragment = R"(
uniform vec4 surface;
layout(binding = 0) uniform sampler2D image;
in vec2 v_uv;
#ifdef TRUTH
flat in uvec2 v_id;
in vec3 v_place;
#ifdef WIND
in vec3 v_motion;
#endif
layout(location = 1) out vec4 identity;
layout(location = 2) out vec4 facing;
layout(location = 3) out vec4 motion;
#endif
#ifdef HAZE
in float v_haze;
#endif
#ifdef PIXEL_SHADOWS
in vec3 v_shade;
in vec3 v_sun;
in vec3 v_shadow;
#elif defined(LIGHT_MAP)
#ifndef OPEN
in vec2 v_map;
#endif
layout(binding = 2) uniform sampler2D ground_light;
uniform vec3 tint;
#ifdef MOVING
in vec3 v_shade;
#endif
#else
in vec3 v_light;
#endif
#if defined(MOVING) && (defined(PIXEL_SHADOWS) || defined(LIGHT_MAP))
in vec3 v_moving;
layout(binding = 4) uniform sampler2DShadow moving_shadow_map;

// Share of the sun that what moves leaves; few pixels are near enough to have to look.
float past_movers() {
  vec2 off = abs(v_moving.xy - 0.5);
  if (max(off.x, off.y) > 0.5) return 1.0;
  return textureLod(moving_shadow_map, vec3(v_moving.xy, min(v_moving.z, 1.0)), 0.0);
}
#endif
layout(location = 0) out vec4 colour;

void main() {
#ifdef TRUTH
  // The triangle's own normal: that of its vertices is bent for the light's sake.
  vec3 across = cross(dFdx(v_place), dFdy(v_place));
#endif
#ifdef TEXTURED
  vec4 texel = texture(image, v_uv);
#ifdef CUTOUT
  if (texel.a < 0.5) discard;
#endif
#endif
#ifdef PIXEL_SHADOWS
  float sun_share = texture(shadow_map, v_shadow);
#ifdef MOVING
  sun_share *= past_movers();
#endif
  vec3 light = v_shade + v_sun * sun_share;
#elif defined(LIGHT_MAP)
#ifdef OPEN
  vec3 light = tint;
#else
  vec3 light = texture(ground_light, v_map).rgb * tint;
#endif
#ifdef MOVING
  float past = past_movers();
  // What is left is the sky's light; where a plant's shadow lies there is no more to take.
  if (past < 1.0) light = mix(min(light, v_shade), light, past);
#endif
#else
  vec3 light = v_light;
#endif
#ifdef TEXTURED
  light *= texel.rgb;
#endif
#ifdef HAZE
  light = mix(light, haze.rgb, v_haze);
#endif
#ifdef BAKING
  light *= lens.y;
#endif
  colour = vec4(light, surface.a);
#ifdef TRUTH
  identity = vec4(v_id.x & 255u, (v_id.x >> 8u) & 255u, (v_id.x >> 16u) & 255u, v_id.y) / 255.0;
  facing = vec4(0.5 + 0.5 * normalize(dot(across, v_place) < 0.0 ? across : -across), 1.0);
#ifdef WIND
  motion = vec4(v_motion, 1.0);
#else
  motion = vec4(0.0, 0.0, 0.0, 1.0);
#endif
#endif
}
)";

std::string defines(const MeshShader& shader) {
  std::string text;
  const auto define = [&](bool on, const char* name) {
    if (on) text += std::string("#define ") + name + "\n";
  };
  define(shader.textured, "TEXTURED");
  define(shader.cutout, "CUTOUT");
  define(shader.shadows == MeshShader::Shadows::kPixels, "PIXEL_SHADOWS");
  define(shader.shadows == MeshShader::Shadows::kLightMap, "LIGHT_MAP");
  define(shader.haze, "HAZE");
  define(shader.wind, "WIND");
  define(shader.truth, "TRUTH");
  define(shader.baking, "BAKING");
  define(shader.moving, "MOVING");
  define(shader.coloured, "COLOURED");
  define(shader.open, "OPEN");
  return text;
}

}  // namespace

std::string mesh_vertex_shader(const MeshShader& shader) {
  return kVersion + defines(shader) + kView + kLighting + kSway + kMeshVertex;
}
std::string mesh_fragment_shader(const MeshShader& shader) {
  return kVersion + defines(shader) + kView +
         "layout(binding = 1) uniform sampler2DShadow shadow_map;\n" + kMeshFragment;
}

}  // namespace vinebench::sim
