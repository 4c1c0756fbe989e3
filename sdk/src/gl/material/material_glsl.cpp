#include "sdk/src/gl/material/material_glsl.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <span>
#include <string_view>

#include "sdk/src/core/compiler.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/gl/embedded_shaders.h"
#include "sdk/src/material/footprint.h"

namespace nook::gl {
namespace {

using material::NeuralLayout;
using material::NeuralShape;

// Appends formatted text, as printf does. The result may have at most 199 characters.
void add(String& out, const char* format, ...) NOOK_PRINTF(2, 3);
void add(String& out, const char* format, ...) {
  char line[200];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out += line;
}

// A matrix is written in blocks with `inputs` columns and `outputs` rows. The blocks of a vector have a
// single column. Enough digits are written to represent each half float exactly.
struct Block {
  const char* type;
  std::uint32_t inputs, outputs;
};

// Writes the blocks of a matrix: first the blocks of the first inputs, then the blocks of the next inputs,
// and so on. In `matrix`, all outputs of an input are adjacent.
void add_blocks(const char* name, const Block& block, std::span<const float> matrix, std::uint32_t outputs,
                String& out) {
  const std::size_t size = std::size_t(block.inputs) * block.outputs, count = matrix.size() / size;
  add(out, "const %s nook_neural_%s[%zu] = %s[%zu](", block.type, name, count, block.type, count);
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t across = outputs / block.outputs;
    add(out, "%s\n%s(", b ? "," : "", block.type);
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t input = b / across * block.inputs + i / block.outputs,
                        output = b % across * block.outputs + i % block.outputs;
      add(out, "%s%s", i ? "," : "", float_literal(matrix[input * outputs + output]).text);
    }
    out += ")";
  }
  out += ");\n";
}

// Returns either the biases or the matrices of all hidden layers after the first. In the tables, each layer's
// biases follow its matrix.
Vector<float> hidden_numbers(const material::NeuralTables& tables, bool biases) {
  const NeuralShape& s = tables.shape;
  const NeuralLayout at(s);
  const std::size_t matrix = std::size_t(s.units) * s.units;
  Vector<float> numbers(tables.weights.get_allocator());
  for (std::size_t layer = 1; layer < s.layers; ++layer) {
    const auto first = tables.weights.begin() + std::ptrdiff_t(neural_hidden_layer(s, at, layer)),
               middle = first + std::ptrdiff_t(matrix), last = middle + std::ptrdiff_t(s.units);
    numbers.insert(numbers.end(), biases ? middle : first, biases ? last : middle);
  }
  return numbers;
}

// Writes the declarations of a neural material, which must precede shaders/material/neural/host.glsl: sizes,
// weights as constants, and the sampler of the features.
void add_neural_declarations(const material::NeuralTables& tables, String& out) {
  const NeuralShape& s = tables.shape;
  const NeuralLayout at(s);
  add(out, "#define NOOK_LIGHT_VEC4_COUNT %u\n#define NOOK_BTF_TEXELS vec2(%u.0, %u.0)\n",
      tables.decoded_count() / 4, s.width, s.height);
  add(out, "#define NOOK_NEURAL_FEATURE_VEC4S %u\n#define NOOK_NEURAL_UNIT_VEC4S %u\n", s.channels / 4,
      s.units / 4);
  add(out, "#define NOOK_NEURAL_OFFSET_VEC4S %u\n#define NOOK_NEURAL_OFFSET_UNIT_VEC4S %u\n",
      s.offset_channels / 4, s.offset_units / 4);
  add(out, "#define NOOK_NEURAL_LAYERS %u\nuniform highp sampler2DArray nook_neural_features;\n", s.layers);
  add(out, "const float nook_neural_lowest_view_z = %s, nook_neural_lowest_light_z = %s;\n",
      float_literal(tables.lowest_view_z).text, float_literal(tables.lowest_light_z).text);
  add(out, "const float nook_neural_offset_level = %s;\n",
      float_literal(tables.weights[at.offset_level]).text);
  add(out, "const float nook_neural_leak = %s, nook_neural_least_view_z = %s;\n",
      float_literal(material::neural_leak).text, float_literal(material::neural_least_view_z).text);
  const std::span<const float> all(tables.weights);
  const auto between = [&](std::size_t first, std::size_t last) { return all.subspan(first, last - first); };
  constexpr Block square{"mat4", 4, 4}, vector{"vec4", 1, 4};
  add_blocks("offset_in", square, between(at.offset_in, at.offset_out), s.offset_units, out);
  add_blocks("offset_out", vector, between(at.offset_out, at.offset_level), s.offset_units, out);
  add_blocks("position", square, between(at.position, at.light), s.units, out);
  add_blocks("light", {"mat3x4", 3, 4}, between(at.light, at.hidden), s.units, out);
  if (s.layers > 1) {
    add_blocks("hidden", square, hidden_numbers(tables, false), s.units, out);
    add_blocks("hidden_bias", vector, hidden_numbers(tables, true), s.units, out);
  }
  add_blocks("out", {"mat4x3", 4, 3}, between(at.out, at.out_bias), 3, out);
  const float* const bias = &tables.weights[at.out_bias];
  add(out, "const vec3 nook_neural_out_bias = vec3(%s, %s, %s);\n", float_literal(bias[0]).text,
      float_literal(bias[1]).text, float_literal(bias[2]).text);
}

// Writes the code that fetches a texel of a layer. The layers may be distributed over several texture arrays
// with `most` layers each.
template <class Fetch>
void add_choice(String& out, std::uint32_t arrays, std::uint32_t most, Fetch&& fetch) {
  for (std::uint32_t i = 0; i < arrays; ++i) {
    if (i + 1 < arrays) add(out, "  if (layer < %u)\n  ", (i + 1) * most);
    fetch(i, i * most);
  }
}

// Writes the samplers of the spatial modes, and the function that fetches four modes. In the generated
// function, the parameter `mode` is an index into the modes of a cluster. The modes that are not stored in
// blocks have the first indices.
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

// Writes tensor/host.glsl, with its placeholders replaced by the names of one tensor.
void add_terms(String& out, std::string_view name, std::string_view capital_name) {
  std::string_view text = host_text("material/tensor/host.glsl");
  while (!text.empty()) {
    const std::size_t at = std::min(text.find("nook_tensor_"), text.find("NOOK_TENSOR_"));
    out += text.substr(0, at);
    if (at == text.npos) return;
    constexpr std::size_t head = 5, length = 11;  // lengths of "nook_" and "nook_tensor"
    out += text.substr(at, head);
    out += text[at] == 'n' ? name : capital_name;
    text.remove_prefix(at + length);
  }
}

// `name` and `prefix` are "btf" and "NOOK_BTF", or the corresponding names for the VOTF.
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
    // OpenGL ES does not allow initial values for uniforms, so there the mapping is a constant.
    add(out, "#ifdef GL_ES\nconst\n#else\nuniform\n#endif\nvec2 nook_visibility_mapping = vec2(%s, %s);\n",
        float_literal(tables.mapping.threshold).text, float_literal(tables.mapping.weight).text);
  out += host_text("material/base/host.glsl");
  if (!is_neural) add_terms(out, "btf", "BTF");
  if (tables.votf.terms != 0) add_terms(out, "votf", "VOTF");
  out += host_text(is_neural ? "material/neural/host.glsl" : "material/host.glsl");
  return out;
}

}  // namespace nook::gl
