// Cube maps that become probes on the GPU: closed forms, the CPU's fit of the same texels, suns, averages
// over maps, and the textures that shaders read.
#include <cmath>
#include <limits>
#include <string>

#include "platform/program.h"
#include "sdk/src/core/light_map.h"
#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe_light.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/probe_capture_scene.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// The CPU's fit of a cube map's texels.
std::vector<Vec3> fitted(const probe::Basis& basis, const Cube& cube, probe::FitMethod method) {
  probe::FitSettings settings;
  settings.method = method;
  probe::Fit fit(basis, settings);
  for (std::size_t i = 0; i < cube.rgb.size() / 3; ++i) {
    const MapTexel texel = cube.texel(i);
    const float weight = float(texel.solid_angle);
    fit.add_samples(&texel.direction.x, &cube.rgb[3 * i], &weight, 1);
  }
  std::vector<Vec3> coefficients(basis.count);
  fit.read(coefficients);
  return coefficients;
}

std::vector<Vec3> projected(const Cube& cube) {
  return fitted(probe::harmonic_basis(2), cube, probe::FitMethod::moments);
}

// The largest difference of a channel of radiance or irradiance over 500 directions, relative to the mean
// radiance, or to pi times it.
struct Difference {
  float radiance = 0, irradiance = 0;
};
Difference difference(const probe::Basis& basis, const std::vector<Vec3>& a, const std::vector<Vec3>& b,
                      float mean) {
  Numbers numbers(77);
  std::vector<Vec3> delta(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) delta[i] = a[i] - b[i];
  Difference worst;
  for (int i = 0; i < 500; ++i) {
    const Vec3 d = numbers.direction(), l = probe::radiance(basis, delta, d),
               e = probe::irradiance(basis, delta, probe::IrradianceForm::bands, d);
    for (const float channel : {l.x, l.y, l.z})
      worst.radiance = std::max(worst.radiance, std::abs(channel) / mean);
    for (const float channel : {e.x, e.y, e.z})
      worst.irradiance = std::max(worst.irradiance, std::abs(channel) / (pi * mean));
  }
  return worst;
}

float mean_radiance(const Cube& cube) {
  const std::vector<Vec3> harmonics = projected(cube);
  return (harmonics[0].x + harmonics[0].y + harmonics[0].z) / 3 / std::sqrt(4 * pi);
}

// Texels of the table that shaders read, through the GLSL of the library.
std::vector<float> table_texels(const GladGLContext& gl, nook_gl_upload probe, int count) {
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(probe, &info));
  Textures textures(gl);
  const GLuint answers = textures.floats(GL_RGBA32F, 4, count, 1, {});
  GLuint framebuffer, array;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &array);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, answers, 0);
  gl.Viewport(0, 0, count, 1);
  const GLuint program = platform::link_program(
      gl,
      {glsl_header(gl),
       "void main() { gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0); "
       "}\n"},
      {glsl_header(gl), info.glsl,
       "out vec4 answer; void main() { answer = nook_texel(nook_probe_texels, int(gl_FragCoord.x)); }\n"});
  gl.UseProgram(program);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(table_target(gl), info.textures[0].texture);
  gl.Uniform1i(gl.GetUniformLocation(program, "nook_probe_texels"), 0);
  gl.BindVertexArray(array);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> texels = read_texture(gl, answers, count, 1, 4);
  gl.BindTexture(table_target(gl), 0);
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteProgram(program);
  gl.DeleteVertexArrays(1, &array);
  gl.DeleteFramebuffers(1, &framebuffer);
  return texels;
}

}  // namespace

