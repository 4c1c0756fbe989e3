#include "tests/gl/poison.h"

#include <iterator>
#include <span>

#include "platform/program.h"
#include "sdk/src/gl/state_guard.h"
#include "tests/gl/test_context.h"

namespace nook::test {

struct Poison::Objects {
  GLuint buffers[4] = {};
  GLuint texture = 0, other_texture = 0, texture_2d = 0, texture_array = 0, volume = 0, cube = 0,
         sample_texture = 0, sample_array = 0, sampler = 0, framebuffer = 0, renderbuffer = 0,
         vertex_array = 0, program = 0;
  GLuint feedback = 0;
};

namespace {

using Values = std::vector<std::int64_t>;

// Some that the screen-space pass uses, some that nobody does.
constexpr GLenum odd_units[] = {GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE2, GL_TEXTURE3, GL_TEXTURE7};

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

// The part of the state that the context has: OpenGL ES lacks some, and sets others by other functions.
struct Has {
  explicit Has(const GladGLContext& gl)
      : desktop(!is_es(gl)),
        version(
            static_cast<int>(10 * integers(gl, GL_MAJOR_VERSION)[0] + integers(gl, GL_MINOR_VERSION)[0])) {}
  bool from(int desktop_version, int es_version) const {
    return version >= (desktop ? desktop_version : es_version);
  }
  bool images() const { return from(42, 31); }
  bool storage() const { return from(43, 31); }
  bool sample_textures() const { return from(32, 31); }
  bool sample_arrays() const { return from(32, 32); }
  bool indexed_draw_buffers() const { return from(33, 32); }
  bool query_buffers() const { return desktop && version >= 44; }
  bool clip_control(const GladGLContext& gl) const { return desktop && gl.ClipControl; }

  bool desktop;
  int version;
};

std::span<const GLenum> fragment_tests_of(const Has& has) {
  const std::size_t count = has.desktop ? gl::fragment_test_count : has.version >= 31 ? 6 : 5;
  return std::span(gl::fragment_tests).first(count);
}
std::span<const GLenum> pixel_store_of(const Has& has) {
  return std::span(gl::pixel_store_names).first(std::size(gl::pixel_store_names) - (has.desktop ? 0 : 2));
}

std::span<const GLenum> pixel_pack_of(const Has& has) {
  return std::span(gl::pixel_pack_names).first(std::size(gl::pixel_pack_names) - (has.desktop ? 0 : 1));
}

void unbind_image(const GladGLContext& gl, const Has& has, GLuint unit) {
  gl.BindImageTexture(unit, 0, 0, GL_FALSE, 0, GL_READ_ONLY, has.desktop ? GL_R8 : GL_R32UI);
}

// One reader for each item of the list: a new item does not compile until it has one here.
struct Readers {
  const GladGLContext& gl;
  const Has has{gl};
  bool feedback_objects() const { return gl.BindTransformFeedback != nullptr; }

