#include "poison.h"

#include "gl/touched_state.h"

namespace nook::test {

struct Poison::Objects {
  GLuint buffers[4] = {};
  GLuint texture = 0, texture_2d = 0, sampler = 0, framebuffer = 0, renderbuffer = 0, vertex_array = 0,
         program = 0;
  GLuint feedback = 0;
};

namespace {

using Values = std::vector<std::int64_t>;

// Off by default; each would spoil a draw.
constexpr GLenum poisoned_capabilities[] = {GL_BLEND,          GL_SCISSOR_TEST, GL_CULL_FACE,
                                            GL_DEPTH_TEST,     GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB,
                                            GL_SAMPLE_COVERAGE};

Values integers(const GladGLContext& gl, GLenum name, int count = 1) {
  std::vector<GLint> values(16, 0);
  gl.GetIntegerv(name, values.data());
  return Values(values.begin(), values.begin() + count);
}

Values indexed(const GladGLContext& gl, GLenum binding, GLenum start, GLenum size, GLuint index) {
  GLint buffer = 0;
  GLint64 offset = 0, bytes = 0;
  gl.GetIntegeri_v(binding, index, &buffer);
  gl.GetInteger64i_v(start, index, &offset);
  gl.GetInteger64i_v(size, index, &bytes);
  return {buffer, offset, bytes};
}

// One reader for each item of the list: a new item does not compile until it has one here.
struct Readers {
  const GladGLContext& gl;
  bool feedback_objects() const { return gl.BindTransformFeedback != nullptr; }

  Values program() const { return integers(gl, GL_CURRENT_PROGRAM); }
  Values array_buffer() const { return integers(gl, GL_ARRAY_BUFFER_BINDING); }
  Values vertex_array() const { return integers(gl, GL_VERTEX_ARRAY_BINDING); }
  Values active_texture() const { return integers(gl, GL_ACTIVE_TEXTURE); }
  Values texture_unit_0() const {
    const Values active = integers(gl, GL_ACTIVE_TEXTURE);
    gl.ActiveTexture(GL_TEXTURE0);
    const Values bound = integers(gl, GL_TEXTURE_BINDING_BUFFER);
    gl.ActiveTexture(static_cast<GLenum>(active[0]));
    return bound;
  }
  Values draw_framebuffer() const { return integers(gl, GL_DRAW_FRAMEBUFFER_BINDING); }
  Values renderbuffer() const { return integers(gl, GL_RENDERBUFFER_BINDING); }
  Values rasterizer_discard() const { return {gl.IsEnabled(GL_RASTERIZER_DISCARD)}; }
  Values primitive_restart() const { return {gl.IsEnabled(GL_PRIMITIVE_RESTART)}; }
  Values transform_feedback() const {
    return feedback_objects() ? integers(gl, GL_TRANSFORM_FEEDBACK_BINDING) : Values{0};
  }
  Values feedback_buffer() const {
    Values values = integers(gl, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING);
    for (const std::int64_t v :
         indexed(gl, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, GL_TRANSFORM_FEEDBACK_BUFFER_START,
                 GL_TRANSFORM_FEEDBACK_BUFFER_SIZE, 0))
      values.push_back(v);
    return values;
  }
  Values storage_buffer() const { return integers(gl, GL_SHADER_STORAGE_BUFFER_BINDING); }
  Values storage_ranges() const {
    Values values;
    for (GLuint i = 0; i < gl::storage_binding_count; ++i)
      for (const std::int64_t v : indexed(gl, GL_SHADER_STORAGE_BUFFER_BINDING,
                                          GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE, i))
        values.push_back(v);
    return values;
  }
};

bool in_tier(unsigned tiers, int tier) {
  return tiers & (tier == 43 ? gl::tier_43 : gl::tier_33);
}

GLuint make_program(const GladGLContext& gl) {
  const GLuint shader = gl.CreateShader(GL_VERTEX_SHADER);
  const char* text = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, shader);
  gl.LinkProgram(program);
  gl.DeleteShader(shader);
  return program;
}

}  // namespace