TEST_CASE("constant light and one cosine become their closed forms") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const probe::Basis basis = probe::vogel_basis(12);
  const GlProbe probe = fixture.upload(black_grid(basis));
  for (const std::uint32_t size : {4u, 64u, 65u}) {
    nook_gl_capture_desc desc = default_desc();
    desc.probe = probe.get();
    desc.face_size_px = size;
    const Capture capture = fixture.capture(desc);
    INFO("faces of " << size);
    // Solid angles are exact, whatever the size: sums of a few hundred floats of 24 bits.
    add(capture, 0, fixture.cubes.make(Cube(size, [](Vec3) { return Vec3{1, 2, 0.5f}; })));
    nook_gl_capture_info result = read(capture);
    CHECK(result.maps == 1);
    CHECK(std::abs(result.used_solid_angle - 4 * pi) < 4 * pi * 2e-6f);
    CHECK(std::abs(result.harmonics[0] - std::sqrt(4 * pi)) < 1e-5f);
    CHECK(std::abs(result.harmonics[1] - 2 * std::sqrt(4 * pi)) < 2e-5f);
    for (int i = 3; i < 18; ++i) CHECK(std::abs(result.harmonics[i]) < 2e-5f);

    // Radiance 1 + z / 2: irradiance pi + (2 pi / 3) n.z / 2. A texel has the light of its centre: the error
    // of the rule of midpoints is the square of half a texel.
    add(capture, 0, fixture.cubes.make(Cube(size, [](Vec3 d) { return Vec3{1, 1, 1} * (1 + 0.5f * d.z); })));
    result = read(capture);
    const float midpoint = 1.0f / float(size * size);
    CHECK(std::abs(result.harmonics[6] - 0.5f * std::sqrt(4 * pi / 3)) < midpoint);
    const std::vector<Vec3> lobes = solved(capture, 12);
    for (const Vec3 n : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{0, 0.6f, 0.8f}}) {
      const Vec3 e = probe::irradiance(basis, lobes, probe::IrradianceForm::bands, n);
      // Lobes that have the light's bands 0 to 2 may have a band 4, and a 24th of it counts.
      CHECK(std::abs(e.x - (pi + pi / 3 * n.z)) < 0.01f * pi + midpoint);
    }
  }
}

TEST_CASE("a cube map becomes the CPU's fit of its texels, in lobes and harmonics") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  for (const auto& [lobes, ambient] : {std::pair{12u, false}, {6u, true}, {31u, true}})
    for (const std::uint32_t size : {16u, 64u}) {
      const probe::Basis basis = probe::vogel_basis(lobes, ambient);
      const Cube cube = uneven_cube(size, 9 + lobes);
      const GlProbe probe = fixture.upload(black_grid(basis));
      nook_gl_capture_desc desc = default_desc();
      desc.probe = probe.get();
      desc.face_size_px = size;
      const Capture capture = fixture.capture(desc);
      add(capture, 0, fixture.cubes.make(cube));
      const float mean = mean_radiance(cube);
      const std::vector<Vec3> found = solved(capture, basis.count);
      const Difference moments =
          difference(basis, found, fitted(basis, cube, probe::FitMethod::moments), mean);
      const Difference squares =
          difference(basis, found, fitted(basis, cube, probe::FitMethod::least_squares), mean);
      INFO("lobes " << lobes << ", faces of " << size << ": moments " << moments.radiance << ", "
                    << moments.irradiance << ", least squares " << squares.radiance << ", "
                    << squares.irradiance);
      // The promise, 0.2 % of the mean; floats have a hundred times more digits than that.
      CHECK(moments.radiance < 2e-3f);
      CHECK(moments.irradiance < 2e-4f);
      // Least squares takes the Gram matrix of the texels, which differs from the sphere's by the rule of
      // midpoints.
      if (size == 64) CHECK(squares.irradiance < 2e-3f);
      const std::vector<Vec3> harmonics = projected(cube);
      const nook_gl_capture_info result = read(capture);
      for (std::size_t i = 0; i < 9; ++i)
        CHECK(std::abs(result.harmonics[3 * i + 1] - harmonics[i].y) < 1e-4f * mean);
    }
}

