#include "sdk/src/gl/material/neural_source.h"

#include "sdk/src/core/float_literal.h"
#include "sdk/src/gl/material/formatted_text.h"

namespace nook::gl {
namespace {

using material::NeuralLayout;
using material::NeuralShape;

// A block of a matrix: `inputs` columns of `outputs` rows, or a vector of a single column. Digits give each
// half float.
struct Block {
  const char* type;
  std::uint32_t inputs, outputs;
};

// Writes the blocks of a matrix of which all outputs of an input stand beside each other: those of the first
// inputs, then those of the next ones.
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

// Biases of all hidden layers behind the first, which stand behind the matrix of each.
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

}  // namespace

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

}  // namespace nook::gl
