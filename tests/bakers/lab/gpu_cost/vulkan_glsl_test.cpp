#include "bakers/lab/gpu_cost/vulkan_glsl.h"

#include "bakers/lab/gpu_cost/shader_cost.h"
#include "bakers/lab/gpu_cost/shader_source.h"
#include "tests/catch.h"

using namespace nook::lab;

namespace {

const char* const fragment = R"(#version 330 core
struct Wave {
  vec3 uniform_direction;
};
uniform sampler2D first;
uniform vec4 frame[3];
uniform samplerBuffer second;
uniform vec2 mapping = vec2(1.0, 2.0);
uniform usampler2DArray third;
uniform int count;
in vec3 normal;
flat in int which;
out vec4 colour;
const float weights[2] = float[2](0.25, 0.75);
void main() {
  vec4 sum = texelFetch(first, ivec2(0), 0) + texelFetch(second, count) + vec4(texelFetch(third, ivec3(which), 0));
  for (int i = 0; i < 3; ++i) sum += frame[i] * mapping.x * weights[i & 1];
  colour = sum + vec4(normal, 0.0);
}
)";

std::string compact(std::string text) {
  std::erase(text, ' ');
  return text;
}

}  // namespace

TEST_CASE("default uniforms are the members of one block, in order") {
  const VulkanGlsl glsl = to_vulkan_glsl(fragment);
  CHECK(glsl.uniforms == std::vector<std::string>{"frame", "mapping", "count"});
  CHECK(glsl.text.find("  vec4 frame[ 3 ];\n  vec2 mapping;\n  int count;\n") != std::string::npos);
  CHECK(glsl.samplers == std::vector<std::string>{"sampler2D", "samplerBuffer", "usampler2DArray"});
  REQUIRE(glsl.inputs.size() == 2);
  CHECK(glsl.inputs[1].flat);
  REQUIRE(glsl.outputs.size() == 1);
  CHECK(!compile_spirv(Stage::fragment, glsl.text, "the test's shader").empty());
}

TEST_CASE("storage blocks keep their bindings, images get their set, and built-in names are Vulkan's") {
  const VulkanGlsl compute = to_vulkan_glsl(preprocess(Stage::compute, R"(#version 430 core
#define PLACE 5
layout(local_size_x = 64) in;
layout(std430, binding = PLACE) readonly buffer Source { float source[]; };
layout(r8, binding = 1) writeonly uniform image2D target;
layout(location = 3) uniform uint offset;
shared float tile[64];
void main() {
  tile[gl_LocalInvocationID.x] = source[gl_GlobalInvocationID.x + offset];
  barrier();
  imageStore(target, ivec2(gl_GlobalInvocationID.xy), vec4(tile[0]));
}
)"));
  CHECK(compact(compute.text).find("binding=5)readonlybufferSource") != std::string::npos);
  CHECK(compact(compute.text).find("set=3,r8,binding=1)") != std::string::npos);
  CHECK(compute.uniforms == std::vector<std::string>{"offset"});
  CHECK(!compile_spirv(Stage::compute, compute.text, "the test's shader").empty());

  const VulkanGlsl vertex = to_vulkan_glsl(
      "#version 330 core\nlayout(location = 0) in vec4 a;\nout float x;\n"
      "void main() { x = a.x + float(gl_VertexID + gl_InstanceID); gl_Position = a; }\n");
  CHECK(vertex.text.find("gl_VertexIndex + gl_InstanceIndex") != std::string::npos);
  CHECK(!compile_spirv(Stage::vertex, vertex.text, "the test's shader").empty());
}

TEST_CASE("an array of outputs takes a location for each element") {
  const VulkanGlsl vertex = to_vulkan_glsl(preprocess(Stage::vertex, R"(#version 330 core
#define SUMS 12
in vec4 light;
out vec4 sums[SUMS];
out float behind;
void main() {
  for (int i = 0; i < SUMS; ++i) sums[i] = float(i) * light;
  behind = light.x;
  gl_Position = light;
}
)"));
  REQUIRE(vertex.outputs.size() == 2);
  CHECK(vertex.outputs[0].locations() == 12);
  CHECK(vertex.outputs[1].locations() == 1);
  CHECK(compact(vertex.text).find("layout(location=12)outfloatbehind") != std::string::npos);
  CHECK(!compile_spirv(Stage::vertex, vertex.text, "the test's shader").empty());
}

TEST_CASE("a shader that does not compile is named with the compiler's words") {
  try {
    compile_spirv(Stage::fragment, "#version 450\nvoid main() { unknown(); }\n", "the faulty one");
    FAIL("it compiles");
  } catch (const std::runtime_error& error) {
    CHECK(std::string(error.what()).find("the faulty one") != std::string::npos);
    CHECK(std::string(error.what()).find("unknown") != std::string::npos);
  }
}

TEST_CASE("every shader of the tree is Vulkan GLSL that compiles") {
  const SourceTree tree{NOOK_SOURCE_ROOT, ""};
  for (const ShaderCase& shader : all_shaders()) {
    INFO(shader.name);
    CHECK(!compile_spirv(shader.stage, vulkan_glsl(tree, shader).text, shader.name).empty());
  }
}
