// Grids of diffuse light in 3D textures: the GLSL against the CPU, with walls and without, the state
// contract, and what is refused.
#include <nook/nook_gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "platform/program.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/gl/touched_state.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe_file.h"
#include "tests/gl/crowd.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;
using nook::probe::CellWalls;
using nook::probe::Probes;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

struct ProbeDelete {
  void operator()(nook_probe probe) const { nook_probe_destroy(&probe); }
};
using Probe = std::unique_ptr<nook_probe_s, ProbeDelete>;
struct GridDelete {
  void operator()(nook_gl_upload grid) const { nook_gl_upload_destroy(&grid); }
};
using Grid = std::unique_ptr<nook_gl_upload_s, GridDelete>;
struct GlDelete {
  void operator()(nook_gl gl) const { nook_gl_destroy(&gl); }
};
using Gl = std::unique_ptr<nook_gl_s, GlDelete>;

// Numbers that half floats hold, so that textures lose nothing.
float half(float value) {
  return from_half(to_half(value));
}

Probes harmonics_grid(std::array<std::uint32_t, 3> counts) {
  Probes probes;
  probes.basis = probe::harmonic_basis(2);
  probes.grid = {counts, {-1, 0.5f, 2}, {1.5f, 2, 0.75f}};
  Numbers numbers(21);
  for (std::size_t i = 0; i < probes.grid.size() * probes.basis.count; ++i) {
    // Irradiance stays above 0, where shaders cut it off.
    const float low = i % probes.basis.count == 0 ? 4 : -0.5f, high = low + 1;
    const float r = half(numbers.between(low, high)), g = half(numbers.between(low, high));
    probes.coefficients.push_back({r, g, half(numbers.between(low, high))});
  }
  return probes;
}

// Every second cell has walls, with masks that let no side see all probes.
void add_walls(Probes& probes) {
  Numbers numbers(5);
  probes.walls.bias = 0.03125f;
  for (std::size_t cell = 0; cell < probes.grid.cells(); ++cell) {
    CellWalls walls;
    for (std::size_t k = 0; cell % 2 == 0 && k < probe::wall_planes; ++k)
      walls.plane[k] = probe::stored({numbers.direction(), numbers.between(-0.7f, 0.1f)});
    for (std::size_t side = 0; cell % 2 == 0 && side < probe::wall_sides; ++side)
      walls.counts[side] = std::uint8_t(1 + 250 * numbers.between(0, 1));
    probes.walls.cell.push_back(walls);
  }
}

Probe loaded(nook_context context, const Probes& probes) {
  const std::vector<std::byte> file = probe::write_probes(probes, probe::Packing::float32);
  nook_probe probe = nullptr;
  NOOK_OK_OR_FAIL(nook_probe_load(context, file.data(), file.size(), &probe));
  return Probe(probe);
}

struct Place {
  Vec3 position_ws, normal;
};

// Places in the grid and round it, none so near a plane that rounding could take it to the other side.
std::vector<Place> random_places(const Probes& probes, std::size_t count) {
  Numbers numbers(8);
  std::vector<Place> places;
  while (places.size() < count) {
    const Place place{Vec3{0, 1, 3} + numbers.place(4), numbers.direction()};
    bool clear = true;
    if (probes.walls.any()) {
      const auto at = probe::place_in(probes.grid, place.position_ws + place.normal * probes.walls.bias);
      for (const probe::WallPlane& plane : probes.walls.cell[at.cell].plane)
        clear = clear && std::abs(dot(plane.normal, at.in_cell) + plane.offset) > 1e-4f;
    }
    if (clear) places.push_back(place);
  }
  return places;
}

const char* const vertex_text =
    "void main() { gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0); }\n";
const char* const fragment_text =
    "uniform highp sampler2D queries; out vec4 answer;\n"
    "void main() {\n"
    "  int first = 2 * int(gl_FragCoord.x);\n"
    "  answer = vec4(nook_grid_irradiance(texelFetch(queries, ivec2(first, 0), 0).xyz,\n"
    "                                     texelFetch(queries, ivec2(first + 1, 0), 0).xyz), 1.0);\n"
    "}\n";

nook_gl_upload_info info_of(const Grid& grid) {
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(grid.get(), &info));
  return info;
}

