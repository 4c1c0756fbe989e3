#include "tests/gl/material_decoder.h"

#include <cmath>
#include <string>

#include "platform/program.h"
#include "sdk/src/api/gl/upload.h"
#include "sdk/src/material/material_file.h"
#include "tests/gl/test_context.h"

namespace nook::test {
namespace {

const char vertex_text[] =
    "void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1), 0, 1); }\n";

// Every fetch of the text in between is counted.
const char counting_text[] =
    "int fetched = 0;\n"
    "#define texelFetch(s, p, l) (++fetched, texelFetch(s, p, l))\n"
    "#define textureLod(s, p, l) (++fetched, textureLod(s, p, l))\n";

const char main_text[] =
    "#undef texelFetch\n"
    "uniform highp sampler2D places, sides, views, lights;\n"
    "uniform int fetches;\n"
    "layout(location = 0) out vec4 value; layout(location = 1) out vec4 more;\n"
    "int taken() { int n = fetched; fetched = 0; return n; }\n"
    "void main() {\n"
    "  ivec2 p = ivec2(gl_FragCoord.xy);\n"
    "  vec2 place = texelFetch(places, p, 0).xy;\n"
    "  vec3 view = texelFetch(views, p, 0).xyz, light = texelFetch(lights, p, 0).xyz;\n"
    "  vec4 side = texelFetch(sides, p, 0);\n"
    "  vec4 modes[NOOK_LIGHT_VEC4_COUNT];\n"
    "#if IS_ANISOTROPIC\n"
    "  if (fetches > 0) nook_material_decode_anisotropic(place, side.xy, side.zw, view, fetches, modes);\n"
    "  else\n"
    "#endif\n"
    "    nook_material_decode(place, side.xy, side.zw, view, modes);\n"
    "  int decoded = taken();\n"
    "  vec3 radiance = nook_material_radiance(modes, light);\n"
    "  int lit = taken();\n"
    "  float occlusion;\n"
    "#if IS_ANISOTROPIC\n"
    "  if (fetches > 0) occlusion = nook_material_occlusion_anisotropic(place, side.xy, side.zw, view, "
    "fetches);\n"
    "  else\n"
    "#endif\n"
    "    occlusion = nook_material_occlusion(place, side.xy, side.zw, view);\n"
    "  value = vec4(radiance, occlusion);\n"
    "  more = vec4(nook_material_visibility(occlusion), float(decoded), float(lit), float(taken()));\n"
    "}\n";

}  // namespace

MaterialFixture::MaterialFixture(platform::Context& made_in, nook_gl_state_mode mode)
    : context(made_in), gl(create_gl(host.handle, platform::Context::loader, &context, 0, mode)) {}

MaterialFixture::~MaterialFixture() {
  for (nook_gl_upload& upload : uploads) nook_gl_upload_destroy(&upload);
  for (nook_material& material : materials) nook_material_destroy(&material);
  nook_gl_destroy(&gl);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

nook_material MaterialFixture::load(const material::Material& material, nook_material_blocks modes,
                                    int whole_light_modes) {
  const std::vector<std::byte> file = material::write_material(material);
  nook_material handle = nullptr;
  nook_material_desc desc;
  NOOK_OK_OR_FAIL(nook_material_desc_init(&desc));
  desc.blocks = modes;
  desc.whole_light_modes = whole_light_modes;
  NOOK_OK_OR_FAIL(nook_material_load(host.handle, file.data(), file.size(), &desc, &handle));
  materials.push_back(handle);
  return handle;
}

nook_gl_upload MaterialFixture::upload(nook_material material, int max_layers) {
  nook_gl_upload handle = nook::api::upload_material(gl, material, static_cast<std::uint32_t>(max_layers));
  uploads.push_back(handle);
  return handle;
}

nook_material_info info_of(nook_material material) {
  nook_material_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_material_describe(material, &info));
  return info;
}
nook_gl_upload_info info_of(nook_gl_upload material) {
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(material, &info));
  return info;
}

MaterialDecoder::MaterialDecoder(const GladGLContext& gl, nook_gl_upload material, nook_material_info info,
                                 bool is_anisotropic)
    : gl_(gl), info_(info) {
  const nook_gl_upload_info uploaded = info_of(material);
  textures_.assign(uploaded.textures, uploaded.textures + uploaded.texture_count);
  program_ = platform::link_program(
      gl, {glsl_header(gl), vertex_text},
      {glsl_header(gl), counting_text, uploaded.glsl,
       is_anisotropic ? "#define IS_ANISOTROPIC 1\n" : "#define IS_ANISOTROPIC 0\n", main_text});
}

