// Radiance transfer in shaders: the GLSL against the CPU, and the contract of the C functions.
#include <nook/experimental/nook_transfer.h>

#include <cmath>

#include "platform/program.h"
#include "sdk/src/gl/touched_state.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/parabolic.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/transfer/transfer_file.h"
#include "tests/gl/material_decoder.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/material/material_sample.h"
#include "tests/transfer/transfer_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int count = 64;  // vertices, one pixel each
// The middle of a texel, where the weights of a driver's filter are exact. The fragment shader has it too.
constexpr float place[2] = {0.3125f, 0.5625f};

// Each vertex is a point on a pixel of its own.
const char vertex_text[] =
    "out vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT];\n"
    "flat out ivec3 corners;\n"
    "void main() {\n"
    "  nook_transfer_vectors(gl_VertexID, vectors);\n"
    "  corners = ivec3(gl_VertexID, (gl_VertexID + 1) % 64, (gl_VertexID + 5) % 64);\n"
    "  gl_Position = vec4((float(gl_VertexID) + 0.5) / 32.0 - 1.0, 0.0, 0.0, 1.0);\n"
    "  gl_PointSize = 1.0;\n"
    "}\n";
const char fragment_text[] =
    "in vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT];\n"
    "flat in ivec3 corners;\n"
    "uniform highp sampler2D views;\n"
    "layout(location = 0) out vec4 value; layout(location = 1) out vec4 mixed;\n"
    "void main() {\n"
    // The direction in tangent space goes through a frame that is the unit matrix.
    "  vec3 given = texelFetch(views, ivec2(gl_FragCoord.xy), 0).xyz;\n"
    "  vec3 view = nook_transfer_tangent_space(vec3(0.0, 0.0, 2.0), vec4(3.0, 0.0, 1.0, 1.0), given);\n"
    "  vec4 modes[NOOK_LIGHT_VEC4_COUNT];\n"
    "  nook_material_decode(vec2(0.3125, 0.5625), vec2(0.0), vec2(0.0), view, modes);\n"
    "  value = vec4(nook_transfer_radiance(modes, vectors), 1.0);\n"
    "  vec4 between[3 * NOOK_LIGHT_VEC4_COUNT];\n"
    "  nook_transfer_mix(corners, vec3(0.5, 0.3, 0.2), between);\n"
    "  mixed = vec4(nook_transfer_radiance(modes, between), 1.0);\n"
    "}\n";

material::test::SampleSize agreement_size() {
  material::test::SampleSize size;
  size.width = size.height = 8;
  size.rank_light = 6;
  return size;
}

nook_transfer_response make_response(nook_context context, nook_material material) {
  nook_transfer_response_desc desc;
  NOOK_OK_OR_FAIL(nook_transfer_response_desc_init(&desc));
  desc.material = material;
  desc.lobe_count = 42;
  nook_transfer_response response = nullptr;
  NOOK_OK_OR_FAIL(nook_transfer_response_create(context, &desc, &response));
  return response;
}

std::vector<nook_material_pixel> views_of(const nook_material_info& info) {
  material::test::Numbers numbers(5);
  const std::uint32_t side =
      info.btf.view_map_side ? 256 / info.btf.view_map_side * info.btf.view_map_side : 256;
  std::vector<nook_material_pixel> samples(count);
  for (nook_material_pixel& s : samples) {
    s = {{place[0], place[1]}, {}, {}, {}, {0, 0, 1}};
    material::ParabolicPoint p;
    do {
      p.x = (float(numbers.below(side)) + 0.5f) / float(side) * 2 - 1;
      p.y = (float(numbers.below(side)) + 0.5f) / float(side) * 2 - 1;
    } while (p.x * p.x + p.y * p.y >= 0.9f);
    const Vec3 view = material::from_parabolic(p);
    s.view[0] = view.x;
    s.view[1] = view.y;
    s.view[2] = view.z;
  }
  return samples;
}

struct Drawn {
  std::vector<float> value, mixed;  // RGBA of each vertex
};

