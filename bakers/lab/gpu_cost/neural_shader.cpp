#include "bakers/lab/gpu_cost/shader_cases.h"

namespace nook::lab {
namespace {

// Decodes the material of bakers/material/neural_tile.h with features that depend on the view. The library
// does not have this variant. Each texture layer has two channels (BC5). Matrices are stored in blocks of 4 x
// 4, and blocks with the same four inputs are adjacent. The inputs of the first block are the view and the
// constant 1, so its last weights are the bias.
constexpr char decode[] = R"(
uniform highp sampler2DArray nook_neural_features;
uniform highp sampler2DArray nook_neural_offset_features;
uniform mat4 nook_neural_offset_in[(OFFSET_VEC4S + 1) * OFFSET_UNIT_VEC4S];
uniform vec4 nook_neural_offset_out[OFFSET_UNIT_VEC4S];
uniform float nook_neural_offset_level;
uniform mat4 nook_neural_position[(FEATURE_VEC4S + 1) * UNIT_VEC4S];
uniform mat3x4 nook_neural_light[2 * UNIT_VEC4S];
uniform mat4 nook_neural_hidden[(LAYERS - 1) * UNIT_VEC4S * UNIT_VEC4S];
uniform vec4 nook_neural_hidden_bias[(LAYERS - 1) * UNIT_VEC4S];
uniform vec4 nook_neural_out[3 * UNIT_VEC4S];
uniform vec3 nook_neural_out_bias;
uniform float nook_neural_widest_view_z;

vec4 nook_neural_rectified(vec4 sum) { return max(sum, 0.01 * sum); }

// The height, in tiles, at which the features of a view are read.
float nook_neural_height(vec2 uv, vec2 dx, vec2 dy, vec3 view) {
  vec4 units[OFFSET_UNIT_VEC4S];
  for (int u = 0; u < OFFSET_UNIT_VEC4S; ++u) units[u] = nook_neural_offset_in[u] * vec4(view, 1.0);
  for (int i = 0; i < OFFSET_VEC4S; ++i) {
    vec4 feature = 2.0 * vec4(textureGrad(nook_neural_offset_features, vec3(uv, float(2 * i)), dx, dy).xy,
                              textureGrad(nook_neural_offset_features, vec3(uv, float(2 * i + 1)), dx, dy).xy) - 1.0;
    for (int u = 0; u < OFFSET_UNIT_VEC4S; ++u)
      units[u] += nook_neural_offset_in[(i + 1) * OFFSET_UNIT_VEC4S + u] * feature;
  }
  float height = nook_neural_offset_level;
  for (int u = 0; u < OFFSET_UNIT_VEC4S; ++u) height += dot(nook_neural_offset_out[u], nook_neural_rectified(units[u]));
  return height;
}

// Returns the place of a direction on the square map of views, where equal areas are equal solid angles.
vec2 nook_neural_place(vec3 view) {
  float radius = min(sqrt(max(1.0 - view.z, 0.0) / (1.0 - nook_neural_widest_view_z)), 1.0);
  vec2 size = abs(view.xy);
  float wide = max(size.x, size.y), turn = 1.2732395 * atan(min(size.x, size.y) / max(wide, 1e-8));
  vec2 at = radius * (size.x > size.y ? vec2(1.0, turn) : vec2(turn, 1.0));
  return (0.5 + 0.5 * sign(view.xy) * at) * float(VIEW_SIDE - 1);
}

vec4 nook_neural_feature(int node, int i, vec2 uv, vec2 dx, vec2 dy) {
  float layer = float(node * 2 * FEATURE_VEC4S + 2 * i);
  return 2.0 * vec4(textureGrad(nook_neural_features, vec3(uv, layer), dx, dy).xy,
                    textureGrad(nook_neural_features, vec3(uv, layer + 1.0), dx, dy).xy) - 1.0;
}

// Sums the first layer for a pixel, without the light's inputs.
void nook_neural_decode(vec2 uv, vec2 dx, vec2 dy, vec3 view, out vec4 units[UNIT_VEC4S]) {
  uv += view.xy / view.z * nook_neural_height(uv, dx, dy, view);
  for (int u = 0; u < UNIT_VEC4S; ++u) units[u] = nook_neural_position[u] * vec4(view, 1.0);
#if VIEW_SIDE > 1
  vec2 place = nook_neural_place(view), low = min(floor(place), float(VIEW_SIDE - 2)), at = place - low;
  int node = int(low.x) * VIEW_SIDE + int(low.y);
#endif
  for (int i = 0; i < FEATURE_VEC4S; ++i) {
#if VIEW_SIDE > 1
    vec4 feature = mix(mix(nook_neural_feature(node, i, uv, dx, dy),
                           nook_neural_feature(node + 1, i, uv, dx, dy), at.y),
                       mix(nook_neural_feature(node + VIEW_SIDE, i, uv, dx, dy),
                           nook_neural_feature(node + VIEW_SIDE + 1, i, uv, dx, dy), at.y), at.x);
#else
    vec4 feature = nook_neural_feature(0, i, uv, dx, dy);
#endif
    for (int u = 0; u < UNIT_VEC4S; ++u) units[u] += nook_neural_position[(i + 1) * UNIT_VEC4S + u] * feature;
  }
}

vec3 nook_neural_radiance(vec4 decoded[UNIT_VEC4S], vec3 view, vec3 light) {
  vec3 halfway = normalize(view + light);
  vec4 units[UNIT_VEC4S];
  for (int u = 0; u < UNIT_VEC4S; ++u)
    units[u] = nook_neural_rectified(decoded[u] + nook_neural_light[u] * light +
                                     nook_neural_light[UNIT_VEC4S + u] * halfway);
  for (int l = 0; l < LAYERS - 1; ++l) {
    vec4 next[UNIT_VEC4S];
    for (int u = 0; u < UNIT_VEC4S; ++u) next[u] = nook_neural_hidden_bias[l * UNIT_VEC4S + u];
    for (int i = 0; i < UNIT_VEC4S; ++i)
      for (int u = 0; u < UNIT_VEC4S; ++u)
        next[u] += nook_neural_hidden[(l * UNIT_VEC4S + i) * UNIT_VEC4S + u] * units[i];
    for (int u = 0; u < UNIT_VEC4S; ++u) units[u] = nook_neural_rectified(next[u]);
  }
  vec3 radiance = nook_neural_out_bias;
  for (int u = 0; u < UNIT_VEC4S; ++u)
    radiance += vec3(dot(nook_neural_out[3 * u], units[u]), dot(nook_neural_out[3 * u + 1], units[u]),
                     dot(nook_neural_out[3 * u + 2], units[u]));
  return max(radiance, 0.0);
}
)";

constexpr char one_light[] = R"(in vec2 uv;
in vec3 view;
in vec3 light;
out vec4 colour;
void main() {
  vec4 units[UNIT_VEC4S];
  nook_neural_decode(uv, dFdx(uv), dFdy(uv), view, units);
  colour = vec4(nook_neural_radiance(units, view, light), 1.0);
}
)";

