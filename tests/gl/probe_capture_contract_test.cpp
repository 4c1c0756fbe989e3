// These tests hold captures to their contract with a host: OpenGL state, memory and lifetimes, and the calls
// that they refuse.
#include <cmath>
#include <limits>
#include <string>

#include "sdk/src/gl/touched_state.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/poison.h"
#include "tests/gl/probe_capture_scene.h"

using namespace nook;
using namespace nook::test;

TEST_CASE("captures keep the promises on OpenGL state, and read nothing back") {
  NOOK_NEED_CONTEXT(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    Fixture fixture(context, mode);
    const Probes black = black_grid(probe::vogel_basis(12), {2, 2, 1});
    const GlProbe probe = fixture.upload(black);
    const Grid grid = fixture.upload_grid(black, NOOK_GL_PROBE_ZH3);
    const GLuint cube = fixture.cubes.make(uneven_cube(8, 5));
    nook_gl_capture_desc desc = default_desc();
    desc.probe = probe.get();
    desc.grid = grid.get();
    desc.face_size_px = 8;
    desc.light = NOOK_GL_CAPTURE_SKY;
    Poison poison(context, gl::captures);
    const StateValues touched = poison.touched(), untouched = poison.untouched();
    const Capture capture = fixture.capture(desc);
    add(capture, 3, cube);
    CHECK(read(capture, 3).harmonics[0] > 0);
    INFO("mode " << mode);
    CHECK(poison.untouched() == untouched);
    if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
    if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
  }
  Trace trace(context);
  Fixture fixture(context, trace);
  const GlProbe probe = fixture.upload(black_grid(probe::vogel_basis(12)));
  nook_gl_capture_desc desc = default_desc();
  desc.probe = probe.get();
  desc.face_size_px = 8;
  const Capture capture = fixture.capture(desc);
  const GLuint cube = fixture.cubes.make(uneven_cube(8, 5));
  trace.reset();
  const long allocations = fixture.host.allocations;
  add(capture, 0, cube);
  CHECK(fixture.host.allocations == allocations);
  for (const char* reading : {"glReadPixels", "glGetBufferSubData", "glMapBufferRange", "glFinish"})
    CHECK(trace.calls(reading) == 0);
}

