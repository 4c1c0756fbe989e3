// The shaders of the picture that the native library and the page draw alike: OpenGL ES 3.0 and WebGL 2 read
// the same text behind the lines of picture_head, for which the page has its own.
#pragma once

namespace nook::test {

inline constexpr const char* picture_head = "#version 300 es\nprecision highp float;\n";

inline constexpr const char* picture_vertex = R"(
layout(location = 0) in vec3 position_ws;
layout(location = 1) in vec3 normal_ws;
layout(location = 2) in float ao;
uniform mat4 clip_from_world;
out vec3 normal;
out float vertex_ao;
void main() {
  normal = normal_ws;
  vertex_ao = ao;
  gl_Position = clip_from_world * vec4(position_ws, 1.0);
}
)";

inline constexpr const char* picture_depth_fragment = R"(
void main() {}
)";

// Light of a sky over a darker ground, times both occlusions.
inline constexpr const char* picture_fragment = R"(
in vec3 normal;
in float vertex_ao;
uniform highp sampler2D screen_ao;
out vec4 colour;
void main() {
  float sky = 0.65 + 0.35 * normalize(normal).y;
  float occlusion = vertex_ao * texelFetch(screen_ao, ivec2(gl_FragCoord.xy), 0).r;
  colour = vec4(pow(vec3(0.80, 0.76, 0.70) * sky * occlusion, vec3(1.0 / 2.2)), 1.0);
}
)";

}  // namespace nook::test