std::vector<float> drawn(const GladGLContext& gl, const nook_gl_upload_info& grid,
                         const std::vector<Place>& places) {
  const int width = int(places.size());
  std::vector<float> texels;
  for (const Place& place : places)
    for (const Vec3 v : {place.position_ws, place.normal}) texels.insert(texels.end(), {v.x, v.y, v.z, 0});
  Textures textures(gl);
  const GLuint questions = textures.floats(GL_RGBA32F, 4, 2 * width, 1, texels),
               answers = textures.floats(GL_RGBA32F, 4, width, 1, {});
  GLuint framebuffer, array;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &array);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, questions);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, answers, 0);
  gl.Viewport(0, 0, width, 1);
  const GLuint program =
      platform::link_program(gl, {glsl_header(gl), vertex_text}, {glsl_header(gl), grid.glsl, fragment_text});
  gl.UseProgram(program);
  gl.BindTexture(GL_TEXTURE_3D, grid.textures[0].texture);
  gl.Uniform1i(gl.GetUniformLocation(program, "nook_grid_texels"), 0);
  gl.Uniform1i(gl.GetUniformLocation(program, "queries"), 1);
  gl.Uniform4fv(gl.GetUniformLocation(program, "nook_grid_frame"), 4, grid.constant_values);
  gl.BindVertexArray(array);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> rgb = read_texture(gl, answers, width, 1, 3);
  gl.BindTexture(GL_TEXTURE_3D, 0);
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteProgram(program);
  gl.DeleteVertexArrays(1, &array);
  gl.DeleteFramebuffers(1, &framebuffer);
  return rgb;
}

std::vector<float> computed(nook_probe probe, const std::vector<Place>& places) {
  std::vector<float> positions, normals, rgb(3 * places.size());
  for (const auto& [p, n] : places) {
    positions.insert(positions.end(), {p.x, p.y, p.z});
    normals.insert(normals.end(), {n.x, n.y, n.z});
  }
  NOOK_OK_OR_FAIL(nook_probe_irradiance(probe, positions.data(), normals.data(), rgb.data(), places.size()));
  for (float& channel : rgb) channel = std::max(channel, 0.0f);
  return rgb;
}

// ZH3 is interpolated as its five numbers.
std::vector<float> computed_zonal(const Probes& probes, const std::vector<Place>& places) {
  Probes zonal = probes;
  zonal.basis.count = probe::zonal_count;
  zonal.coefficients.clear();
  for (std::size_t p = 0; p < probes.grid.size(); ++p)
    for (const Vec3 v : probe::to_zonal(probes.of(p)))
      zonal.coefficients.push_back({half(v.x), half(v.y), half(v.z)});
  std::vector<float> rgb;
  std::array<Vec3, probe::zonal_count> light;
  for (const Place& place : places) {
    probe::interpolate(zonal, place.position_ws, place.normal, light);
    const Vec3 e = probe::zonal_irradiance(light, place.normal);
    for (const float channel : {e.x, e.y, e.z}) rgb.push_back(std::max(channel, 0.0f));
  }
  return rgb;
}

void compare(const std::vector<float>& found, const std::vector<float>& expected) {
  REQUIRE(found.size() == expected.size());
  const float largest = *std::ranges::max_element(expected);
  float worst = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    worst = std::max(worst, std::isfinite(found[i]) ? std::abs(found[i] - expected[i]) : INFINITY);
  INFO("worst " << worst << " largest " << largest);
  // Texture units filter with shares of 8 bits or more: three axes of 2^-9 each, times neighbours that differ
  // by less than the half of the largest value here.
  CHECK(worst <= 3 * 0.5f / 512 * largest);
}

struct Fixture {
  explicit Fixture(platform::Context& context, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE)
      : gl(create_gl(host.handle, platform::Context::loader, &context, 0, mode)) {}
  explicit Fixture(Trace& trace) : gl(create_gl(host.handle, Trace::loader, &trace, 0)) {}
  Grid upload(const Probe& probe, nook_gl_probe_form form = NOOK_GL_PROBE_SH) {
    nook_gl_upload made = nullptr;
    NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl.get(), probe.get(), form, &made));
    return Grid(made);
  }
  CountedContext host;
  Gl gl;
};

}  // namespace