  Values program() const { return integers(gl, GL_CURRENT_PROGRAM); }
  Values array_buffer() const { return integers(gl, GL_ARRAY_BUFFER_BINDING); }
  Values vertex_array() const { return integers(gl, GL_VERTEX_ARRAY_BINDING); }
  Values active_texture() const { return integers(gl, GL_ACTIVE_TEXTURE); }
  Values of_unit(GLuint unit, GLenum binding) const {
    const Values active = integers(gl, GL_ACTIVE_TEXTURE);
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    const Values bound = integers(gl, binding);
    gl.ActiveTexture(static_cast<GLenum>(active[0]));
    return bound;
  }
  Values of_units(GLenum binding) const {
    Values values;
    for (GLuint unit = 0; unit < gl::texture_unit_count; ++unit) values.push_back(of_unit(unit, binding)[0]);
    return values;
  }
  Values texture_unit_0() const {
    return of_unit(0, has.desktop ? GL_TEXTURE_BINDING_BUFFER : GL_TEXTURE_BINDING_2D);
  }
  Values texture_2d() const { return of_units(GL_TEXTURE_BINDING_2D); }
  Values samplers() const { return of_units(GL_SAMPLER_BINDING); }
  Values filter_texture() const {
    return has.desktop ? of_unit(gl::filter_unit, GL_TEXTURE_BINDING_BUFFER) : Values{0};
  }
  Values texture_2d_array() const { return of_unit(0, GL_TEXTURE_BINDING_2D_ARRAY); }
  Values texture_3d() const { return of_unit(0, GL_TEXTURE_BINDING_3D); }
  Values cube_map() const { return of_unit(gl::cube_map_unit, GL_TEXTURE_BINDING_CUBE_MAP); }
  Values capture_samplers() const {
    return {of_unit(0, GL_SAMPLER_BINDING)[0], of_unit(1, GL_SAMPLER_BINDING)[0]};
  }
  Values layer_textures() const {
    Values values;
    for (const int unit : gl::layer_units)
      values.push_back(of_unit(GLuint(unit), GL_TEXTURE_BINDING_2D_ARRAY)[0]);
    return values;
  }
  Values sample_texture() const {
    return has.sample_textures() ? of_unit(gl::host_depth_unit, GL_TEXTURE_BINDING_2D_MULTISAMPLE)
                                 : Values{0};
  }
  Values sample_array() const {
    return has.sample_arrays() ? of_unit(gl::host_depth_unit, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY)
                               : Values{0};
  }
  Values image_unit() const { return image_unit_of(gl::image_unit_index); }
  Values image_unit_of(GLuint unit) const {
    Values values;
    for (const GLenum name : {GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL, GL_IMAGE_BINDING_LAYERED,
                              GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT}) {
      GLint value = 0;
      if (has.images()) gl.GetIntegeri_v(name, unit, &value);
      values.push_back(value);
    }
    return values;
  }
  Values pixel_store() const {
    Values values;
    for (const GLenum name : pixel_store_of(has)) values.push_back(integers(gl, name)[0]);
    return values;
  }
  Values pixel_pack() const {
    Values values;
    for (const GLenum name : pixel_pack_of(has)) values.push_back(integers(gl, name)[0]);
    return values;
  }
  Values pixel_pack_buffer() const { return integers(gl, GL_PIXEL_PACK_BUFFER_BINDING); }
  Values read_framebuffer() const { return integers(gl, GL_READ_FRAMEBUFFER_BINDING); }
  Values pixel_unpack_buffer() const { return integers(gl, GL_PIXEL_UNPACK_BUFFER_BINDING); }
  Values viewport() const { return integers(gl, GL_VIEWPORT, 4); }
  Values blend() const {
    Values values{has.indexed_draw_buffers() ? gl.IsEnabledi(GL_BLEND, 0) : gl.IsEnabled(GL_BLEND)};
    for (const GLenum name : {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA,
                              GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA})
      values.push_back(integers(gl, name)[0]);
    return values;
  }
  Values color_mask() const { return color_mask_of(0); }
  Values color_mask_of(GLuint buffer) const {
    GLboolean mask[4] = {};
    if (has.indexed_draw_buffers())
      gl.GetBooleani_v(GL_COLOR_WRITEMASK, buffer, mask);
    else
      gl.GetBooleanv(GL_COLOR_WRITEMASK, mask);
    return {mask[0], mask[1], mask[2], mask[3]};
  }
  Values polygon_mode() const { return has.desktop ? integers(gl, GL_POLYGON_MODE) : Values{GL_FILL}; }
  Values scissor_test() const { return {gl.IsEnabled(GL_SCISSOR_TEST)}; }
  Values framebuffer_srgb() const { return {has.desktop && gl.IsEnabled(GL_FRAMEBUFFER_SRGB)}; }
  Values fragment_tests() const {
    Values values;
    for (const GLenum test : fragment_tests_of(has)) values.push_back(gl.IsEnabled(test));
    return values;
  }
  Values dither() const { return {gl.IsEnabled(GL_DITHER)}; }
  Values query_buffer() const {
    return has.query_buffers() ? integers(gl, GL_QUERY_BUFFER_BINDING) : Values{0};
  }
  Values draw_framebuffer() const { return integers(gl, GL_DRAW_FRAMEBUFFER_BINDING); }
  Values renderbuffer() const { return integers(gl, GL_RENDERBUFFER_BINDING); }
  Values rasterizer_discard() const { return {gl.IsEnabled(GL_RASTERIZER_DISCARD)}; }
  Values primitive_restart() const { return {has.desktop && gl.IsEnabled(GL_PRIMITIVE_RESTART)}; }
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
  Values storage_buffer() const {
    return has.storage() ? integers(gl, GL_SHADER_STORAGE_BUFFER_BINDING) : Values{0};
  }
  Values storage_ranges() const {
    Values values;
    for (GLuint i = 0; has.storage() && i < gl::storage_binding_count; ++i)
      for (const std::int64_t v : indexed(gl, GL_SHADER_STORAGE_BUFFER_BINDING,
                                          GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE, i))
        values.push_back(v);
    return values;
  }
};

}  // namespace

unsigned users_of_tier(int tier) {
  const bool es = tier == NOOK_GL_TIER_ES30 || tier == NOOK_GL_TIER_ES31;
  return unsigned{computes(tier) ? gl::tier_43 : gl::tier_33} | (es ? gl::texel_uploads : 0u);
}

Poison::Poison(platform::Context& context, unsigned users)
    : gl_(context.gl()), users_(users), objects_(std::make_unique<Objects>()) {
  const GladGLContext& gl = gl_;
  const Has has(gl);
  Objects& o = *objects_;
  gl.GenBuffers(4, o.buffers);
  for (const GLuint buffer : o.buffers) {
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl.BufferData(GL_ARRAY_BUFFER, 8192, nullptr, GL_STATIC_DRAW);
  }
  // Beside the list.
  gl.GenTextures(1, &o.texture_2d);
  gl.GenSamplers(1, &o.sampler);
  for (const GLenum unit : odd_units) {
    gl.ActiveTexture(unit);
    gl.BindTexture(GL_TEXTURE_2D, o.texture_2d);
    gl.BindSampler(unit - GL_TEXTURE0, o.sampler);
  }
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, o.buffers[1]);
  gl.BindBuffer(GL_COPY_READ_BUFFER, o.buffers[1]);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, o.buffers[2]);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, o.buffers[2]);
  gl.DepthMask(GL_FALSE);
  gl.StencilMask(5);
  gl.DepthFunc(GL_NEVER);
  gl.StencilFunc(GL_NEVER, 1, 3);
  if (has.desktop) gl.LogicOp(GL_CLEAR);
  gl.SampleCoverage(0.25f, GL_TRUE);
  gl.BlendColor(0.1f, 0.2f, 0.3f, 0.4f);
  gl.Scissor(1, 2, 0, 0);
  if (has.desktop) gl.PrimitiveRestartIndex(1);
  if (has.clip_control(gl)) gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);

  // The list.
  o.program = platform::link_program(gl, {glsl_header(gl), "void main() { gl_Position = vec4(0.0); }\n"},
                                     {glsl_header(gl), "void main() {}\n"});
  gl.UseProgram(o.program);
  gl.GenVertexArrays(1, &o.vertex_array);
  gl.BindVertexArray(o.vertex_array);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, o.buffers[3]);
  gl.BindBuffer(GL_ARRAY_BUFFER, o.buffers[1]);
  gl.GenTextures(1, &o.texture);
  gl.GenTextures(1, &o.other_texture);
  if (has.desktop) {  // OpenGL ES has 2D textures there, which are odd already
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_BUFFER, o.texture);
    gl.ActiveTexture(GL_TEXTURE0 + gl::filter_unit);
    gl.BindTexture(GL_TEXTURE_BUFFER, o.other_texture);
  }
  gl.GenTextures(1, &o.texture_array);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, o.texture_array);
  gl.GenTextures(1, &o.volume);
  gl.BindTexture(GL_TEXTURE_3D, o.volume);
  gl.GenTextures(1, &o.cube);
  gl.ActiveTexture(GL_TEXTURE0 + gl::cube_map_unit);
  gl.BindTexture(GL_TEXTURE_CUBE_MAP, o.cube);
  gl.ActiveTexture(GL_TEXTURE0);
  // OpenGL ES binds immutable textures alone as images.
  if (!has.desktop) gl.TexStorage3D(GL_TEXTURE_2D_ARRAY, 2, GL_RGBA16F, 4, 4, 4);
  for (const int unit : gl::layer_units) {
    gl.ActiveTexture(GL_TEXTURE0 + GLenum(unit));
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, o.texture_array);
  }
  if (has.sample_textures()) {
    gl.GenTextures(1, &o.sample_texture);
    gl.ActiveTexture(GL_TEXTURE0 + gl::host_depth_unit);
    gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, o.sample_texture);
  }
  if (has.sample_arrays()) {
    gl.GenTextures(1, &o.sample_array);
    gl.ActiveTexture(GL_TEXTURE0 + gl::host_depth_unit);
    gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, o.sample_array);
  }
  gl.ActiveTexture(GL_TEXTURE5);
  if (has.images())
    for (const GLuint unit : {GLuint{gl::image_unit_index}, GLuint{gl::image_unit_index} + 1})
      gl.BindImageTexture(unit, o.texture_array, 1, GL_TRUE, 3, has.desktop ? GL_READ_WRITE : GL_WRITE_ONLY,
                          GL_RGBA16F);
  for (const GLenum name : pixel_store_of(has)) gl.PixelStorei(name, name == GL_UNPACK_ALIGNMENT ? 8 : 1);
  for (const GLenum name : pixel_pack_of(has)) gl.PixelStorei(name, name == GL_PACK_ALIGNMENT ? 2 : 1);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, o.buffers[0]);
  gl.Viewport(3, 4, 5, 6);
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_DST_COLOR, GL_ONE, GL_CONSTANT_ALPHA, GL_ZERO);
  gl.BlendEquationSeparate(GL_MIN, GL_FUNC_SUBTRACT);
  gl.ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
  gl.Enable(GL_SCISSOR_TEST);
  if (has.desktop) {
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    gl.Enable(GL_PRIMITIVE_RESTART);
  }
  for (const GLenum test : fragment_tests_of(has)) gl.Enable(test);
  gl.Disable(GL_DITHER);
  if (has.query_buffers()) gl.BindBuffer(GL_QUERY_BUFFER, o.buffers[2]);
  gl.GenFramebuffers(1, &o.framebuffer);
  gl.GenRenderbuffers(1, &o.renderbuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, o.framebuffer);  // incomplete
  gl.BindRenderbuffer(GL_RENDERBUFFER, o.renderbuffer);
  gl.Enable(GL_RASTERIZER_DISCARD);
  if (gl.BindTransformFeedback) {
    gl.GenTransformFeedbacks(1, &o.feedback);
    gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, o.feedback);
  }
  gl.BindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, o.buffers[2], 16, 64);
  gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, o.buffers[3]);
  if (has.storage()) {
    for (GLuint i = 0; i < gl::storage_binding_count; i += 2)
      gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, o.buffers[i % 4], 256 * (i + 1), 512);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, o.buffers[2]);
    gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, o.buffers[0]);
  }
}