Drawn draw(const GladGLContext& gl, nook_gl_upload material, nook_gl_upload transfer,
           const std::vector<nook_material_pixel>& samples) {
  const nook_gl_upload_info info = info_of(transfer);
  const nook_gl_upload_info decoder = info_of(material);
  const GLuint program = platform::link_program(gl, {glsl_header(gl), info.glsl, vertex_text},
                                                {glsl_header(gl), decoder.glsl, info.glsl, fragment_text});
  // Making textures binds them to the active unit.
  Textures images(gl);
  std::vector<float> views;
  for (const nook_material_pixel& s : samples) views.insert(views.end(), {s.view[0], s.view[1], s.view[2]});
  const GLuint given = images.floats(GL_RGB32F, 3, count, 1, views);
  const GLuint value = images.floats(GL_RGBA32F, 4, count, 1, {}),
               mixed = images.floats(GL_RGBA32F, 4, count, 1, {});
  gl.UseProgram(program);
  GLint unit = 0;
  for (nook_gl_upload upload : {material, transfer}) {
    NOOK_OK_OR_FAIL(nook_gl_upload_bind(upload, program, std::uint32_t(unit)));
    unit += GLint(info_of(upload).texture_count);
  }
  gl.ActiveTexture(GL_TEXTURE0 + GLenum(unit));
  gl.BindTexture(GL_TEXTURE_2D, given);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.Uniform1i(gl.GetUniformLocation(program, "views"), unit++);
  GLuint framebuffer = 0, vertex_array = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &vertex_array);
  gl.BindVertexArray(vertex_array);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, value, 0);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, mixed, 0);
  const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl.DrawBuffers(2, buffers);
  gl.Viewport(0, 0, count, 1);
  gl.DrawArrays(GL_POINTS, 0, count);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.BindVertexArray(0);
  gl.DeleteVertexArrays(1, &vertex_array);
  gl.UseProgram(0);
  for (; unit > 0; --unit) {
    gl.ActiveTexture(GL_TEXTURE0 + GLenum(unit - 1));
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, 0);
    if (!is_es(gl)) gl.BindTexture(GL_TEXTURE_BUFFER, 0);
  }
  gl.DeleteProgram(program);
  return {read_texture(gl, value, count, 1, 4), read_texture(gl, mixed, count, 1, 4)};
}

nook_gl_upload upload(MaterialFixture& fixture, nook_transfer_response response,
                      const std::vector<float>& vectors) {
  nook_gl_upload transfer = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_upload_transfer(fixture.gl, nullptr, response, count, &transfer));
  NOOK_OK_OR_FAIL(nook_gl_update_transfer(transfer, vectors.data(), vectors.size()));
  return transfer;
}

// Draws what was uploaded and compares it with what nook_transfer_shade makes of the vectors.
void check_agreement(platform::Context& context, MaterialFixture& fixture, nook_material material,
                     nook_transfer_response response, nook_gl_upload transfer,
                     const std::vector<float>& vectors) {
  nook_transfer_response_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_transfer_response_describe(response, &info));
  const std::vector<nook_material_pixel> samples = views_of(info_of(material));
  const Drawn drawn = draw(context.gl(), fixture.upload(material), transfer, samples);

  std::vector<float> between(vectors.size()), wanted(3 * count), wanted_mixed(3 * count);
  for (int v = 0; v < count; ++v)
    for (std::uint32_t i = 0; i < info.vector_floats; ++i) {
      const auto of = [&](int vertex) {
        return vectors[std::size_t(vertex % count) * info.vector_floats + i];
      };
      between[std::size_t(v) * info.vector_floats + i] = 0.5f * of(v) + 0.3f * of(v + 1) + 0.2f * of(v + 5);
    }
  NOOK_OK_OR_FAIL(nook_transfer_shade(material, samples.data(), vectors.data(), info.vector_floats, count,
                                      wanted.data()));
  NOOK_OK_OR_FAIL(nook_transfer_shade(material, samples.data(), between.data(), info.vector_floats, count,
                                      wanted_mixed.data()));
  float brightest = 0;
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      INFO("vertex " << v << ", channel " << c);
      CHECK(std::abs(drawn.value[4 * v + c] - wanted[3 * v + c]) <= 1.0f / 255);
      CHECK(std::abs(drawn.mixed[4 * v + c] - wanted_mixed[3 * v + c]) <= 1.0f / 255);
      brightest = std::max(brightest, std::abs(wanted[3 * v + c]));
    }
  CHECK(brightest > 100);
  nook_gl_upload_destroy(&transfer);
}

}  // namespace