TEST_CASE("grids in 3D textures agree with the CPU, with walls and without") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  for (const auto& counts : {std::array<std::uint32_t, 3>{3, 2, 4}, {1, 5, 1}, {2, 1, 2}, {1, 1, 1}})
    for (const bool walls : {false, true}) {
      Probes probes = harmonics_grid(counts);
      if (walls) add_walls(probes);
      const Probe probe = loaded(fixture.host.handle, probes);
      const std::vector<Place> places = random_places(probes, 200);
      const Grid whole = fixture.upload(probe);
      CHECK(info_of(whole).walls == int(walls));
      CHECK(info_of(whole).bytes == 8 * probes.grid.size() * (walls ? 12 : 7));
      INFO("counts " << counts[0] << " x " << counts[1] << " x " << counts[2] << ", walls " << walls);
      compare(drawn(context.gl(), info_of(whole), places), computed(probe.get(), places));
      const Grid zonal = fixture.upload(probe, NOOK_GL_PROBE_ZH3);
      CHECK(info_of(zonal).bytes == 8 * probes.grid.size() * (walls ? 9 : 4));
      compare(drawn(context.gl(), info_of(zonal), places), computed_zonal(probes, places));
    }
}

TEST_CASE("a thin wall between two lights is seen from one side only") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  Probes probes;
  probes.basis = probe::harmonic_basis(2);
  probes.grid = {{2, 1, 1}, {0, 0, 0}, {2, 1, 1}};
  probes.coefficients.assign(18, {});
  const float one = float(std::sqrt(4 * std::numbers::pi));
  probes.coefficients[0] = {one, one, one};
  probes.coefficients[9] = {8 * one, 8 * one, 8 * one};
  probes.walls.bias = 0.015625f;
  CellWalls walls;
  walls.plane[0] = {{-1, 0, 0}, 0.75f};  // x = 1.5 metres
  walls.counts = {0x55, 0xaa, 0x55, 0xaa, 0x55, 0xaa, 0x55, 0xaa};
  probes.walls.cell.push_back(walls);
  const std::vector<Place> places{{{1.5f, 0, 0}, {-1, 0, 0}}, {{1.5f, 0, 0}, {1, 0, 0}},
                                  {{1.4f, 0, 0}, {0, 1, 0}},  {{1.6f, 0, 0}, {0, 1, 0}},
                                  {{-9, 0, 0}, {0, 0, 1}},    {{9, 0, 0}, {0, 0, 1}}};
  const Probe probe = loaded(fixture.host.handle, probes);
  const std::vector<float> expected = computed(probe.get(), places);
  // Constant light of 1 before the wall and of 8 behind it: irradiance pi and 8 pi everywhere.
  for (std::size_t i = 0; i < places.size(); ++i)
    CHECK(std::abs(expected[3 * i] - (i % 2 == 0 ? pi : 8 * pi)) < 1e-4f);
  for (const nook_gl_probe_form form : {NOOK_GL_PROBE_SH, NOOK_GL_PROBE_ZH3}) {
    const std::vector<float> found = drawn(context.gl(), info_of(fixture.upload(probe, form)), places);
    // Half floats have 11 bits.
    for (std::size_t i = 0; i < found.size(); ++i)
      CHECK(std::abs(found[i] - expected[i]) <= expected[i] / 2048);
  }
}

TEST_CASE("lobes are uploaded as their harmonics") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  Probes probes;
  probes.basis = probe::vogel_basis(12);
  Numbers numbers(3);
  for (int i = 0; i < 12; ++i) probes.coefficients.push_back(Vec3{1, 1, 1} * numbers.between(0.5f, 1));
  const Probe probe = loaded(fixture.host.handle, probes);
  const std::vector<Place> places = random_places(probes, 50);
  const std::vector<float> found = drawn(context.gl(), info_of(fixture.upload(probe)), places),
                           expected = computed(probe.get(), places);
  // Bands 0 to 2 against bands to 4 of lobes: band 4 of the clamped cosine is a 24th of band 0, and of smooth
  // lobes little is left there; half floats have 11 bits.
  for (std::size_t i = 0; i < found.size(); ++i)
    CHECK(std::abs(found[i] - expected[i]) < 0.01f * expected[i]);
}

