// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/shaders.h"

#include "sim/render/gl/scene/shader_parts.h"

namespace vinebench::sim {
namespace {

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
uniform vec2 rows;
out vec3 v_ray;

void main() {
  bool right = gl_VertexID == 1 || gl_VertexID > 3;
  bool second = gl_VertexID == 2 || gl_VertexID == 3 || gl_VertexID == 5;
  vec2 p = vec2(right ? 1.0 : -1.0, second ? rows.y : rows.x);
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
  facing = vec4(0.5 + 0.5 * normalize(v_normal), 1.0);
  motion = vec4(0.0, 0.0, 0.0, 1.0);
#else
  colour = vec4(v_light.rgb, surface.a);
  coverage = vec4(vec3(share), step(0.5, share));
#endif
}
)";

}  // namespace

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