constexpr char ten_lights[] = R"(in vec2 uv;
in vec3 view;
uniform vec3 lights[10];
uniform vec3 colours[10];
out vec4 colour;
void main() {
  vec4 units[UNIT_VEC4S];
  nook_neural_decode(uv, dFdx(uv), dFdy(uv), view, units);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 10; ++i) sum += colours[i] * nook_neural_radiance(units, view, lights[i]);
  colour = vec4(sum, 1.0);
}
)";

constexpr int layers = 3;

// With 22 channels, the material `weave` in docs/lab/materials.md takes as many bytes as with K-CTA. Here,
// the number is rounded up to whole vectors.
std::string defines() {
  constexpr int channels = 24, view_side = 7, units = 32, offset_channels = 8, offset_units = 16;
  std::string text;
  for (const auto& [name, value] : {std::pair("FEATURE_VEC4S", channels / 4),
                                    {"VIEW_SIDE", view_side},
                                    {"UNIT_VEC4S", units / 4},
                                    {"LAYERS", layers},
                                    {"OFFSET_VEC4S", offset_channels / 4},
                                    {"OFFSET_UNIT_VEC4S", offset_units / 4}})
    text += std::string("#define ") + name + " " + std::to_string(value) + "\n";
  return text;
}

// Returns the library's declarations before shaders/material/neural/host.glsl, for the sizes of a default
// bake. The weights are chosen so that the compiler cannot remove any of them.
std::string declarations() {
  material::MaterialTables tables;
  material::NeuralTables& neural = tables.neural;
  neural.shape.width = neural.shape.height = 64;
  neural.lowest_view_z = neural.lowest_light_z = 0.25f;
  neural.weights.resize(material::NeuralLayout(neural.shape).count);
  for (std::size_t i = 0; i < neural.weights.size(); ++i)
    neural.weights[i] = 0.3f + 0.001f * float(i * 7919 % 1009);
  return material_declarations(tables, "material/neural/host.glsl");
}

constexpr char library_one_light[] = R"(#include "shaders/material/neural/host.glsl"
in vec2 uv;
in vec3 view;
in vec3 light;
out vec4 colour;
void main() {
  vec4 modes[NOOK_LIGHT_VEC4_COUNT];
#ifdef TWO_FETCHES
  nook_material_decode_anisotropic(uv, dFdx(uv), dFdy(uv), view, 2, modes);
#else
  nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);
#endif
  colour = vec4(nook_material_radiance(modes, light), 1.0);
}
)";

constexpr char library_ten_lights[] = R"(#include "shaders/material/neural/host.glsl"
in vec2 uv;
in vec3 view;
uniform vec3 lights[10];
uniform vec3 colours[10];
out vec4 colour;
void main() {
  vec4 modes[NOOK_LIGHT_VEC4_COUNT];
  nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 10; ++i) sum += colours[i] * nook_material_radiance(modes, lights[i]);
  colour = vec4(sum, 1.0);
}
)";

}  // namespace

std::vector<ShaderCase> neural_shaders() {
  const Loop hidden{"hidden layers after the first", layers - 1, {}};
  const std::string library = declarations(), nodes = defines() + decode, name = "neural material, ",
                    lights = ", four lights and a probe";
  ShaderCase along =
      host_shader(library + two_fetches + library_one_light, name + "small, two fetches", {hidden});
  along.other_families = {{"vega10", {{"places", 2, {}}, hidden}}};
  return {host_shader(library + library_one_light, name + "small", {hidden}), along,
          host_shader(library + library_ten_lights, name + "small" + lights, {{"lights", 10, {hidden}}}),
          host_shader(nodes + one_light, name + "equal bytes", {hidden}),
          host_shader(nodes + ten_lights, name + "equal bytes" + lights, {{"lights", 10, {hidden}}})};
}

}  // namespace nook::lab
