// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/shaders.h"

namespace vinebench::sim {
namespace {

constexpr const char* kVersion = "#version 420 core\n";

// Everything is in the camera's frame: floats keep their precision far from the world's origin.
constexpr const char* kView = R"(
layout(std140, binding = 0) uniform View {
  mat4 clip_from_cam;
  mat4 cam_from_world;
  mat4 world_from_cam;
  mat4 shadow_from_cam;
  mat4 moving_shadow_from_cam;
  vec4 towards_sun;
  vec4 up;
  vec4 sun;
  vec4 sky;
  vec4 bounce;
  vec4 haze;         // encoded colour, extinction in 1/m
  vec4 light_map;    // scale and offset from the world's x and y to the map
  vec4 gust;         // direction and length of the sway in m, time in s, time of the other image
  vec4 gust_phase;
  vec4 lens;         // focal length in px, brightness of the light map, of the sky's image
};
)";

constexpr const char* kLighting = R"(
layout(binding = 3) uniform sampler2DShadow coarse_shadow_map;
layout(binding = 4) uniform sampler2DShadow moving_shadow_map;

vec3 encode(vec3 light) { return pow(light, vec3(1.0 / 2.2)); }

vec3 ambient_light(vec3 normal, float occlusion) {
  return mix(bounce.rgb, sky.rgb, 0.5 + 0.5 * dot(normal, up.xyz)) * occlusion;
}

// A leaf lets light through with a yellow-green tint.
vec3 sun_light(vec3 normal, float translucency) {
  float facing = dot(normal, towards_sun.xyz);
  return sun.rgb * (max(facing, 0.0) + max(-facing, 0.0) * translucency * vec3(1.05, 1.15, 0.55));
}
)";

// Gusts run through the vineyard; each leaf flutters on top of them. Nothing moves at the ground.
constexpr const char* kSway = R"(
vec3 sway_at(vec3 p, float t) {
  float gust_here = 0.65 + 0.35 * sin(1.1 * t - 0.9 * dot(p.xy, gust.xy) + gust_phase.x);
  float along = gust_here * (0.7 + 0.3 * sin(4.3 * t + 2.1 * p.x + 1.7 * p.y + gust_phase.y));
  vec3 flutter = sin(vec3(13.0, 11.0, 9.0) * t + vec3(31.0, 29.0, 23.0) * p.zxy + gust_phase.zwx);
  float height = clamp(p.z, 0.0, 1.5);
  return length(gust.xy) * height * (vec3(normalize(gust.xy) * along, 0.0) + 0.3 * flutter);
}
)";

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
out vec3 v_motion;
#endif
#ifdef HAZE
out float v_haze;
#endif
#ifdef PIXEL_SHADOWS
out vec3 v_shade;
out vec3 v_sun;
out vec3 v_shadow;
#elif defined(LIGHT_MAP)
out vec2 v_map;
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
#endif
#ifdef TRUTH
#ifdef WIND
  v_motion = sway * sway_at(p_rest, gust.w) - moved;
#else
  v_motion = vec3(0.0);
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
  v_map = (world_from_cam * vec4(p_cam, 1.0)).xy * light_map.xy + light_map.zw;
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
in vec3 v_motion;
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
in vec2 v_map;
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
  vec3 light = texture(ground_light, v_map).rgb * tint;
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
  facing = vec4(normalize(dot(across, v_place) < 0.0 ? across : -across), 1.0);
  motion = vec4(v_motion, 1.0);
#endif
}
)";

constexpr const char* kShadowVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
out vec2 v_uv;

void main() {
  vec4 p = vec4(position, 1.0);
  gl_Position = vec4(dot(row_x, p), dot(row_y, p), dot(row_z, p), 1.0);
  v_uv = uv;
}
)";

constexpr const char* kShadowFragment = R"(
layout(binding = 0) uniform sampler2D image;
in vec2 v_uv;

void main() {
#ifdef CUTOUT
  if (texture(image, v_uv).a < 0.5) discard;
#endif
}
)";