TEST_CASE("shaders find the light of a capture in the textures of its probe and grid") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const probe::Basis basis = probe::vogel_basis(12);
  Probes baked = black_grid(basis, {3, 2, 2});
  for (std::size_t i = 0; i < baked.coefficients.size(); ++i) baked.coefficients[i] = {float(i), 1, 2};
  const Cube cube = uneven_cube(16, 4);
  const std::uint32_t index = 7;  // x 1, y 0, z 1
  for (const nook_gl_probe_form form : {NOOK_GL_PROBE_SH, NOOK_GL_PROBE_ZH3}) {
    const GlProbe probe = fixture.upload(baked);
    const Grid grid = fixture.upload_grid(baked, form);
    nook_gl_capture_desc desc = default_desc();
    desc.probe = probe.get();
    desc.grid = grid.get();
    desc.face_size_px = 16;
    const Capture capture = fixture.capture(desc);
    add(capture, index, fixture.cubes.make(cube));

    const int texel_count = 3 + 12 * 13;
    const std::vector<float> texels = table_texels(context.gl(), probe.get(), texel_count);
    const std::vector<Vec3> lobes = solved(capture, 12, index);
    for (std::size_t p = 0; p < 12; ++p)
      for (std::size_t i = 0; i < 12; ++i) {
        const Vec3 expected = p == index ? lobes[i] : baked.coefficients[12 * p + i];
        // The reading of the CPU multiplies in another order.
        CHECK(std::abs(texels[4 * (3 + 12 * (1 + p) + i)] - expected.x) <=
              1e-4f * std::abs(expected.x) + 1e-4f);
      }

    nook_gl_upload_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_gl_upload_describe(grid.get(), &info));
    const std::vector<Vec3> harmonics = projected(cube);
    std::vector<Vec3> expected(harmonics.begin(), harmonics.end());
    if (form == NOOK_GL_PROBE_ZH3) {
      const auto zonal = probe::to_zonal(harmonics);
      expected.assign(zonal.begin(), zonal.end());
    }
    const int layers = form == NOOK_GL_PROBE_ZH3 ? 4 : 7;
    for (int layer = 0; layer < layers; ++layer) {
      const std::vector<float> slice =
          read_texture(context.gl(), info.textures[0].texture, 3, 2, 4, 2 * layer + 1);
      for (int c = 0; c < 4 && 4 * layer + c < int(3 * expected.size()); ++c) {
        const int number = 4 * layer + c;
        const Vec3 colour = expected[std::size_t(number / 3)];
        const float value = number % 3 == 0 ? colour.x : number % 3 == 1 ? colour.y : colour.z;
        // Half floats have 11 bits.
        CHECK(std::abs(slice[std::size_t(4 + c)] - value) < std::abs(value) / 1024 + 1e-4f);
      }
    }
  }
}

TEST_CASE("a grid alone takes captures, and solves to harmonics") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const Grid grid = fixture.upload_grid(black_grid(probe::harmonic_basis(2), {1, 1, 3}), 0);
  nook_gl_capture_desc desc = default_desc();
  desc.grid = grid.get();
  desc.face_size_px = 8;
  const Capture capture = fixture.capture(desc);
  const Cube cube = uneven_cube(8, 12);
  add(capture, 2, fixture.cubes.make(cube));
  const std::vector<Vec3> expected = projected(cube), found = solved(capture, 9, 2);
  for (std::size_t i = 0; i < 9; ++i) CHECK(std::abs(found[i].z - expected[i].z) < 1e-4f);
  for (const Vec3 dark : solved(capture, 9, 1)) CHECK(dark.x == 0);
}

TEST_CASE("maps are averaged as long as the history, and a reset forgets them") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const GlProbe probe = fixture.upload(black_grid(probe::vogel_basis(12), {2, 1, 1}));
  nook_gl_capture_desc desc = default_desc();
  desc.probe = probe.get();
  desc.face_size_px = 4;
  desc.history = 3;
  const Capture capture = fixture.capture(desc);
  const auto add_light = [&](float light, std::int32_t restart = 0) {
    const GLuint cube = fixture.cubes.make(Cube(4, [&](Vec3) { return Vec3{light, light, light}; }));
    NOOK_OK_OR_FAIL(nook_gl_capture_add(capture.get(), 1, cube, restart));
    return read(capture, 1).harmonics[0] / std::sqrt(4 * pi);
  };
  // The mean of all maps so far, then two thirds of it and a third of the new one.
  CHECK(std::abs(add_light(3) - 3) < 1e-5f);
  CHECK(std::abs(add_light(5) - 4) < 1e-5f);
  CHECK(std::abs(add_light(10) - 6) < 1e-5f);
  CHECK(std::abs(add_light(0) - 4) < 1e-5f);
  CHECK(read(capture, 1).maps == 3);
  CHECK(std::abs(add_light(7, 1) - 7) < 1e-5f);
  CHECK(read(capture, 1).maps == 1);
  CHECK(read(capture, 0).maps == 0);
}

