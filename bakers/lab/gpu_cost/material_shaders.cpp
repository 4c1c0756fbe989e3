#include <nook/nook_material.h>
#include <optional>
#include <string_view>

#include "bakers/lab/gpu_cost/shader_cases.h"
#include "sdk/src/gl/embedded_shaders.h"

namespace nook::lab {

std::string material_declarations(const material::MaterialTables& tables, std::string_view host) {
  constexpr std::uint32_t max_layers = 2048;  // the number of texture array layers that OpenGL 4.5 guarantees
  const String source = gl::material_source(tables, max_layers, default_memory());
  std::string_view text(source.data(), source.size());
  for (const gl::EmbeddedShader* shader = gl::embedded_shaders_begin(); shader != gl::embedded_shaders_end();
       ++shader)
    if (std::string_view(shader->path) == host) text.remove_suffix(std::string_view(shader->text).size());
  return std::string(text);
}

namespace {

// Number of cells along each side of the view maps that a bake with K-CTA makes.
constexpr std::uint32_t file_map_side = 64;

struct Size {
  const char* name;
  std::uint32_t light_modes, view_vec4s, clusters, terms, texels;
  std::uint32_t votf_view_vec4s, votf_clusters, votf_terms;
  // The decoding loop, if the compiler does not unroll it. loop_on_vega10 is set if vega10 has another loop.
  std::optional<Loop> loop, loop_on_vega10;
  bool has_relief = false;
  // Number of light modes in compressed texture blocks; if not 0, the VOTF is compressed too.
  std::uint32_t packed_modes = 0;
};
// fiber and roughhole have the paper's ranks (docs/lab/material_decoding.md).
const Size sizes[] = {
    {"fiber, N-SVD", 16, 20, 1, 1, 96, 20, 1, 1, {}, Loop{"view vectors", 20, {}}},
    {"fiber, K-CTA, K = 3", 16, 1, 20, 3, 96, 1, 20, 3, {}, {}},
    {"fiber, K-CTA, K = 3, in blocks", 16, 1, 20, 3, 96, 1, 20, 3, {}, Loop{"terms", 3, {}}, false, 12},
    {"roughhole, N-SVD", 28, 11, 1, 1, 96, 11, 1, 1, {}, Loop{"view vectors", 11, {}}},
    {"roughhole, K-CTA, K = 3", 28, 1, 11, 3, 96, 1, 11, 3, Loop{"terms", 3, {}}, Loop{"terms", 3, {}}},
    {"weave, K-CTA, K = 3", 20, 1, 10, 3, 48, 1, 10, 3, {}, Loop{"terms", 3, {}}},
    {"weave on a relief", 20, 1, 10, 3, 48, 1, 10, 3, {}, Loop{"terms", 3, {}}, true}};

constexpr std::uint32_t relief_steps = 8;

// Returns the loops of a size. The decoding loop exists only if the compiler does not unroll it. The loop of
// the relief march always exists.
std::vector<Loop> loops_of(const Size& size, const std::optional<Loop>& decoding) {
  std::vector<Loop> loops;
  if (size.has_relief) loops.push_back({"planes", double(relief_steps), {}});
  if (decoding) loops.push_back(*decoding);
  return loops;
}

// With two fetches, each term has twice as many instructions, so no GPU family unrolls the loop.
std::vector<Loop> loops_of_two_fetches(const Size& size) {
  std::vector<Loop> loops;
  if (size.has_relief) loops.push_back({"places", 2, {{"planes", double(relief_steps), {}}}});
  loops.push_back({"terms", double(size.terms), {}});
  return loops;
}

void set_tensor(material::TensorTables& t, std::uint32_t texels, std::uint32_t light_modes,
                std::uint32_t view_vec4s, std::uint32_t clusters, std::uint32_t terms) {
  t.width = t.height = texels;
  t.light_modes = light_modes;
  t.view_vec4_count = view_vec4s;
  t.clusters = clusters;
  t.terms = terms;
  t.blended = clusters > 1;
  t.side = t.blended ? file_map_side : material::default_map_side;
}

// Returns the declarations that the library puts before shaders/material/host.glsl.
std::string declarations(const Size& size) {
  material::MaterialTables tables;
  set_tensor(tables.btf, size.texels, size.light_modes, size.view_vec4s, size.clusters, size.terms);
  set_tensor(tables.votf, size.texels, 1, size.votf_view_vec4s, size.votf_clusters, size.votf_terms);
  tables.btf.packed_modes = size.packed_modes;
  tables.votf.packed_modes = size.packed_modes ? 1 : 0;
  if (size.has_relief) {
    tables.relief.high = 0.1f;
    tables.relief.max_slope = 3.7f;
    tables.relief.steps = relief_steps;
  }
  return material_declarations(tables, "material/host.glsl");
}

constexpr char decode[] = R"(#include "shaders/material/host.glsl"
in vec2 uv;
in vec3 view;
in vec3 light;
out vec4 colour;
void main() {
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  vec4 modes[NOOK_LIGHT_VEC4_COUNT];
#ifdef TWO_FETCHES
  nook_material_decode_anisotropic(uv, dx, dy, view, 2, modes);
  float visibility = nook_material_visibility(nook_material_occlusion_anisotropic(uv, dx, dy, view, 2));
#else
  nook_material_decode(uv, dx, dy, view, modes);
  float visibility = nook_material_visibility(nook_material_occlusion(uv, dx, dy, view));
#endif
  colour = vec4(nook_material_radiance(modes, light), visibility);
}
)";

// This shader lights the material with ten lights. Four are real lights, and six are the lobes of a probe.
// Each lobe is treated as a light along the lobe's axis.
constexpr char ten_lights[] = R"(#include "shaders/material/host.glsl"
in vec2 uv;
in vec3 view;
uniform vec3 lights[10];
uniform vec3 colours[10];
out vec4 colour;
void main() {
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  vec4 modes[NOOK_LIGHT_VEC4_COUNT];
  nook_material_decode(uv, dx, dy, view, modes);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 10; ++i) sum += colours[i] * nook_material_radiance(modes, lights[i]);
  colour = vec4(sum, nook_material_visibility(nook_material_occlusion(uv, dx, dy, view)));
}
)";

