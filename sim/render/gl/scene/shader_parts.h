// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vinebench::sim {

// Texts that several shaders have in common.

inline constexpr const char* kVersion = "#version 420 core\n";

// Everything is in the camera's frame: floats keep their precision far from the world's origin.
inline constexpr const char* kView = R"(
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

inline constexpr const char* kLighting = R"(
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
inline constexpr const char* kSway = R"(
vec3 sway_at(vec3 p, float t) {
  float gust_here = 0.65 + 0.35 * sin(1.1 * t - 0.9 * dot(p.xy, gust.xy) + gust_phase.x);
  float along = gust_here * (0.7 + 0.3 * sin(4.3 * t + 2.1 * p.x + 1.7 * p.y + gust_phase.y));
  vec3 flutter = sin(vec3(13.0, 11.0, 9.0) * t + vec3(31.0, 29.0, 23.0) * p.zxy + gust_phase.zwx);
  float height = clamp(p.z, 0.0, 1.5);
  return length(gust.xy) * height * (vec3(normalize(gust.xy) * along, 0.0) + 0.3 * flutter);
}
)";

}  // namespace vinebench::sim
