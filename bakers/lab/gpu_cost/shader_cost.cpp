#include "bakers/lab/gpu_cost/shader_cost.h"

#include <stdexcept>

#include "bakers/lab/gpu_cost/shader_source.h"

namespace nook::lab {
namespace {

std::string located(const char* direction, std::size_t location, const StageVariable& variable) {
  return "layout(location = " + std::to_string(location) + ") " + (variable.flat ? "flat " : "") + direction +
         " " + variable.type + " ";
}

// Returns a vertex shader that passes its attributes to the inputs of a fragment shader. If there are no
// inputs, the vertex shader draws a triangle that covers the screen.
std::string vertex_partner(const std::vector<StageVariable>& inputs) {
  std::string text = "#version 450\n", body;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::string number = std::to_string(i);
    StageVariable attribute = inputs[i];
    attribute.flat = false;
    text += located("in", i, attribute) + "a" + number + ";\n" + located("out", i, inputs[i]) + "v" + number +
            ";\n";
    body += "  v" + number + " = a" + number + ";\n";
  }
  return text + "void main() {\n" + body +
         "  vec2 corner = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);\n"
         "  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);\n}\n";
}

// Returns a fragment shader that reads all outputs of a vertex shader, including each array element, so that
// the compiler removes none of them.
std::string fragment_partner(const std::vector<StageVariable>& outputs) {
  std::string text = "#version 450\nlayout(location = 0) out vec4 colour;\n", body;
  std::size_t location = 0;
  for (const StageVariable& output : outputs)
    for (int element = 0; element < output.locations(); ++element, ++location) {
      std::string varying = "v";
      varying += std::to_string(location);
      text += located("in", location, output) + varying + ";\n";
      body += "  colour += vec4(" + (output.type == "vec3" ? varying : "vec3(" + varying + ")") + ", 1.0);\n";
    }
  return text + "void main() {\n  colour = vec4(0.0);\n" + body + "}\n";
}

}  // namespace

VulkanGlsl vulkan_glsl(const SourceTree& tree, const ShaderCase& shader) {
  const std::string text = shader.path.empty() ? shader.host : file_text(tree.root / shader.path);
  return to_vulkan_glsl(preprocess(shader.stage, with_version(shader.stage, tree.first_lines + shader.defines,
                                                              expand_includes(tree.root, text))));
}

CompiledShader compile_shader(NullDevice& device, const SourceTree& tree, const ShaderCase& shader) {
  const VulkanGlsl glsl = vulkan_glsl(tree, shader);
  const std::vector<std::uint32_t> spirv = compile_spirv(shader.stage, glsl.text, shader.name);
  if (shader.stage == Stage::compute) return device.compute(spirv, glsl.samplers);
  NullDevice::Draw draw;
  draw.samplers = glsl.samplers;
  draw.attributes = glsl.inputs;
  if (shader.stage == Stage::vertex) {
    draw.counts_vertex = true;
    draw.points = true;
    draw.vertex = spirv;
    draw.fragment =
        compile_spirv(Stage::fragment, fragment_partner(glsl.outputs), "the partner of " + shader.name);
    draw.targets = {{"vec4", "colour"}};
  } else {
    draw.fragment = spirv;
    draw.vertex = compile_spirv(Stage::vertex, vertex_partner(glsl.inputs), "the partner of " + shader.name);
    draw.targets = glsl.outputs;
  }
  return device.draw(draw);
}

ShaderCost shader_cost(NullDevice& device, const std::string& family, const SourceTree& tree,
                       const ShaderCase& shader) {
  ShaderCost cost;
  cost.shader = shader.name;
  try {
    const CompiledShader compiled = compile_shader(device, tree, shader);
    cost.counts = count_instructions(compiled.disassembly, shader.loops_of(family));
    cost.vector_registers = compiled.vector_registers;
    cost.scalar_registers = compiled.scalar_registers;
    cost.waves = compiled.waves;
    cost.code_bytes = compiled.code_bytes;
  } catch (const std::runtime_error& failure) {
    cost.error = failure.what();
  }
  return cost;
}

}  // namespace nook::lab
