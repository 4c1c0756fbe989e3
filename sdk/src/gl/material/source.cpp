#include "sdk/src/gl/material/source.h"

#include <algorithm>
#include <string_view>

#include "sdk/src/core/float_literal.h"
#include "sdk/src/gl/embedded_shaders.h"
#include "sdk/src/gl/material/formatted_text.h"
#include "sdk/src/gl/material/neural_source.h"
#include "sdk/src/material/footprint.h"

namespace nook::gl {
namespace {

// Writes the fetch of a layer from the arrays of `most` layers each that it may be in.
template <class Fetch>
void add_choice(String& out, std::uint32_t arrays, std::uint32_t most, Fetch&& fetch) {
  for (std::uint32_t i = 0; i < arrays; ++i) {
    if (i + 1 < arrays) add(out, "  if (layer < %u)\n  ", (i + 1) * most);
    fetch(i, i * most);
  }
}

// The samplers of spatial modes, and the function that fetches four of them: `mode` counts those of a
// cluster, whole ones first.
void add_modes(String& out, const material::TensorTables& t, const char* name, std::uint32_t max_layers) {
  const std::uint32_t whole = t.whole_modes() * t.view_vec4_count,
                      packed = t.packed_modes * t.view_vec4_count;
  const std::uint32_t arrays = array_count(t, max_layers), block_arrays = block_array_count(t, max_layers);
  for (std::uint32_t i = 0; i < arrays; ++i)
    add(out, "uniform highp sampler2DArray nook_%s_spatial_%u;\n", name, i);
  for (std::uint32_t i = 0; i < block_arrays; ++i)
    add(out, "uniform highp sampler2DArray nook_%s_blocks_%u;\n", name, i);
  add(out, "vec4 nook_%s_mode(int cluster, int mode, vec2 uv, float level) {\n", name);
  if (whole > 0 && packed > 0) add(out, "  if (mode < %u) {\n", whole);
  if (whole > 0) {
    add(out, "  int layer = cluster * %u + mode;\n", whole);
    add_choice(out, arrays, max_layers, [&](std::uint32_t i, std::uint32_t first) {
      add(out, "  return textureLod(nook_%s_spatial_%u, vec3(uv, float(layer - %u)), level);\n", name, i,
          first);
    });
  }
  if (whole > 0 && packed > 0) out += "  }\n";
  if (packed > 0) {
    add(out, "  int layer = 2 * (cluster * %u + mode - %u);\n", packed, whole);
    add_choice(out, block_arrays, most_block_layers(max_layers), [&](std::uint32_t i, std::uint32_t first) {
      add(out, "  return vec4(textureLod(nook_%s_blocks_%u, vec3(uv, float(layer - %u)), level).rg,\n", name,
          i, first);
      add(out, "    textureLod(nook_%s_blocks_%u, vec3(uv, float(layer + 1 - %u)), level).rg);\n", name, i,
          first);
    });
  }
  out += "}\n";
}

const char* host_text(std::string_view path) {
  for (const EmbeddedShader* shader = embedded_shaders_begin(); shader != embedded_shaders_end(); ++shader)
    if (std::string_view(shader->path) == path) return shader->text;
  return "";
}

// Writes tensor/host.glsl with the names of one tensor.
void add_terms(String& out, std::string_view name, std::string_view capital_name) {
  std::string_view text = host_text("material/tensor/host.glsl");
  while (!text.empty()) {
    const std::size_t at = std::min(text.find("nook_tensor_"), text.find("NOOK_TENSOR_"));
    out += text.substr(0, at);
    if (at == text.npos) return;
    constexpr std::size_t head = 5, length = 11;  // of "nook_" and of "nook_tensor"
    out += text.substr(at, head);
    out += text[at] == 'n' ? name : capital_name;
    text.remove_prefix(at + length);
  }
}

// name is "btf" and prefix "NOOK_BTF", or the same of the VOTF.
void add_tensor(String& out, const material::TensorTables& t, const char* name, const char* prefix,
                std::uint32_t max_layers) {
  add(out, "#define %s_TERMS %u\n#define %s_VIEW_VEC4_COUNT %u\n", prefix, t.terms, prefix,
      t.view_vec4_count);
  add(out, "#define %s_CLUSTERS %u\n#define %s_SIDE %u\n", prefix, t.clusters, prefix, t.side);
  add(out, "#define %s_BLENDED %u\n", prefix, std::uint32_t(t.blended));
  if (t.terms == 0) return;
  add(out, "#define %s_TEXELS vec2(%u.0, %u.0)\n", prefix, t.width, t.height);
  add(out, "uniform highp sampler2DArray nook_%s_coefficients;\n", name);
  if (t.has_membership()) add(out, "uniform highp usampler2DArray nook_%s_membership;\n", name);
  add_modes(out, t, name, max_layers);
}

void add_relief(String& out, const material::ReliefTables& relief) {
  add(out, "#define NOOK_RELIEF %d\n", int(relief.moves()));
  if (!relief.moves()) return;
  add(out, "#define NOOK_RELIEF_STEPS %u\n", relief.steps);
  add(out, "const float nook_relief_low = %s, nook_relief_high = %s, nook_relief_max_slope = %s;\n",
      float_literal(relief.low).text, float_literal(relief.high).text, float_literal(relief.max_slope).text);
  if (relief.steps > 0) out += "uniform highp sampler2DArray nook_relief_heights;\n";
}

}  // namespace

String material_source(const material::MaterialTables& tables, std::uint32_t max_layers, Memory* memory) {
  String out(memory);
  const bool is_neural = tables.neural.is_used();
  if (is_neural) {
    add_neural_declarations(tables.neural, out);
  } else {
    add(out, "#define NOOK_LIGHT_VEC4_COUNT %u\nuniform highp sampler2DArray nook_light_map;\n",
        tables.btf.light_modes / 4);
    add_tensor(out, tables.btf, "btf", "NOOK_BTF", max_layers);
  }
  add_tensor(out, tables.votf, "votf", "NOOK_VOTF", max_layers);
  if (!is_neural) add_relief(out, tables.relief);
  add(out, "#define NOOK_MATERIAL_MAX_FETCHES %u\n", material::max_fetches);
  if (tables.votf.terms != 0)
    // OpenGL ES gives uniforms no first value.
    add(out, "#ifdef GL_ES\nconst\n#else\nuniform\n#endif\nvec2 nook_visibility_mapping = vec2(%s, %s);\n",
        float_literal(tables.mapping.threshold).text, float_literal(tables.mapping.weight).text);
  out += host_text("material/base/host.glsl");
  if (!is_neural) add_terms(out, "btf", "BTF");
  if (tables.votf.terms != 0) add_terms(out, "votf", "VOTF");
  out += host_text(is_neural ? "material/neural/host.glsl" : "material/host.glsl");
  return out;
}

}  // namespace nook::gl