MaterialDecoder::~MaterialDecoder() {
  gl_.DeleteProgram(program_);
}

std::vector<nook_material_pixel> round_pixels(const std::vector<LevelPixel>& of,
                                              const nook_material_info& info) {
  std::vector<nook_material_pixel> pixels;
  for (const LevelPixel& p : of) {
    const float side = std::exp2(p.level);
    pixels.push_back({{p.uv[0], p.uv[1]},
                      {side / float(info.width), 0},
                      {0, side / float(info.height)},
                      {p.view[0], p.view[1], p.view[2]},
                      {p.light[0], p.light[1], p.light[2]}});
  }
  return pixels;
}

std::vector<GpuValue> MaterialDecoder::decode(const std::vector<LevelPixel>& samples) const {
  return decode(round_pixels(samples, info_), 0);
}

std::vector<GpuValue> MaterialDecoder::decode(const std::vector<nook_material_pixel>& pixels,
                                              int fetches) const {
  std::vector<float> numbers[4];
  for (const nook_material_pixel& p : pixels) {
    numbers[0].insert(numbers[0].end(), {p.uv[0], p.uv[1], 0, 0});
    numbers[1].insert(numbers[1].end(), {p.dx[0], p.dx[1], p.dy[0], p.dy[1]});
    numbers[2].insert(numbers[2].end(), {p.view[0], p.view[1], p.view[2], 0});
    numbers[3].insert(numbers[3].end(), {p.light[0], p.light[1], p.light[2], 0});
  }
  return draw(numbers, pixels.size(), fetches);
}

std::vector<GpuValue> MaterialDecoder::draw(std::vector<float> (&numbers)[4], std::size_t count,
                                            int fetches) const {
  const int width = std::min(int(count), 256), height = (int(count) + width - 1) / width;
  Textures images(gl_);
  GLuint inputs[4] = {};
  for (int i = 0; i < 4; ++i) {
    numbers[i].resize(std::size_t(4) * width * height);
    inputs[i] = images.floats(GL_RGBA32F, 4, width, height, numbers[i]);
  }
  const GLuint value = images.floats(GL_RGBA32F, 4, width, height, {}),
               more = images.floats(GL_RGBA32F, 4, width, height, {});
  gl_.UseProgram(program_);
  GLint unit = 0;
  for (const nook_gl_upload_texture& texture : textures_) {
    gl_.ActiveTexture(GL_TEXTURE0 + GLenum(unit));
    gl_.BindTexture(texture.target, texture.texture);
    const GLint at = gl_.GetUniformLocation(program_, texture.uniform);
    INFO(texture.uniform);
    CHECK(at >= 0);
    gl_.Uniform1i(at, unit++);
  }
  const char* const names[] = {"places", "sides", "views", "lights"};
  for (int i = 0; i < 4; ++i) {
    gl_.ActiveTexture(GL_TEXTURE0 + GLenum(unit));
    gl_.BindTexture(GL_TEXTURE_2D, inputs[i]);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.Uniform1i(gl_.GetUniformLocation(program_, names[i]), unit++);
  }
  gl_.Uniform1i(gl_.GetUniformLocation(program_, "fetches"), fetches);

  GLuint framebuffer = 0, vertex_array = 0;
  gl_.GenFramebuffers(1, &framebuffer);
  gl_.GenVertexArrays(1, &vertex_array);
  gl_.BindVertexArray(vertex_array);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, value, 0);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, more, 0);
  const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.DrawBuffers(2, buffers);
  gl_.Viewport(0, 0, width, height);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl_.DeleteFramebuffers(1, &framebuffer);
  gl_.BindVertexArray(0);
  gl_.DeleteVertexArrays(1, &vertex_array);
  gl_.UseProgram(0);
  const std::vector<float> first = read_texture(gl_, value, width, height, 4),
                           second = read_texture(gl_, more, width, height, 4);
  for (; unit > 0; --unit) {
    gl_.ActiveTexture(GL_TEXTURE0 + GLenum(unit - 1));
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, 0);
  }
  std::vector<GpuValue> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back({{{first[4 * i], first[4 * i + 1], first[4 * i + 2]}, first[4 * i + 3], second[4 * i]},
                   second[4 * i + 1],
                   second[4 * i + 2],
                   second[4 * i + 3]});
  return out;
}

}  // namespace nook::test
