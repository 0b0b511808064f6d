// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/shaders.h"

namespace vinebench {
namespace {

constexpr const char* kVersion = "#version 330 core\n";

// Everything is in the camera's frame: floats keep their precision far from the world's origin.
constexpr const char* kLighting = R"(
uniform vec3 towards_sun;
uniform vec3 up;
uniform vec3 sun;
uniform vec3 sky;
uniform vec3 bounce;
uniform mat4 shadow_from_cam;
uniform sampler2DShadow shadow_map;

vec3 encode(vec3 light) { return pow(light, vec3(1.0 / 2.2)); }

vec3 ambient_light(vec3 normal, float occlusion) {
  return mix(bounce, sky, 0.5 + 0.5 * dot(normal, up)) * occlusion;
}

// A leaf lets light through with a yellow-green tint.
vec3 sun_light(vec3 normal, float translucency) {
  float facing = dot(normal, towards_sun);
  return sun * (max(facing, 0.0) + max(-facing, 0.0) * translucency * vec3(1.05, 1.15, 0.55));
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

uniform mat4 clip_from_cam;
uniform vec4 surface;  // linear colour, label
uniform vec4 leaf;     // translucency, double-sided, shadow offset along the normal and to the sun
out vec2 v_uv;

#ifdef PIXEL_SHADOWS
out vec3 v_shade;
out vec3 v_sun;
out vec3 v_shadow;
#else
out vec3 v_light;
#endif

void main() {
  vec4 p = vec4(position, 1.0);
  vec3 p_cam = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  vec3 n_cam = normalize(
      vec3(dot(row_x.xyz, normal), dot(row_y.xyz, normal), dot(row_z.xyz, normal)));
  if (leaf.y > 0.5 && dot(n_cam, p_cam) > 0.0) n_cam = -n_cam;
  gl_Position = clip_from_cam * vec4(p_cam, 1.0);
  v_uv = uv;

  vec3 shade = surface.rgb * ambient_light(n_cam, occlusion);
  vec3 lit = surface.rgb * sun_light(n_cam, leaf.x);
  vec3 p_bias = p_cam + n_cam * leaf.z + towards_sun * leaf.w;
  vec3 p_shadow = (shadow_from_cam * vec4(p_bias, 1.0)).xyz;
#ifdef PIXEL_SHADOWS
  v_shade = encode(shade);
  v_sun = encode(shade + lit) - v_shade;
  v_shadow = p_shadow;
#else
  v_light = encode(shade + lit * textureLod(shadow_map, vec3(p_shadow.xy, min(p_shadow.z, 1.0)), 0.0));
#endif
}
)";

constexpr const char* kMeshFragment = R"(
uniform vec4 surface;
uniform sampler2D picture;
#ifdef PIXEL_SHADOWS
uniform sampler2DShadow shadow_map;
in vec3 v_shade;
in vec3 v_sun;
in vec3 v_shadow;
#else
in vec3 v_light;
#endif
in vec2 v_uv;
layout(location = 0) out vec4 colour;

void main() {
#ifdef TEXTURED
  vec4 texel = texture(picture, v_uv);
#ifdef CUTOUT
  if (texel.a < 0.5) discard;
#endif
#endif
#ifdef PIXEL_SHADOWS
  vec3 light = v_shade + v_sun * texture(shadow_map, vec3(v_shadow.xy, min(v_shadow.z, 1.0)));
#else
  vec3 light = v_light;
#endif
#ifdef TEXTURED
  light *= texel.rgb;
#endif
  colour = vec4(light, surface.a);
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
uniform sampler2D picture;
in vec2 v_uv;

void main() {
#ifdef CUTOUT
  if (texture(picture, v_uv).a < 0.5) discard;
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

// The sky's picture is a parabolic map: uv = ray.xy / (1 + ray.z), which reaches below the horizon.
constexpr const char* kSkyFragment = R"(
uniform sampler2D picture;
in vec3 v_ray;
layout(location = 0) out vec4 colour;

void main() {
  vec2 p = v_ray.xy / (length(v_ray) + v_ray.z);
  colour = vec4(texture(picture, p * (0.5 / 1.4) + 0.5).rgb, 0.0);
}
)";

constexpr const char* kWireVertex = R"(
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 shape;  // end (0 from, 1 to), side (-1, 1), radius
uniform mat4 cam_from_world;
uniform mat4 clip_from_cam;
uniform vec4 surface;
uniform float focal_length;
out vec3 v_light;
out vec2 v_width;  // px: distance from the middle, half the wire's width

void main() {
  vec3 a = (cam_from_world * vec4(from, 1.0)).xyz;
  vec3 b = (cam_from_world * vec4(to, 1.0)).xyz;
  vec3 p = shape.x > 0.5 ? b : a;
  vec3 side = cross(normalize(b - a), normalize(p));
  // Seen end on, a wire has no side; any will do.
  side = dot(side, side) > 1e-8 ? normalize(side) : vec3(1.0, 0.0, 0.0);
  float px = focal_length / max(p.z, 0.03);
  v_width = vec2(shape.y * (shape.z * px + 0.5), shape.z * px);
  gl_Position = clip_from_cam * vec4(p + side * (v_width.x / px), 1.0);

  vec3 towards_camera = normalize(-p);
  vec3 normal = normalize(towards_camera + 0.6 * up);
  v_light = encode(surface.rgb * (ambient_light(normal, 1.0) + sun_light(normal, 0.0)));
}
)";

constexpr const char* kWireFragment = R"(
uniform vec4 surface;
in vec3 v_light;
in vec2 v_width;
layout(location = 0, index = 0) out vec4 colour;
layout(location = 0, index = 1) out vec4 coverage;

void main() {
  float d = abs(v_width.x);
  float share = clamp(min(d + 0.5, v_width.y) - max(d - 0.5, -v_width.y), 0.0, 1.0);
  colour = vec4(v_light, surface.a);
  coverage = vec4(vec3(share), step(0.5, share));
}
)";

std::string defines(const MeshShader& shader) {
  return std::string(shader.textured ? "#define TEXTURED\n" : "") +
         (shader.cutout ? "#define CUTOUT\n" : "") +
         (shader.pixel_shadows ? "#define PIXEL_SHADOWS\n" : "");
}

}  // namespace

std::string mesh_vertex_shader(const MeshShader& shader) {
  return kVersion + defines(shader) + kLighting + kMeshVertex;
}
std::string mesh_fragment_shader(const MeshShader& shader) {
  return kVersion + defines(shader) + kMeshFragment;
}
std::string shadow_vertex_shader() {
  return std::string(kVersion) + kShadowVertex;
}
std::string shadow_fragment_shader(bool cutout) {
  return std::string(kVersion) + (cutout ? "#define CUTOUT\n" : "") + kShadowFragment;
}
std::string sky_vertex_shader() {
  return std::string(kVersion) + kSkyVertex;
}
std::string sky_fragment_shader() {
  return std::string(kVersion) + kSkyFragment;
}
std::string wire_vertex_shader() {
  return std::string(kVersion) + kLighting + kWireVertex;
}
std::string wire_fragment_shader() {
  return std::string(kVersion) + kWireFragment;
}

}  // namespace vinebench