Poison::Poison(platform::Context& context, int tier)
    : gl_(context.gl()), tier_(tier), objects_(std::make_unique<Objects>()) {
  const GladGLContext& gl = gl_;
  Objects& o = *objects_;
  gl.GenBuffers(4, o.buffers);
  for (const GLuint buffer : o.buffers) {
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl.BufferData(GL_ARRAY_BUFFER, 8192, nullptr, GL_STATIC_DRAW);
  }
  // Beside the list.
  gl.GenTextures(1, &o.texture_2d);
  gl.GenSamplers(1, &o.sampler);
  for (const GLenum unit : {GL_TEXTURE0, GL_TEXTURE3}) {
    gl.ActiveTexture(unit);
    gl.BindTexture(GL_TEXTURE_2D, o.texture_2d);
    gl.BindSampler(unit - GL_TEXTURE0, o.sampler);
  }
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, o.buffers[0]);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, o.buffers[1]);
  gl.BindBuffer(GL_COPY_READ_BUFFER, o.buffers[1]);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, o.buffers[2]);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, o.buffers[2]);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.PixelStorei(GL_UNPACK_SKIP_ROWS, 3);
  for (const GLenum capability : poisoned_capabilities) gl.Enable(capability);
  gl.ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
  gl.DepthMask(GL_FALSE);
  gl.Viewport(3, 4, 5, 6);
  gl.Scissor(1, 2, 0, 0);
  gl.PrimitiveRestartIndex(1);

  // The list.
  o.program = make_program(gl);
  gl.UseProgram(o.program);
  gl.GenVertexArrays(1, &o.vertex_array);
  gl.BindVertexArray(o.vertex_array);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, o.buffers[3]);
  gl.BindBuffer(GL_ARRAY_BUFFER, o.buffers[1]);
  gl.GenTextures(1, &o.texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_BUFFER, o.texture);
  gl.ActiveTexture(GL_TEXTURE5);
  gl.GenFramebuffers(1, &o.framebuffer);
  gl.GenRenderbuffers(1, &o.renderbuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, o.framebuffer);  // incomplete
  gl.BindRenderbuffer(GL_RENDERBUFFER, o.renderbuffer);
  gl.Enable(GL_PRIMITIVE_RESTART);
  gl.Enable(GL_RASTERIZER_DISCARD);
  if (gl.BindTransformFeedback) {
    gl.GenTransformFeedbacks(1, &o.feedback);
    gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, o.feedback);
  }
  gl.BindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, o.buffers[2], 16, 64);
  gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, o.buffers[3]);
  if (tier == 43) {
    for (GLuint i = 0; i < gl::storage_binding_count; i += 2)
      gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, o.buffers[i % 4], 256 * (i + 1), 512);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, o.buffers[2]);
    gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, o.buffers[0]);
  }
}

void Poison::reset_touched() {
  const GladGLContext& gl = gl_;
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_BUFFER, 0);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
  gl.Disable(GL_PRIMITIVE_RESTART);
  gl.Disable(GL_RASTERIZER_DISCARD);
  if (gl.BindTransformFeedback) gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
  gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
  gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, 0);
  if (tier_ == 43)
    for (GLuint i = 0; i < gl::storage_binding_count; ++i) gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, 0);
}

Poison::~Poison() {
  const GladGLContext& gl = gl_;
  Objects& o = *objects_;
  reset_touched();
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  for (const GLenum unit : {GL_TEXTURE0, GL_TEXTURE3}) {
    gl.ActiveTexture(unit);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.BindSampler(unit - GL_TEXTURE0, 0);
  }
  gl.ActiveTexture(GL_TEXTURE0);
  for (const GLenum target :
       {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_PACK_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER})
    gl.BindBuffer(target, 0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, 0);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl.PixelStorei(GL_UNPACK_SKIP_ROWS, 0);
  for (const GLenum capability : poisoned_capabilities) gl.Disable(capability);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.DepthMask(GL_TRUE);
  gl.PrimitiveRestartIndex(0);
  gl.DeleteBuffers(4, o.buffers);
  gl.DeleteTextures(1, &o.texture);
  gl.DeleteTextures(1, &o.texture_2d);
  gl.DeleteSamplers(1, &o.sampler);
  gl.DeleteFramebuffers(1, &o.framebuffer);
  gl.DeleteRenderbuffers(1, &o.renderbuffer);
  gl.DeleteVertexArrays(1, &o.vertex_array);
  gl.DeleteProgram(o.program);
  if (o.feedback) gl.DeleteTransformFeedbacks(1, &o.feedback);
}