// The same lighting with radiance transfer. The transfer vectors of the vertices are varyings, or they are
// fetched for each pixel.
constexpr char transferred[] = R"(#include "shaders/material/host.glsl"
#include "shaders/transfer/host.glsl"
in vec2 uv;
in vec3 view;
in vec3 normal;
in vec4 tangent;
in vec4 vectors_0;
in vec4 vectors_1;
in vec4 vectors_2;
in vec4 vectors_3;
in vec4 vectors_4;
in vec4 vectors_5;
in vec4 vectors_6;
in vec4 vectors_7;
in vec4 vectors_8;
in vec4 vectors_9;
in vec4 vectors_10;
in vec4 vectors_11;
out vec4 colour;
void main() {
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  vec4 modes[NOOK_LIGHT_VEC4_COUNT];
  nook_material_decode(uv, dx, dy, nook_transfer_tangent_space(normal, tangent, view), modes);
  vec4 vectors[12] = vec4[12](vectors_0, vectors_1, vectors_2, vectors_3, vectors_4, vectors_5, vectors_6, vectors_7,
                              vectors_8, vectors_9, vectors_10, vectors_11);
  colour = vec4(nook_transfer_radiance(modes, vectors), 1.0);
}
)";
constexpr char transferred_mix[] = R"(#include "shaders/material/host.glsl"
#include "shaders/transfer/host.glsl"
in vec2 uv;
in vec3 view;
in vec3 normal;
in vec4 tangent;
in vec3 weights;
in vec3 vertices;  // whole numbers
out vec4 colour;
void main() {
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  vec4 modes[NOOK_LIGHT_VEC4_COUNT], vectors[3 * NOOK_LIGHT_VEC4_COUNT];
  nook_material_decode(uv, dx, dy, nook_transfer_tangent_space(normal, tangent, view), modes);
  nook_transfer_mix(ivec3(vertices), weights, vectors);
  colour = vec4(nook_transfer_radiance(modes, vectors), 1.0);
}
)";

}  // namespace

std::vector<ShaderCase> material_shaders() {
  std::vector<ShaderCase> shaders;
  for (const Size& size : sizes) {
    const std::string name = std::string("material, ") + size.name;
    const auto add = [&](const char* main, const std::string& case_name, const std::vector<Loop>& after) {
      const auto loops = [&](const std::optional<Loop>& decoding) {
        std::vector<Loop> all = loops_of(size, decoding);
        all.insert(all.end(), after.begin(), after.end());
        return all;
      };
      shaders.push_back(host_shader(declarations(size) + main, case_name, loops(size.loop)));
      if (size.loop_on_vega10) shaders.back().other_families = {{"vega10", loops(size.loop_on_vega10)}};
    };
    add(decode, name, {});
    if (size.packed_modes) continue;
    const bool is_k_cta = size.clusters > 1;
    if (is_k_cta)
      shaders.push_back(host_shader(declarations(size) + two_fetches + decode, name + ", two fetches",
                                    loops_of_two_fetches(size)));
    if (size.has_relief) continue;
    if (is_k_cta && size.light_modes <= 16) {
      add(transferred, std::string("radiance transfer, ") + size.name, {});
      add(transferred_mix, std::string("radiance transfer, vectors fetched, ") + size.name, {});
    }
    if (size.texels == 48) add(ten_lights, name + ", four lights and a probe", {{"lights", 10, {}}});
  }
  return shaders;
}

}  // namespace nook::lab