constexpr const char* kSkyVertex = R"(
uniform mat4 ray_from_clip;
out vec3 v_ray;

void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(p, 1.0, 1.0);
  v_ray = (ray_from_clip * vec4(p, 1.0, 0.0)).xyz;
}
)";

// The sky's image is a parabolic map: uv = ray.xy / (1 + ray.z), which reaches below the horizon.
constexpr const char* kSkyFragment = R"(
layout(binding = 0) uniform sampler2D image;
in vec3 v_ray;
layout(location = 0) out vec4 colour;

void main() {
  vec2 p = v_ray.xy / (length(v_ray) + v_ray.z);
  colour = vec4(texture(image, p * (0.5 / 1.4) + 0.5).rgb * lens.z, 0.0);
}
)";

constexpr const char* kWireVertex = R"(
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 shape;  // end (0 from, 1 to), side (-1, 1), radius
uniform vec4 surface;
out vec4 v_light;  // encoded, haze
out vec2 v_width;  // px: distance from the middle, half the wire's width
out vec3 v_normal;

void main() {
  vec3 a = (cam_from_world * vec4(from, 1.0)).xyz;
  vec3 b = (cam_from_world * vec4(to, 1.0)).xyz;
  vec3 p = shape.x > 0.5 ? b : a;
  vec3 side = cross(normalize(b - a), normalize(p));
  // Seen end on, a wire has no side; any will do.
  side = dot(side, side) > 1e-8 ? normalize(side) : vec3(1.0, 0.0, 0.0);
  float px = lens.x / max(p.z, 0.03);
  v_width = vec2(shape.y * (shape.z * px + 0.5), shape.z * px);
  gl_Position = clip_from_cam * vec4(p + side * (v_width.x / px), 1.0);

  vec3 towards_camera = normalize(-p);
  vec3 normal = normalize(towards_camera + 0.6 * up.xyz);
  float fog = 1.0 - exp(-haze.a * length(p));
  vec3 light = encode(surface.rgb * (ambient_light(normal, 1.0) + sun_light(normal, 0.0)));
  v_light = vec4(mix(light, haze.rgb, fog), 1.0);
  v_normal = towards_camera;
}
)";

constexpr const char* kWireFragment = R"(
uniform vec4 surface;
in vec4 v_light;
in vec2 v_width;
in vec3 v_normal;
#ifdef TRUTH
layout(location = 1) out vec4 identity;
layout(location = 2) out vec4 facing;
layout(location = 3) out vec4 motion;
#else
layout(location = 0, index = 0) out vec4 colour;
layout(location = 0, index = 1) out vec4 coverage;
#endif

void main() {
  float d = abs(v_width.x);
  float share = clamp(min(d + 0.5, v_width.y) - max(d - 0.5, -v_width.y), 0.0, 1.0);
#ifdef TRUTH
  if (share < 0.5) discard;
  identity = vec4(0.0);
  facing = vec4(normalize(v_normal), 1.0);
  motion = vec4(0.0, 0.0, 0.0, 1.0);
#else
  colour = vec4(v_light.rgb, surface.a);
  coverage = vec4(vec3(share), step(0.5, share));
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
std::string shadow_vertex_shader() {
  return std::string(kVersion) + kShadowVertex;
}
std::string shadow_fragment_shader(bool cutout) {
  return std::string(kVersion) + (cutout ? "#define CUTOUT\n" : "") + kShadowFragment;
}
std::string sky_vertex_shader() {
  return std::string(kVersion) + kView + kSkyVertex;
}
std::string sky_fragment_shader() {
  return std::string(kVersion) + kView + kSkyFragment;
}
std::string wire_vertex_shader() {
  return std::string(kVersion) + kView + kLighting + kWireVertex;
}
std::string wire_fragment_shader(bool truth) {
  return std::string(kVersion) + (truth ? "#define TRUTH\n" : "") + kView + kWireFragment;
}

}  // namespace vinebench::sim