TEST_CASE("an update shows the new grid under the old name") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  Probes second = harmonics_grid({3, 3, 2});
  const Grid grid = fixture.upload(loaded(fixture.host.handle, harmonics_grid({2, 2, 2})));
  const GLuint name = info_of(grid).textures[0].texture;
  add_walls(second);
  const Probe probe = loaded(fixture.host.handle, second);
  NOOK_OK_OR_FAIL(nook_gl_update_probe(grid.get(), probe.get()));
  CHECK(info_of(grid).textures[0].texture == name);
  CHECK(info_of(grid).walls == 1);
  const std::vector<Place> places = random_places(second, 50);
  compare(drawn(context.gl(), info_of(grid), places), computed(probe.get(), places));
}

TEST_CASE("uploading a grid keeps the promises on OpenGL state") {
  NOOK_NEED_CONTEXT(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    Fixture fixture(context, mode);
    const Probe probe = loaded(fixture.host.handle, harmonics_grid({3, 2, 2}));
    Poison poison(context, gl::grids);
    const StateValues touched = poison.touched(), untouched = poison.untouched();
    const Grid grid = fixture.upload(probe);
    NOOK_OK_OR_FAIL(nook_gl_update_probe(grid.get(), probe.get()));
    INFO("mode " << mode);
    CHECK(poison.untouched() == untouched);
    if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
    if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
  }
}

TEST_CASE("a grid that no 3D texture can hold is refused, and the old one stays") {
  NOOK_NEED_CONTEXT(context);
  Trace trace(context);
  trace.limits[GL_MAX_3D_TEXTURE_SIZE] = 256;  // the minimum of every context
  Fixture fixture(trace);
  const Probe small = loaded(fixture.host.handle, harmonics_grid({2, 2, 36}));
  const Grid grid = fixture.upload(small);
  const Probe deep = loaded(fixture.host.handle, harmonics_grid({2, 2, 37}));
  CHECK(nook_gl_update_probe(grid.get(), deep.get()) == NOOK_ERROR_UNSUPPORTED);
  CHECK(std::string(nook_last_message()).find("2 x 2 x 259") != std::string::npos);
  const std::vector<Place> places = random_places(harmonics_grid({2, 2, 36}), 20);
  compare(drawn(context.gl(), info_of(grid), places), computed(small.get(), places));

  Probes bright = harmonics_grid({1, 1, 2});
  bright.coefficients[9] = {7e4f, 0, 0};
  nook_gl_upload made = nullptr;
  CHECK(nook_gl_upload_probe(fixture.gl.get(), loaded(fixture.host.handle, bright).get(), 0, &made) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(nook_last_message()).find("probe 1") != std::string::npos);
  Probes dice;
  dice.basis = probe::dice_basis(probe::Domain::sphere, {0, 1, 0});
  dice.coefficients.assign(12, {1, 1, 1});
  CHECK(nook_gl_upload_probe(fixture.gl.get(), loaded(fixture.host.handle, dice).get(), 0, &made) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_probe(fixture.gl.get(), small.get(), 2, &made) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_probe(fixture.gl.get(), nullptr, 0, &made) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_probe(nullptr, small.get(), 0, &made) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_probe(fixture.gl.get(), small.get(), 0, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_describe(nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(made == nullptr);
}

TEST_CASE("a grid outlives its nook_gl, and a lost context needs no call") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  const Probe probe = loaded(host.handle, harmonics_grid({2, 2, 2}));
  nook_gl_upload grid = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl, probe.get(), NOOK_GL_PROBE_ZH3, &grid));
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(grid, &info));
  nook_gl_destroy(&gl);
  CHECK(context.gl().IsTexture(info.textures[0].texture));
  nook_gl_upload_destroy(&grid);
  CHECK(grid == nullptr);
  CHECK_FALSE(context.gl().IsTexture(info.textures[0].texture));
  nook_gl_upload_destroy(&grid);
  nook_gl_upload_destroy(nullptr);

  gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl, probe.get(), NOOK_GL_PROBE_ZH3, &grid));
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(grid, &info));
  NOOK_OK_OR_FAIL(nook_gl_context_lost(gl));
  CHECK(nook_gl_update_probe(grid, probe.get()) == NOOK_ERROR_GL);
  nook_gl_upload_destroy(&grid);
  nook_gl_destroy(&gl);
  // A lost context would have deleted the texture.
  context.gl().DeleteTextures(1, &info.textures[0].texture);
}