void Poison::reset_touched() {
  const GladGLContext& gl = gl_;
  const Has has(gl);
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
  gl.Disable(GL_RASTERIZER_DISCARD);
  if (gl.BindTransformFeedback) gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
  gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
  gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, 0);
  for (GLuint unit = 0; unit < gl::texture_unit_count; ++unit) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    if (has.desktop) gl.BindTexture(GL_TEXTURE_BUFFER, 0);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, 0);
    gl.BindTexture(GL_TEXTURE_3D, 0);
    gl.BindTexture(GL_TEXTURE_CUBE_MAP, 0);
    if (has.sample_textures()) gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
    if (has.sample_arrays()) gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, 0);
    gl.BindSampler(unit, 0);
  }
  for (const GLenum name : pixel_store_of(has)) gl.PixelStorei(name, name == GL_UNPACK_ALIGNMENT ? 4 : 0);
  for (const GLenum name : pixel_pack_of(has)) gl.PixelStorei(name, name == GL_PACK_ALIGNMENT ? 4 : 0);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl.BlendFunc(GL_ONE, GL_ZERO);
  gl.BlendEquation(GL_FUNC_ADD);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  for (const GLenum capability : {GL_BLEND, GL_SCISSOR_TEST}) gl.Disable(capability);
  if (has.desktop) {
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    for (const GLenum capability : {GL_FRAMEBUFFER_SRGB, GL_PRIMITIVE_RESTART}) gl.Disable(capability);
  }
  for (const GLenum test : fragment_tests_of(has)) gl.Disable(test);
  gl.Enable(GL_DITHER);
  if (has.query_buffers()) gl.BindBuffer(GL_QUERY_BUFFER, 0);
  if (has.images()) unbind_image(gl, has, gl::image_unit_index);
  if (has.storage())
    for (GLuint i = 0; i < gl::storage_binding_count; ++i) gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, 0);
}