TEST_CASE("transfer: the GLSL agrees with the CPU reference to 1/255") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const nook_material material = fixture.load(material::test::sample_material(4, agreement_size()));
  nook_transfer_response response = make_response(fixture.host.handle, material);
  nook_transfer_response_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_transfer_response_describe(response, &info));
  // Radiances of up to some thousands: the bound is 1e-6 of the largest.
  material::test::Numbers numbers(9);
  std::vector<float> vectors(std::size_t(count) * info.vector_floats);
  for (float& number : vectors) number = numbers.between(-0.3f, 0.3f);
  check_agreement(context, fixture, material, response, upload(fixture, response, vectors), vectors);
  nook_transfer_response_destroy(&response);
}

TEST_CASE(
    "transfer: the paper's form is drawn as the CPU reference shades it, from vectors and from clusters") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const material::Material made = material::test::sample_material(4, agreement_size());
  const nook_material material = fixture.load(made);
  nook_transfer_response response = make_response(fixture.host.handle, material);
  const material::MaterialTables tables = material::make_tables(
      material::read_material(material::write_material(made)), {}, default_memory(), 16);
  for (const std::uint32_t bounces : {0u, 1u, 2u}) {
    CAPTURE(bounces);
    const std::vector<std::byte> bytes = transfer::write_transfer(
        transfer::test::sample_paper(count, 42, tables.btf.light_modes, tables.light_hash, bounces));
    nook_transfer transfer = nullptr;
    NOOK_OK_OR_FAIL(nook_transfer_load(fixture.host.handle, bytes.data(), bytes.size(), &transfer));
    std::vector<float> amplitudes(3 * 42), vectors(std::size_t(count) * 3 * tables.btf.light_modes);
    for (std::size_t i = 0; i < amplitudes.size(); ++i) amplitudes[i] = 0.3f * std::sin(float(i));
    nook_transfer_vectors_desc desc;
    NOOK_OK_OR_FAIL(nook_transfer_vectors_desc_init(&desc));
    desc.transfer = transfer;
    desc.amplitudes = amplitudes.data();
    desc.lobe_count = 42;
    NOOK_OK_OR_FAIL(nook_transfer_read_vectors(response, &desc, vectors.data(), count, 0));
    check_agreement(context, fixture, material, response, upload(fixture, response, vectors), vectors);
    nook_gl_upload clusters = nullptr;
    NOOK_OK_OR_FAIL(nook_gl_upload_transfer(fixture.gl, transfer, response, 0, &clusters));
    CHECK(info_of(clusters).texture_count == 2);
    CHECK(nook_gl_update_transfer(clusters, nullptr, amplitudes.size()) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(nook_gl_update_transfer(clusters, amplitudes.data(), 39) == NOOK_ERROR_INVALID_ARGUMENT);
    NOOK_OK_OR_FAIL(nook_gl_update_transfer(clusters, amplitudes.data(), amplitudes.size()));
    check_agreement(context, fixture, material, response, clusters, vectors);
    nook_transfer_destroy(&transfer);
  }
  nook_transfer_response_destroy(&response);
}