StateValues Poison::touched() const {
  const Readers read{gl_};
  StateValues values;
#define NOOK_X(name, tiers, what, note) \
  if (in_tier(gl::tiers, tier_)) values[#name] = read.name();
  NOOK_GL_TOUCHED_STATE(NOOK_X)
#undef NOOK_X
  return values;
}

StateValues Poison::defaults() const {
  StateValues values = touched();
  for (auto& [name, numbers] : values)
    for (std::int64_t& number : numbers) number = name == "active_texture" ? GL_TEXTURE0 : 0;
  return values;
}

StateValues Poison::untouched() const {
  const GladGLContext& gl = gl_;
  StateValues values;
  const auto keep = [&](const char* name, Values numbers) { values[name] = std::move(numbers); };
#define NOOK_INTEGERS(name, count) keep(#name, integers(gl, name, count))
  NOOK_INTEGERS(GL_READ_FRAMEBUFFER_BINDING, 1);
  NOOK_INTEGERS(GL_VIEWPORT, 4);
  NOOK_INTEGERS(GL_SCISSOR_BOX, 4);
  NOOK_INTEGERS(GL_COLOR_WRITEMASK, 4);
  NOOK_INTEGERS(GL_DEPTH_WRITEMASK, 1);
  NOOK_INTEGERS(GL_BLEND, 1);
  NOOK_INTEGERS(GL_SCISSOR_TEST, 1);
  NOOK_INTEGERS(GL_CULL_FACE, 1);
  NOOK_INTEGERS(GL_DEPTH_TEST, 1);
  NOOK_INTEGERS(GL_STENCIL_TEST, 1);
  NOOK_INTEGERS(GL_FRAMEBUFFER_SRGB, 1);
  NOOK_INTEGERS(GL_SAMPLE_COVERAGE, 1);
  NOOK_INTEGERS(GL_POLYGON_MODE, 2);
  NOOK_INTEGERS(GL_PRIMITIVE_RESTART_INDEX, 1);
  NOOK_INTEGERS(GL_PIXEL_UNPACK_BUFFER_BINDING, 1);
  NOOK_INTEGERS(GL_PIXEL_PACK_BUFFER_BINDING, 1);
  NOOK_INTEGERS(GL_UNPACK_ALIGNMENT, 1);
  NOOK_INTEGERS(GL_UNPACK_SKIP_ROWS, 1);
  NOOK_INTEGERS(GL_UNIFORM_BUFFER_BINDING, 1);
  NOOK_INTEGERS(GL_COPY_READ_BUFFER, 1);
  NOOK_INTEGERS(GL_COPY_WRITE_BUFFER, 1);
#undef NOOK_INTEGERS
  const Values active = integers(gl, GL_ACTIVE_TEXTURE);
  for (GLenum unit = 0; unit < 16; ++unit) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    const std::string prefix = "unit " + std::to_string(unit) + " ";
    keep((prefix + "2D").c_str(), integers(gl, GL_TEXTURE_BINDING_2D));
    keep((prefix + "sampler").c_str(), integers(gl, GL_SAMPLER_BINDING));
    if (unit > 0) keep((prefix + "buffer").c_str(), integers(gl, GL_TEXTURE_BINDING_BUFFER));
  }
  gl.ActiveTexture(static_cast<GLenum>(active[0]));
  // Its element buffer belongs to the host's vertex array, whatever is bound now.
  const Values vertex_array = integers(gl, GL_VERTEX_ARRAY_BINDING);
  gl.BindVertexArray(objects_->vertex_array);
  keep("element buffer of the host's vertex array", integers(gl, GL_ELEMENT_ARRAY_BUFFER_BINDING));
  gl.BindVertexArray(static_cast<GLuint>(vertex_array[0]));
  return values;
}

}  // namespace nook::test