Poison::~Poison() {
  const GladGLContext& gl = gl_;
  const Has has(gl);
  Objects& o = *objects_;
  reset_touched();
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  for (const GLenum unit : odd_units) {
    gl.ActiveTexture(unit);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.BindSampler(unit - GL_TEXTURE0, 0);
  }
  gl.ActiveTexture(GL_TEXTURE0);
  for (const GLenum target : {GL_PIXEL_PACK_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER})
    gl.BindBuffer(target, 0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, 0);
  if (has.images()) unbind_image(gl, has, gl::image_unit_index + 1);
  gl.DepthMask(GL_TRUE);
  gl.StencilMask(~0u);
  gl.DepthFunc(GL_LESS);
  gl.StencilFunc(GL_ALWAYS, 0, ~0u);
  if (has.desktop) gl.LogicOp(GL_COPY);
  gl.SampleCoverage(1, GL_FALSE);
  gl.BlendColor(0, 0, 0, 0);
  gl.Viewport(0, 0, 64, 64);
  gl.Scissor(0, 0, 64, 64);
  if (has.clip_control(gl)) gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  if (has.desktop) gl.PrimitiveRestartIndex(0);
  gl.DeleteBuffers(4, o.buffers);
  gl.DeleteTextures(1, &o.texture);
  gl.DeleteTextures(1, &o.other_texture);
  gl.DeleteTextures(1, &o.texture_2d);
  gl.DeleteTextures(1, &o.texture_array);
  gl.DeleteTextures(1, &o.volume);
  gl.DeleteTextures(1, &o.cube);
  if (o.sample_texture) gl.DeleteTextures(1, &o.sample_texture);
  if (o.sample_array) gl.DeleteTextures(1, &o.sample_array);
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
  using namespace gl;
#define NOOK_X(name, item_users, what, note) \
  if (users_ & (item_users)) values[#name] = read.name();
  NOOK_GL_TOUCHED_STATE(NOOK_X)
#undef NOOK_X
  return values;
}

StateValues Poison::defaults() const {
  const Has has(gl_);
  Values pixel_store(pixel_store_of(has).size(), 0);
  Values pixel_pack(pixel_pack_of(has).size(), 0);
  pixel_store[0] = pixel_pack[0] = 4;  // the alignment
  const StateValues other_than_0 = {
      {"active_texture", {GL_TEXTURE0}},
      {"blend", {GL_FALSE, GL_ONE, GL_ZERO, GL_ONE, GL_ZERO, GL_FUNC_ADD, GL_FUNC_ADD}},
      {"color_mask", {GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE}},
      {"image_unit", {0, 0, GL_FALSE, 0, GL_READ_ONLY, has.desktop ? GL_R8 : GL_R32UI}},
      {"pixel_store", pixel_store},
      {"pixel_pack", pixel_pack},
      {"polygon_mode", {GL_FILL}},
      {"dither", {GL_TRUE}}};
  StateValues values = touched();
  // It has no default; the pass documents what it leaves.
  values.erase("viewport");
  for (auto& [name, numbers] : values) {
    const auto known = other_than_0.find(name);
    numbers = known != other_than_0.end() ? known->second : Values(numbers.size(), 0);
  }
  return values;
}

StateValues Poison::untouched() const {
  StateValues values;
  const auto keep = [&](const char* name, Values numbers) { values[name] = std::move(numbers); };
  using namespace gl;
  const Readers read{gl_};
#define NOOK_X(name, item_users, what, note) \
  if (!(users_ & (item_users))) keep(#name, read.name());
  NOOK_GL_TOUCHED_STATE(NOOK_X)
#undef NOOK_X
  const Has has(gl_);
  // On OpenGL ES these bind their tables of texels to the first unit's 2D texture.
  if (!has.desktop && users_ & (gl::characters | gl::probes | gl::captures) && values.contains("texture_2d"))
    values["texture_2d"].erase(values["texture_2d"].begin());
  if (!has.desktop && users_ & (gl::screen | gl::outputs)) values.erase("texture_unit_0");
  // Captures have their own item for the samplers of the first two units, which the screen pass uses too.
  if (users_ & gl::captures) values["samplers"] = {values["samplers"].begin() + 2, values["samplers"].end()};
  if (users_ & gl::screen) values.erase("capture_samplers");
  // Further viewports and draw buffers are the host's, whoever sets the first.
  if (has.desktop && has.version >= 41) {
    GLfloat box[4] = {};
    gl_.GetFloati_v(GL_VIEWPORT, 1, box);
    keep("viewport 1", Values(box, box + 4));
    keep("scissor test 1", {gl_.IsEnabledi(GL_SCISSOR_TEST, 1)});
  }
  if (has.indexed_draw_buffers()) {
    keep("blend 1", {gl_.IsEnabledi(GL_BLEND, 1)});
    keep("color mask 1", read.color_mask_of(1));
  }
  keep("image unit 1", read.image_unit_of(gl::image_unit_index + 1));
  if (has.from(40, 32))
    for (const GLenum name : {GL_BLEND_SRC_RGB, GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB}) {
      GLint value = 0;
      gl_.GetIntegeri_v(name, 1, &value);
      keep(("blend 1 " + std::to_string(name)).c_str(), {value});
    }
#define NOOK_INTEGERS(name, count) keep(#name, integers(gl_, name, count))
  NOOK_INTEGERS(GL_SCISSOR_BOX, 4);
  NOOK_INTEGERS(GL_DEPTH_WRITEMASK, 1);
  NOOK_INTEGERS(GL_DEPTH_FUNC, 1);
  NOOK_INTEGERS(GL_STENCIL_WRITEMASK, 1);
  NOOK_INTEGERS(GL_STENCIL_FUNC, 1);
  if (has.desktop) {
    NOOK_INTEGERS(GL_LOGIC_OP_MODE, 1);
    NOOK_INTEGERS(GL_PRIMITIVE_RESTART_INDEX, 1);
  }
  NOOK_INTEGERS(GL_UNIFORM_BUFFER_BINDING, 1);
  NOOK_INTEGERS(GL_COPY_READ_BUFFER, 1);
  NOOK_INTEGERS(GL_COPY_WRITE_BUFFER, 1);
#undef NOOK_INTEGERS
  const Values active = integers(gl_, GL_ACTIVE_TEXTURE);
  for (GLenum unit = 0; unit < 16; ++unit) {
    gl_.ActiveTexture(GL_TEXTURE0 + unit);
    const std::string prefix = "unit " + std::to_string(unit) + " ";
    if (unit >= gl::texture_unit_count) {
      keep((prefix + "2D").c_str(), integers(gl_, GL_TEXTURE_BINDING_2D));
      keep((prefix + "sampler").c_str(), integers(gl_, GL_SAMPLER_BINDING));
    }
    if (has.desktop && unit != 0 && unit != gl::filter_unit)
      keep((prefix + "buffer").c_str(), integers(gl_, GL_TEXTURE_BINDING_BUFFER));
  }
  gl_.ActiveTexture(static_cast<GLenum>(active[0]));
  // Its element buffer belongs to the host's vertex array, whatever is bound now.
  const Values vertex_array = integers(gl_, GL_VERTEX_ARRAY_BINDING);
  gl_.BindVertexArray(objects_->vertex_array);
  keep("element buffer of the host's vertex array", integers(gl_, GL_ELEMENT_ARRAY_BUFFER_BINDING));
  gl_.BindVertexArray(static_cast<GLuint>(vertex_array[0]));
  return values;
}

}  // namespace nook::test