TEST_CASE("texels that are not finite do not count") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const GlProbe probe = fixture.upload(black_grid(probe::vogel_basis(12)));
  nook_gl_capture_desc desc = default_desc();
  desc.probe = probe.get();
  desc.face_size_px = 16;
  const Capture capture = fixture.capture(desc);
  Cube cube = uneven_cube(16, 6);
  const float infinite = std::numeric_limits<float>::infinity();
  double lost = 0;
  for (const std::size_t i : {5u, 300u, 901u, 1400u}) {
    cube.set(i, i == 300 ? Vec3{1, infinite, 1} : i == 901 ? Vec3{-2e18f, 0, 0} : Vec3{0, 0, not_a_number});
    lost += cube.texel(i).solid_angle;
  }
  add(capture, 0, fixture.cubes.make(cube));
  const nook_gl_capture_info result = read(capture);
  CHECK(std::abs(result.used_solid_angle - (4 * pi - float(lost))) < 1e-4f);
  const std::vector<Vec3> expected = projected(cube);  // the fit skips the same texels
  for (std::size_t i = 0; i < 9; ++i)
    CHECK(std::abs(result.harmonics[3 * i] - expected[i].x) < 1e-4f * (1 + std::abs(expected[i].x)));

  add(capture, 0, fixture.cubes.make(Cube(16, [](Vec3) { return Vec3{not_a_number, 0, 0}; })));
  const nook_gl_capture_info kept = read(capture);
  CHECK(std::equal(kept.harmonics, kept.harmonics + 27, result.harmonics));
  CHECK(kept.used_solid_angle == 0);
}

TEST_CASE("the sky of a cube map agrees with the CPU, and its sun is reported") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const GlProbe probe = fixture.upload(black_grid(probe::vogel_basis(12)));
  nook_gl_capture_desc desc = default_desc();
  desc.probe = probe.get();
  desc.light = NOOK_GL_CAPTURE_SKY;
  const Capture capture = fixture.capture(desc);
  Cube cube = uneven_cube(64, 8);
  const Vec3 towards = normalised(Vec3{0.3f, 0.9f, -0.4f});
  const std::size_t sun = cube_cell_at(towards, 64);
  for (const std::size_t i : {sun, sun + 1, sun + 64}) cube.set(i, {40000, 30000, 20000});
  add(capture, 0, fixture.cubes.make(cube));

  Vector<float> sky(cube.rgb.begin(), cube.rgb.end(), default_memory());
  const Vector<MapSun> suns = take_suns(cube.view(), sky, default_memory());
  REQUIRE(suns.size() == 1);
  Cube without(64);
  std::copy(sky.begin(), sky.end(), without.rgb.begin());
  const std::vector<Vec3> expected = projected(without);
  const nook_gl_capture_info result = read(capture);
  // Both stop near the limit of the same rounds, 1e-3 of it apart; what is left of the sun there has a
  // twentieth of the light.
  for (std::size_t i = 0; i < 9; ++i)
    CHECK(std::abs(result.harmonics[3 * i] - expected[i].x) < 1e-3f * expected[0].x);
  CHECK(std::abs(result.sun_irradiance[0] - suns[0].irradiance.x) < 1e-3f * suns[0].irradiance.x);
  CHECK(std::abs(result.sun_irradiance[2] - suns[0].irradiance.z) < 1e-3f * suns[0].irradiance.z);
  CHECK(std::abs(result.sun_solid_angle - suns[0].solid_angle) < 1e-5f);
  const Vec3 direction{result.sun_direction[0], result.sun_direction[1], result.sun_direction[2]};
  CHECK(length(direction - suns[0].direction) < 1e-4f);

  // Light without a sun, and none at all, stay what they are.
  const Cube plain = uneven_cube(64, 3);
  add(capture, 0, fixture.cubes.make(plain));
  CHECK(std::abs(read(capture).harmonics[0] - projected(plain)[0].x) < 1e-4f * projected(plain)[0].x);
  CHECK(read(capture).sun_solid_angle == 0);
  add(capture, 0, fixture.cubes.make(Cube(64)));
  CHECK(read(capture).harmonics[0] == 0);
}

TEST_CASE("a level of a cube map is read in place of the first") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const GlProbe probe = fixture.upload(black_grid(probe::vogel_basis(12)));
  const GLuint name = fixture.cubes.make(uneven_cube(16, 1));
  const Cube half = uneven_cube(8, 2);
  fixture.cubes.fill(name, half, 1);
  for (GLint level = 2; level <= 4; ++level) fixture.cubes.fill(name, Cube(8u >> (level - 1)), level);
  nook_gl_capture_desc desc = default_desc();
  desc.probe = probe.get();
  desc.face_size_px = 8;
  desc.level = 1;
  const Capture capture = fixture.capture(desc);
  add(capture, 0, name);
  CHECK(std::abs(read(capture).harmonics[1] - projected(half)[0].y) < 1e-4f);
}