TEST_CASE("transfer: the file's form decides what its upload holds") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const nook_material material = fixture.load(material::test::sample_material(4));
  nook_transfer_response response = make_response(fixture.host.handle, material);
  const auto create = [&](const transfer::Transfer& made, nook_gl_upload& created) {
    const std::vector<std::byte> bytes = transfer::write_transfer(made);
    nook_transfer transfer = nullptr;
    NOOK_OK_OR_FAIL(nook_transfer_load(fixture.host.handle, bytes.data(), bytes.size(), &transfer));
    const nook_result result = nook_gl_upload_transfer(fixture.gl, transfer, response, 0, &created);
    nook_transfer_destroy(&transfer);
    return result;
  };
  nook_gl_upload created = nullptr;
  // Other light modes.
  CHECK(create(transfer::test::sample_paper(5, 42, 4, 77), created) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(created == nullptr);
  // The separated form gets room for the vectors of its vertices.
  NOOK_OK_OR_FAIL(create(transfer::test::sample_transfer(5, 42), created));
  nook_transfer_response_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_transfer_response_describe(response, &info));
  const std::vector<float> vectors(std::size_t(5) * info.vector_floats);
  CHECK(nook_gl_update_transfer(created, vectors.data(), vectors.size() - 1) == NOOK_ERROR_INVALID_ARGUMENT);
  NOOK_OK_OR_FAIL(nook_gl_update_transfer(created, vectors.data(), vectors.size()));
  nook_gl_upload_destroy(&created);
  CHECK(nook_gl_update_transfer(fixture.upload(material), vectors.data(), vectors.size()) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  nook_transfer_response_destroy(&response);
}

TEST_CASE("transfer: vectors that do not fit are refused") {
  NOOK_NEED_CONTEXT(context);
  MaterialFixture fixture(context);
  const nook_material material = fixture.load(material::test::sample_material(4));
  nook_transfer_response response = make_response(fixture.host.handle, material);
  nook_gl_upload transfer = nullptr;
  CHECK(nook_gl_upload_transfer(fixture.gl, nullptr, response, 0, &transfer) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_transfer(nullptr, nullptr, response, 4, &transfer) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_transfer(fixture.gl, nullptr, nullptr, 4, &transfer) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(transfer == nullptr);
  nook_transfer_response_destroy(&response);
}

TEST_CASE("transfer: uploads of vectors and of clusters keep the promises on OpenGL state") {
  NOOK_NEED_CONTEXT(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS}) {
    MaterialFixture fixture(context, mode);
    const material::Material made = material::test::sample_material(4);
    const nook_material material = fixture.load(made);
    const material::MaterialTables tables = material::make_tables(
        material::read_material(material::write_material(made)), {}, default_memory(), 16);
    const std::vector<std::byte> bytes = transfer::write_transfer(
        transfer::test::sample_paper(3, 42, tables.btf.light_modes, tables.light_hash, 1));
    nook_transfer baked = nullptr;
    NOOK_OK_OR_FAIL(nook_transfer_load(fixture.host.handle, bytes.data(), bytes.size(), &baked));
    nook_transfer_response response = make_response(fixture.host.handle, material);
    nook_transfer_response_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_transfer_response_describe(response, &info));
    const std::vector<float> vectors(std::size_t(3) * info.vector_floats, 0.5f);
    const std::vector<float> amplitudes(3 * 42, 0.5f);
    nook_gl_upload transfer = nullptr, clusters = nullptr;
    {
      Poison poison(context, is_es(context.gl()) ? gl::probes | gl::texel_uploads : unsigned{gl::probes});
      const StateValues touched = poison.touched(), untouched = poison.untouched();
      NOOK_OK_OR_FAIL(nook_gl_upload_transfer(fixture.gl, nullptr, response, 3, &transfer));
      NOOK_OK_OR_FAIL(nook_gl_update_transfer(transfer, vectors.data(), vectors.size()));
      NOOK_OK_OR_FAIL(nook_gl_upload_transfer(fixture.gl, baked, response, 0, &clusters));
      NOOK_OK_OR_FAIL(nook_gl_update_transfer(clusters, amplitudes.data(), amplitudes.size()));
      CHECK(poison.untouched() == untouched);
      if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
      if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
    }
    nook_gl_upload_destroy(&transfer);
    nook_gl_upload_destroy(&clusters);
    nook_transfer_destroy(&baked);
    nook_transfer_response_destroy(&response);
  }
}
