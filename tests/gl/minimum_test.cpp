// The programs of every tier and form compile and link, and stay within the minimum limits of OpenGL ES;
// and the bits of medium precision.
#include <cstdio>

#include "platform/program.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

// Minima of OpenGL ES 3.0: GL_MAX_FRAGMENT_UNIFORM_VECTORS, GL_MAX_TEXTURE_IMAGE_UNITS.
constexpr int least_uniform_vectors = 224, least_samplers = 16;
// Minimum of OpenGL ES 3.1: GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS.
constexpr int least_storage_blocks = 4;

struct Uses {
  int programs = 0, computes = 0, uniform_vectors = 0, samplers = 0, storage_blocks = 0;
};

bool is_sampler(GLint type) {
  for (const GLenum sampler : {GL_SAMPLER_2D, GL_UNSIGNED_INT_SAMPLER_2D, GL_SAMPLER_BUFFER,
                               GL_SAMPLER_2D_ARRAY, GL_UNSIGNED_INT_SAMPLER_2D_ARRAY})
    if (type == GLint(sampler)) return true;
  return false;
}

// The largest use of each limit by any living program. An element of a uniform takes one vector at most: the
// library has no matrices in uniforms.
Uses uses_of_programs(const platform::Context& context) {
  const GladGLContext& gl = context.gl();
  const bool has_storage = computes(tiers_of(context).front());
  Uses uses;
  for (GLuint program = 1; program < 20000; ++program) {
    if (!gl.IsProgram(program)) continue;
    ++uses.programs;
    GLint count = 0, linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    CHECK(linked == GL_TRUE);
    gl.GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    int vectors = 0, samplers = 0;
    for (GLuint i = 0; i < GLuint(count); ++i) {
      GLint size = 0, type = 0;
      gl.GetActiveUniformsiv(program, 1, &i, GL_UNIFORM_SIZE, &size);
      gl.GetActiveUniformsiv(program, 1, &i, GL_UNIFORM_TYPE, &type);
      (is_sampler(type) ? samplers : vectors) += size;
    }
    uses.uniform_vectors = std::max(uses.uniform_vectors, vectors);
    uses.samplers = std::max(uses.samplers, samplers);
    if (!has_storage) continue;
    GLint blocks = 0;
    gl.GetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &blocks);
    uses.computes += blocks > 0;
    uses.storage_blocks = std::max(uses.storage_blocks, int(blocks));
  }
  return uses;
}

}  // namespace

TEST_CASE("every program of every tier and form links within the minimum limits of OpenGL ES") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast;
  Trace trace(context);
  trace.limits[GL_MAX_TEXTURE_SIZE] = 2048;
  trace.limits[GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS] = least_storage_blocks;
  trace.limits[GL_MAX_SHADER_STORAGE_BLOCK_SIZE] = 1 << 24;
  trace.limits[GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT] = 256;
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    Crowd crowd(cast.context.handle, cast.models, cast.bone_counts, {});
    const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
    NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, crowd.ids[1], &lobe, 1));
    nook_gl gl = create_gl(cast.context.handle, Trace::loader, &trace, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(difference_to_cpu(gl, crowd, cast.model_of(0), 0) < promised_difference);
    GLuint buffer = 0;
    context.gl().GenBuffers(1, &buffer);
    context.gl().BindBuffer(GL_ARRAY_BUFFER, buffer);
    context.gl().BufferData(GL_ARRAY_BUFFER, 1 << 20, nullptr, GL_STATIC_DRAW);
    for (const nook_format format : {NOOK_FORMAT_FLOAT, NOOK_FORMAT_HALF, NOOK_FORMAT_UNORM8})
      for (const std::uint32_t stride : {0u, 36u}) {
        if (stride && !computes(tier)) continue;
        nook_gl_ao_target target{};
        target.struct_size = sizeof target;
        target.buffer = buffer;
        target.format = format;
        target.stride = stride;
        NOOK_OK_OR_FAIL(nook_gl_scene_write(gl, crowd.scene, crowd.ids.data(), 1, &target));
      }
    std::vector<nook_nnao> passes;
    for (const nnao::NetworkForm form : {nnao::NetworkForm::horizon, nnao::NetworkForm::paper})
      for (const int half : {0, 1})
        for (const nook_nnao_path path : {NOOK_NNAO_PATH_FRAGMENT, NOOK_NNAO_PATH_COMPUTE}) {
          if (path == NOOK_NNAO_PATH_COMPUTE && !computes(tier)) continue;
          PassDesc desc = pass_desc(64, 64);
          desc.half_resolution = half;
          desc.debug.path = path;
          passes.push_back(create_pass(gl, desc, mild_network(form)));
        }
    const Uses uses = uses_of_programs(context);
    std::printf(
        "tier %d: %d programs, at most %d uniform vectors of %d, %d samplers of %d, %d storage blocks of "
        "%d\n",
        tier, uses.programs, uses.uniform_vectors, least_uniform_vectors, uses.samplers, least_samplers,
        uses.storage_blocks, least_storage_blocks);
    CHECK(uses.programs >= (computes(tier) ? 40 : 23));
    CHECK(uses.uniform_vectors <= least_uniform_vectors);
    CHECK(uses.samplers <= least_samplers);
    CHECK(uses.storage_blocks <= least_storage_blocks);
    if (computes(tier)) CHECK(uses.computes > 5);
    for (nook_nnao& pass : passes) nook_nnao_destroy(&pass);
    context.gl().DeleteBuffers(1, &buffer);
    nook_gl_destroy(&gl);
    CHECK(context.gl().GetError() == GL_NO_ERROR);
    for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
  }
}

TEST_CASE("high precision means 32-bit floats; the bits of medium precision are printed") {
  NOOK_NEED_CONTEXT(context);
  const GladGLContext& gl = context.gl();
  Textures textures(gl);
  const GLuint answer = textures.floats(GL_RGBA32F, 4, 1, 1, {});
  const float third = 1.0f / 3;
  GLuint framebuffer = 0, array = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &array);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, answer, 0);
  gl.Viewport(0, 0, 1, 1);
  // Uniforms, so that no compiler computes the answer. Halved again and again, a number of 16 bits is 0 after
  // 25 steps at most, one of 32 bits after 127 or more.
  const char* const text =
      "uniform mediump float medium_one; uniform highp float high_one, high_third;\n"
      "out highp vec4 answer;\n"
      "void main() {\n"
      "  mediump float m = medium_one; highp float h = high_one * high_third, steps = 0.0;\n"
      "  for (int i = 0; i < 100; ++i) {\n"
      "    m *= 0.5;\n"
      "    if (m > 0.0) steps += 1.0; else break;\n"
      "  }\n"
      "  answer = vec4(steps, h, 0.0, 1.0);\n"
      "}\n";
  {
    const platform::Program program(
        gl,
        {glsl_header(gl),
         "void main() { gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0); "
         "}\n"},
        {glsl_header(gl), text});
    program.use();
    for (const char* name : {"medium_one", "high_one"}) gl.Uniform1f(program.uniform(name), 1);
    gl.Uniform1f(program.uniform("high_third"), third);
    gl.BindVertexArray(array);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.UseProgram(0);
    gl.BindVertexArray(0);
  }
  const std::vector<float> found = read_texture(gl, answer, 1, 1, 2);
  std::printf("a number of medium precision has %s bits here (0 after %g halvings)\n",
              found[0] < 100 ? "16" : "32", double(found[0]) + 1);
  CHECK(found[1] == third);
  CHECK(found[0] >= 14);  // OpenGL ES promises a range down to 2 to the power of -14
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteVertexArrays(1, &array);
}