TEST_CASE("what is not a cube map for a capture is refused, and the light stays") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const GladGLContext& gl = context.gl();
  const Probes black = black_grid(probe::vogel_basis(12));
  const GlProbe probe = fixture.upload(black);
  nook_gl_capture_desc desc = default_desc();
  desc.probe = probe.get();
  desc.face_size_px = 8;
  const Capture capture = fixture.capture(desc);
  add(capture, 0, fixture.cubes.make(Cube(8, [](Vec3) { return Vec3{1, 1, 1}; })));
  const auto refused = [&](GLuint name, const char* word) {
    CHECK(nook_gl_capture_add(capture.get(), 0, name, 0) == NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(word) != std::string::npos);
    CHECK(gl.GetError() == GL_NO_ERROR);
  };
  Textures textures(gl);
  refused(0, "not a texture");
  refused(4000000, "not a texture");
  refused(textures.floats(GL_RGBA32F, 4, 8, 8, {}), "another kind");
  GLint major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (!is_es(gl) || 10 * major + minor >= 31) {
    refused(fixture.cubes.make(Cube(16)), "16 x 16");
    const GLuint open = fixture.cubes.make(Cube(8));
    gl.BindTexture(GL_TEXTURE_CUBE_MAP, open);
    gl.TexImage2D(GL_TEXTURE_CUBE_MAP_NEGATIVE_Z, 0, GL_RGBA32F, 4, 4, 0, GL_RGBA, GL_FLOAT, nullptr);
    refused(open, "face 5");
    const GLuint integers = fixture.cubes.make(Cube(8));
    gl.BindTexture(GL_TEXTURE_CUBE_MAP, integers);
    for (GLenum face = 0; face < 6; ++face)
      gl.TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA8UI, 8, 8, 0, GL_RGBA_INTEGER,
                    GL_UNSIGNED_BYTE, nullptr);
    refused(integers, "format");
  }
  const GLuint later = fixture.cubes.make(Cube(8));
  gl.BindTexture(GL_TEXTURE_CUBE_MAP, later);
  gl.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BASE_LEVEL, 1);
  gl.BindTexture(GL_TEXTURE_CUBE_MAP, 0);
  refused(later, "levels");
  CHECK(std::abs(read(capture).harmonics[0] - std::sqrt(4 * pi)) < 1e-5f);
  CHECK(nook_gl_capture_add(capture.get(), 1, later, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_capture_add(nullptr, 0, later, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_capture_add(capture.get(), 0, later, 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_capture_read(capture.get(), 1, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_capture_solve(capture.get(), nullptr) == NOOK_ERROR_INVALID_ARGUMENT);

  take_debug_messages();  // of binding a texture of another kind

  // The probe has another grid now.
  const Probe larger = loaded(fixture.host.handle, black_grid(probe::vogel_basis(12), {2, 1, 1}));
  NOOK_OK_OR_FAIL(nook_gl_update_probe(probe.get(), larger.get()));
  refused(fixture.cubes.make(Cube(8)), "updated");
}

TEST_CASE("captures with a wrong descriptor are refused") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context), other(context);
  const GlProbe probe = fixture.upload(black_grid(probe::vogel_basis(12)));
  const GlProbe foreign = other.upload(black_grid(probe::vogel_basis(12)));
  const GlProbe half = fixture.upload(black_grid(probe::vogel_basis(12, false, probe::Domain::hemisphere)));
  const Grid grid = fixture.upload_grid(black_grid(probe::harmonic_basis(2), {2, 1, 1}), 0);
  const auto refused = [&](auto&& change, const char* word) {
    nook_gl_capture_desc desc = default_desc();
    desc.probe = probe.get();
    change(desc);
    nook_gl_capture made = nullptr;
    CHECK(nook_gl_capture_create(fixture.gl.get(), &desc, &made) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(made == nullptr);
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(word) != std::string::npos);
  };
  using Desc = nook_gl_capture_desc;
  refused([](Desc& d) { d.probe = nullptr; }, "NULL");
  refused([&](Desc& d) { d.probe = foreign.get(); }, "another nook_gl");
  refused([&](Desc& d) { d.probe = half.get(); }, "hemisphere");
  refused([&](Desc& d) { d.grid = grid.get(); }, "different grids");
  refused([](Desc& d) { d.face_size_px = 3; }, "face_size_px");
  refused([](Desc& d) { d.face_size_px = 513; }, "face_size_px");
  refused([](Desc& d) { d.level = 16; }, "level");
  refused([](Desc& d) { d.history = 0; }, "history");
  refused([](Desc& d) { d.light = 2; }, "light");
  refused([](Desc& d) { d.match_sh = 2; }, "match_sh");
  refused([](Desc& d) { d.reserved = 1; }, "reserved");

  Trace trace(context);
  trace.limits[is_es(context.gl()) ? GL_MAX_TEXTURE_SIZE : GL_MAX_TEXTURE_BUFFER_SIZE] =
      is_es(context.gl()) ? 32 : 65536;
  Fixture small(context, trace);
  const GlProbe many = small.upload(black_grid(probe::vogel_basis(12), {60, 50, 1}));
  nook_gl_capture_desc desc = default_desc();
  desc.probe = many.get();
  nook_gl_capture made = nullptr;
  if (!is_es(context.gl()))
    CHECK(nook_gl_capture_create(small.gl.get(), &desc, &made) == NOOK_ERROR_UNSUPPORTED);
}

TEST_CASE("a capture keeps its textures, outlives its nook_gl, and leaves nothing") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  const Probe black = loaded(host.handle, black_grid(probe::vogel_basis(12)));
  CubeTextures cubes(context.gl());
  nook_gl_upload probe = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl, black.get(), NOOK_GL_PROBE_LOBES, &probe));
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(probe, &info));
  nook_gl_capture_desc desc = default_desc();
  desc.probe = probe;
  desc.face_size_px = 4;
  nook_gl_capture capture = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_capture_create(gl, &desc, &capture));
  nook_gl_upload_destroy(&probe);
  nook_gl_destroy(&gl);
  CHECK(context.gl().IsTexture(info.textures[0].texture));
  NOOK_OK_OR_FAIL(nook_gl_capture_add(capture, 0, cubes.make(Cube(4)), 0));
  nook_gl_capture_destroy(&capture);
  CHECK(capture == nullptr);
  CHECK_FALSE(context.gl().IsTexture(info.textures[0].texture));
  nook_gl_capture_destroy(&capture);
  nook_gl_capture_destroy(nullptr);

  gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl, black.get(), NOOK_GL_PROBE_LOBES, &probe));
  desc.probe = probe;
  NOOK_OK_OR_FAIL(nook_gl_capture_create(gl, &desc, &capture));
  NOOK_OK_OR_FAIL(nook_gl_context_lost(gl));
  CHECK(nook_gl_capture_add(capture, 0, 1, 0) == NOOK_ERROR_GL);
  nook_gl_capture_destroy(&capture);
  nook_gl_upload_destroy(&probe);
  nook_gl_destroy(&gl);
}
