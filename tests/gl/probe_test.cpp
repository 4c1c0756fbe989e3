// Probes in shaders: the GLSL against the CPU, the grid, the state contract, and what is refused.
#include <nook/experimental/nook_sg.h>
#include <nook/nook_gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "platform/program.h"
#include "sdk/src/gl/touched_state.h"
#include "tests/gl/crowd.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

struct ProbeDelete {
  void operator()(nook_probe probe) const { nook_probe_destroy(&probe); }
};
using Probe = std::unique_ptr<nook_probe_s, ProbeDelete>;
struct GlProbeDelete {
  void operator()(nook_gl_upload probe) const { nook_gl_upload_destroy(&probe); }
};
using GlProbe = std::unique_ptr<nook_gl_upload_s, GlProbeDelete>;
struct GlDelete {
  void operator()(nook_gl gl) const { nook_gl_destroy(&gl); }
};
using Gl = std::unique_ptr<nook_gl_s, GlDelete>;

struct ProbeRequest {
  std::vector<float> sharpnesses{2, 6, 6, 12, 30, 0.2f, 1.24f, 1.26f, 80, 6, 6, 6};
  int ambient = 1;
  std::uint32_t counts[3] = {1, 1, 1};
  nook_probe_basis basis = NOOK_PROBE_BASIS_LOBES;
};

// A grid of fits, each to a dim sky with another lamp, under which the light's lobes ring below 0.
Probe make_fitted_probe(nook_context context) {
  nook_probe_fit_desc fit_desc;
  NOOK_OK_OR_FAIL(nook_probe_fit_desc_init(&fit_desc));
  nook_probe_desc desc;
  NOOK_OK_OR_FAIL(nook_probe_desc_init(&desc));
  const std::uint32_t counts[3] = {2, 1, 3};
  std::copy_n(counts, 3, desc.counts);
  std::vector<nook_probe_fit> fits(6);
  Numbers numbers(3);
  for (nook_probe_fit& fit : fits) {
    NOOK_OK_OR_FAIL(nook_probe_fit_create(context, &fit_desc, &fit));
    const Vec3 lamp = numbers.direction();
    for (int i = 0; i < 4096; ++i) {
      const Vec3 d = numbers.direction();
      const float direction[3] = {d.x, d.y, d.z}, light = dot(d, lamp) > 0.9f ? 20.0f : 0.5f;
      const float radiance[3] = {light, 0.8f * light, 1};
      NOOK_OK_OR_FAIL(nook_probe_fit_add_samples(fit, direction, radiance, nullptr, 1));
    }
  }
  desc.fits = fits.data();
  desc.fit_count = 6;
  nook_probe probe = nullptr;
  NOOK_OK_OR_FAIL(nook_probe_create(context, &desc, &probe));
  for (nook_probe_fit& fit : fits) nook_probe_fit_destroy(&fit);
  return Probe(probe);
}

Probe make_probe(nook_context context, const ProbeRequest& request, unsigned seed = 1) {
  nook_probe_fit_desc fit_desc;
  NOOK_OK_OR_FAIL(nook_probe_fit_desc_init(&fit_desc));
  fit_desc.basis = request.basis;
  fit_desc.lobe_count = std::uint32_t(request.sharpnesses.size());
  fit_desc.sharpnesses = request.sharpnesses.data();
  fit_desc.ambient = request.basis == NOOK_PROBE_BASIS_LOBES ? request.ambient : 0;
  nook_probe_fit fit = nullptr;
  NOOK_OK_OR_FAIL(nook_probe_fit_create(context, &fit_desc, &fit));
  nook_probe_fit_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_probe_fit_describe(fit, &info));
  nook_probe_desc desc;
  NOOK_OK_OR_FAIL(nook_probe_desc_init(&desc));
  desc.functions = fit;
  std::copy_n(request.counts, 3, desc.counts);
  const float origin[3] = {-1, 0.5f, 2}, spacing[3] = {1.5f, 2, 0.75f};
  std::copy_n(origin, 3, desc.origin_ws);
  std::copy_n(spacing, 3, desc.spacing_ws);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> amplitude(0, 2);
  std::vector<float> coefficients(std::size_t(3) * info.function_count * desc.counts[0] * desc.counts[1] *
                                  desc.counts[2]);
  for (float& c : coefficients) c = amplitude(random);
  desc.coefficients = coefficients.data();
  nook_probe probe = nullptr;
  NOOK_OK_OR_FAIL(nook_probe_create(context, &desc, &probe));
  nook_probe_fit_destroy(&fit);
  return Probe(probe);
}

std::vector<nook_lobe> lobes_of(nook_probe probe, const float* position_ws) {
  nook_probe_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_probe_describe(probe, &info));
  std::vector<nook_lobe> lobes(info.function_count);
  NOOK_OK_OR_FAIL(nook_probe_read_lobes(probe, position_ws, lobes.data(), info.function_count));
  return lobes;
}

// The lobes that glossy reflection reads: the light's if the probe has no others.
std::vector<nook_lobe> gloss_of(nook_probe probe, const float* position_ws) {
  std::vector<nook_lobe> lobes = lobes_of(probe, position_ws);
  const nook_result result =
      nook_probe_read_gloss(probe, position_ws, lobes.data(), std::uint32_t(lobes.size()));
  if (result != NOOK_ERROR_UNSUPPORTED) NOOK_OK_OR_FAIL(result);
  return lobes;
}

nook_gl_upload_info info_of(const GlProbe& probe) {
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(probe.get(), &info));
  return info;
}

// One pixel's question: five texels.
struct Query {
  Vec3 position_ws;
  Vec3 normal;
  Vec3 view;
  Vec3 tangent;
  float alpha_x, alpha_y, reflectance;
};

std::vector<Query> random_queries(std::size_t count) {
  Numbers numbers(8);
  std::vector<Query> queries;
  while (queries.size() < count) {
    Query q{};
    q.position_ws = numbers.place(4);
    q.normal = numbers.direction();
    q.view = numbers.direction();
    // The warp has no meaning for surfaces that turn away.
    if (dot(q.normal, q.view) < 0.02f) q.view = normalised(q.normal + q.view * 0.9f);
    q.tangent = normalised(cross(q.normal, numbers.direction()));
    q.alpha_x = numbers.between(0.02f, 1);
    q.alpha_y = queries.size() % 2 ? q.alpha_x : numbers.between(0.02f, 1);
    q.reflectance = numbers.between(0, 1);
    queries.push_back(q);
  }
  return queries;
}

enum Answer { radiance, bands, fitted, inner_product, isotropic, anisotropic, answer_count };

const char* const vertex_text =
    "void main() { gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0); }\n";
const char* const fragment_text =
    "uniform highp sampler2D queries; out vec4 answer;\n"
    "vec4 query(int i) { return texelFetch(queries, ivec2(i, 0), 0); }\n"
    "void main() {\n"
    "  int first = 5 * int(gl_FragCoord.x);\n"
    "  NookProbePlace place = nook_probe_place(query(first).xyz);\n"
    "  vec3 n = query(first + 1).xyz; vec4 last = query(first + 4);\n"
    "  NookProbeSurface s = NookProbeSurface(n, query(first + 2).xyz,\n"
    "                                        query(first + 3).xyz, last.xy, last.z);\n"
    "  vec3 a;\n"
    "  switch (int(gl_FragCoord.y)) {\n"
    "    case 0: a = nook_probe_radiance(place, n); break;\n"
    "    case 1: a = nook_probe_irradiance(place, n); break;\n"
    "    case 2: a = nook_probe_irradiance_fitted(place, n); break;\n"
    "    case 3: a = nook_probe_irradiance_inner_product(place, n); break;\n"
    "    case 4: s.alpha = vec2(sqrt(s.alpha.x * s.alpha.y));\n"
    "      a = nook_probe_specular_isotropic(place, s); break;\n"
    "    default: a = nook_probe_specular_anisotropic(place, s); break;\n"
    "  }\n"
    "  answer = vec4(a, 1.0);\n"
    "}\n";

// answer_count rows of colours, a column for each query.
std::vector<float> ask(const GladGLContext& gl, const nook_gl_upload_info& probe,
                       const std::vector<Query>& queries) {
  const int width = int(queries.size());
  std::vector<float> texels;
  for (const Query& q : queries) {
    for (const Vec3 v : {q.position_ws, q.normal, q.view, q.tangent})
      texels.insert(texels.end(), {v.x, v.y, v.z, 0});
    texels.insert(texels.end(), {q.alpha_x, q.alpha_y, q.reflectance, 0});
  }
  Textures textures(gl);
  const GLuint questions = textures.floats(GL_RGBA32F, 4, 5 * width, 1, texels),
               answers = textures.floats(GL_RGBA32F, 4, width, answer_count, {});
  GLuint framebuffer, array;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &array);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, questions);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, answers, 0);
  gl.Viewport(0, 0, width, answer_count);
  const GLuint program = platform::link_program(gl, {glsl_header(gl), vertex_text},
                                                {glsl_header(gl), probe.glsl, fragment_text});
  gl.UseProgram(program);
  gl.BindTexture(table_target(gl), probe.textures[0].texture);
  gl.Uniform1i(gl.GetUniformLocation(program, "nook_probe_texels"), 0);
  gl.Uniform1i(gl.GetUniformLocation(program, "queries"), 1);
  gl.BindVertexArray(array);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> rgb = read_texture(gl, answers, width, answer_count, 3);
  gl.BindTexture(table_target(gl), 0);
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteProgram(program);
  gl.DeleteVertexArrays(1, &array);
  gl.DeleteFramebuffers(1, &framebuffer);
  return rgb;
}

// The same from nook_probe.h.
std::vector<float> computed(nook_probe probe, const std::vector<Query>& queries) {
  std::vector<float> rgb(3 * queries.size() * answer_count);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Query& q = queries[i];
    const float position[3] = {q.position_ws.x, q.position_ws.y, q.position_ws.z};
    const std::vector<nook_lobe> lobes = lobes_of(probe, position);
    const auto count = std::uint32_t(lobes.size());
    const float n[3] = {q.normal.x, q.normal.y, q.normal.z};
    const nook_probe_surface surface{{n[0], n[1], n[2]},
                                     {q.view.x, q.view.y, q.view.z},
                                     {q.tangent.x, q.tangent.y, q.tangent.z},
                                     q.alpha_x,
                                     q.alpha_y,
                                     q.reflectance};
    // The isotropic form takes one width.
    nook_probe_surface round = surface;
    round.alpha_x = round.alpha_y = std::sqrt(q.alpha_x * q.alpha_y);
    const auto at = [&](Answer answer) { return &rgb[3 * (answer * queries.size() + i)]; };
    NOOK_OK_OR_FAIL(nook_sg_radiance(lobes.data(), count, n, at(radiance), 1));
    const std::pair<nook_probe_irradiance_form, Answer> forms[] = {
        {NOOK_PROBE_IRRADIANCE_BANDS, bands},
        {NOOK_PROBE_IRRADIANCE_FITTED, fitted},
        {NOOK_PROBE_IRRADIANCE_INNER_PRODUCT, inner_product}};
    for (const auto& [form, answer] : forms)
      NOOK_OK_OR_FAIL(nook_sg_irradiance(lobes.data(), count, form, n, at(answer), 1));
    const std::vector<nook_lobe> gloss = gloss_of(probe, position);
    NOOK_OK_OR_FAIL(
        nook_sg_specular(gloss.data(), count, NOOK_PROBE_SPECULAR_ISOTROPIC, &round, at(isotropic), 1));
    NOOK_OK_OR_FAIL(
        nook_sg_specular(gloss.data(), count, NOOK_PROBE_SPECULAR_ANISOTROPIC, &surface, at(anisotropic), 1));
  }
  return rgb;
}

void compare(const std::vector<float>& found, const std::vector<float>& expected) {
  REQUIRE(found.size() == expected.size());
  const std::size_t row = expected.size() / answer_count;
  for (int answer = 0; answer < answer_count; ++answer) {
    float largest = 0, worst = 0;
    for (std::size_t i = answer * row; i < (answer + 1) * row; ++i) {
      largest = std::max(largest, std::abs(expected[i]));
      worst = std::max(worst, std::isfinite(found[i]) ? std::abs(found[i] - expected[i]) : INFINITY);
    }
    INFO("answer " << answer << " largest " << largest);
    // This is the bound that nook_gl.h promises: exponentials of a GPU have an error of a few units in
    // the last place, times exponents up to a hundred.
    CHECK(worst <= 1e-4f * largest);
  }
}

struct Fixture {
  explicit Fixture(platform::Context& context, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE)
      : gl(create_gl(host.handle, platform::Context::loader, &context, 0, mode)) {}
  explicit Fixture(Trace& trace) : gl(create_gl(host.handle, Trace::loader, &trace, 0)) {}
  GlProbe upload(const Probe& probe) {
    nook_gl_upload made = nullptr;
    NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl.get(), probe.get(), NOOK_GL_PROBE_LOBES, &made));
    return GlProbe(made);
  }
  CountedContext host;
  Gl gl;
};

}  // namespace

TEST_CASE("harmonics in shaders agree with the CPU") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const GlProbe probe = fixture.upload(make_probe(fixture.host.handle, {}));
  const GladGLContext& gl = context.gl();
  Numbers numbers(12);
  std::array<float, 27> harmonics{};
  for (float& c : harmonics) c = numbers.between(-1, 1);
  for (int c = 0; c < 3; ++c)
    harmonics[std::size_t(c)] = 6;  // so that irradiance is above 0, where shaders cut it off
  std::array<float, 15> zonal{};
  NOOK_OK_OR_FAIL(nook_sh_to_zh3(harmonics.data(), zonal.data()));
  constexpr int count = 64, rows = 4;
  std::vector<float> normals;
  for (int i = 0; i < count; ++i) {
    const Vec3 n = numbers.direction();
    normals.insert(normals.end(), {n.x, n.y, n.z});
  }
  const char* const text =
      "uniform vec3 normals[64]; uniform NookHarmonics light; uniform NookZonalHarmonics zonal; out vec4 "
      "answer;\n"
      "void main() {\n"
      "  vec3 n = normals[int(gl_FragCoord.x)], a;\n"
      "  switch (int(gl_FragCoord.y)) {\n"
      "    case 0: a = nook_sh_radiance(light, n); break;\n"
      "    case 1: a = nook_sh_irradiance(light, n); break;\n"
      "    case 2: a = nook_zh3_radiance(zonal, n); break;\n"
      "    default: a = nook_zh3_irradiance(zonal, n); break;\n"
      "  }\n"
      "  answer = vec4(a, 1.0);\n"
      "}\n";
  GLuint texture, framebuffer, array;
  gl.GenTextures(1, &texture);
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &array);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, count, rows, 0, GL_RGBA, GL_FLOAT, nullptr);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  gl.Viewport(0, 0, count, rows);
  const GLuint program = platform::link_program(gl, {glsl_header(gl), vertex_text},
                                                {glsl_header(gl), info_of(probe).glsl, text});
  gl.UseProgram(program);
  gl.Uniform3fv(gl.GetUniformLocation(program, "normals"), count, normals.data());
  gl.Uniform3fv(gl.GetUniformLocation(program, "light.coefficient"), 9, harmonics.data());
  gl.Uniform3fv(gl.GetUniformLocation(program, "zonal.coefficient"), 4, zonal.data());
  gl.Uniform3fv(gl.GetUniformLocation(program, "zonal.zonal"), 1, zonal.data() + 12);
  gl.BindVertexArray(array);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  const std::vector<float> found = read_texture(gl, texture, count, rows, 3);
  std::vector<float> expected(found.size());
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteProgram(program);
  gl.DeleteVertexArrays(1, &array);
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteTextures(1, &texture);

  const auto row = [&](int i) { return expected.data() + std::ptrdiff_t(3) * count * i; };
  NOOK_OK_OR_FAIL(nook_sh_radiance(harmonics.data(), 2, normals.data(), row(0), count));
  NOOK_OK_OR_FAIL(nook_sh_irradiance(harmonics.data(), 2, normals.data(), row(1), count));
  NOOK_OK_OR_FAIL(nook_sh_radiance(zonal.data(), NOOK_SH_ZH3, normals.data(), row(2), count));
  NOOK_OK_OR_FAIL(nook_sh_irradiance(zonal.data(), NOOK_SH_ZH3, normals.data(), row(3), count));
  // Sums of nine products of size 6 or less.
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 2e-5f);
}

TEST_CASE("probes in shaders agree with the CPU") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const std::vector<Query> queries = random_queries(64);
  for (const int ambient : {0, 1}) {
    ProbeRequest request;
    request.ambient = ambient;
    const Probe probe = make_probe(fixture.host.handle, request);
    const GlProbe uploaded = fixture.upload(probe);
    compare(ask(context.gl(), info_of(uploaded), queries), computed(probe.get(), queries));
  }
}

TEST_CASE("a grid is interpolated in shaders as on the CPU, inside and beyond its ends") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  for (const auto& counts : {std::array<std::uint32_t, 3>{3, 2, 4}, {1, 5, 1}, {2, 1, 2}}) {
    ProbeRequest request;
    std::ranges::copy(counts, request.counts);
    const Probe probe = make_probe(fixture.host.handle, request);
    const std::vector<Query> queries = random_queries(48);
    compare(ask(context.gl(), info_of(fixture.upload(probe)), queries), computed(probe.get(), queries));
  }
}

TEST_CASE("gloss in shaders reads its own amplitudes, which an update without them takes away") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const std::vector<Query> queries = random_queries(48);
  const Probe fitted = make_fitted_probe(fixture.host.handle);
  const GlProbe uploaded = fixture.upload(fitted);
  // The GLSL clamps irradiance and gloss at 0; under these lamps only radiance falls below.
  std::vector<float> expected = computed(fitted.get(), queries);
  for (std::size_t i = queries.size() * 3; i < expected.size(); ++i)
    expected[i] = std::max(expected[i], 0.0f);
  compare(ask(context.gl(), info_of(uploaded), queries), expected);
  const Probe other = make_probe(fixture.host.handle, {});
  NOOK_OK_OR_FAIL(nook_gl_update_probe(uploaded.get(), other.get()));
  compare(ask(context.gl(), info_of(uploaded), queries), computed(other.get(), queries));
}

TEST_CASE("an update shows the new probe under the old name") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  const Probe first = make_probe(fixture.host.handle, {}, 1);
  ProbeRequest larger;
  larger.counts[0] = 3;
  const Probe second = make_probe(fixture.host.handle, larger, 2);
  const GlProbe uploaded = fixture.upload(first);
  const GLuint name = info_of(uploaded).textures[0].texture;
  NOOK_OK_OR_FAIL(nook_gl_update_probe(uploaded.get(), second.get()));
  CHECK(info_of(uploaded).textures[0].texture == name);
  const std::vector<Query> queries = random_queries(16);
  compare(ask(context.gl(), info_of(uploaded), queries), computed(second.get(), queries));
}

TEST_CASE("uploading a probe keeps the promises on OpenGL state") {
  NOOK_NEED_CONTEXT(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    Fixture fixture(context, mode);
    const Probe probe = make_probe(fixture.host.handle, {});
    Poison poison(context, is_es(context.gl()) ? gl::probes | gl::texel_uploads : unsigned{gl::probes});
    const StateValues touched = poison.touched(), untouched = poison.untouched();
    const GlProbe uploaded = fixture.upload(probe);
    NOOK_OK_OR_FAIL(nook_gl_update_probe(uploaded.get(), probe.get()));
    INFO("mode " << mode);
    CHECK(poison.untouched() == untouched);
    if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
    if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
  }
}

TEST_CASE("what cannot be uploaded is refused and leaves nothing") {
  NOOK_NEED_CONTEXT(context);
  Fixture fixture(context);
  nook_gl_upload made = nullptr;
  ProbeRequest harmonics;
  harmonics.basis = NOOK_PROBE_BASIS_SH;
  const Probe bands = make_probe(fixture.host.handle, harmonics);
  CHECK(nook_gl_upload_probe(fixture.gl.get(), bands.get(), NOOK_GL_PROBE_LOBES, &made) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(nook_last_message()).find("NOOK_PROBE_BASIS_LOBES") != std::string::npos);
  CHECK(made == nullptr);
  CHECK(nook_gl_upload_probe(nullptr, bands.get(), NOOK_GL_PROBE_LOBES, &made) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_probe(fixture.gl.get(), nullptr, NOOK_GL_PROBE_LOBES, &made) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_probe(fixture.gl.get(), bands.get(), NOOK_GL_PROBE_LOBES, nullptr) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_gl_upload_describe(nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("a grid beyond the limits of the context is refused, and the old one stays") {
  NOOK_NEED_CONTEXT(context);
  // The minimum of every context: 65,536 texels, and on OpenGL ES 2048 x 2048.
  Trace trace(context);
  if (is_es(context.gl()))
    trace.limits[GL_MAX_TEXTURE_SIZE] = 2048;
  else
    trace.limits[GL_MAX_TEXTURE_BUFFER_SIZE] = 65536;
  Fixture fixture(trace);
  ProbeRequest large;
  large.counts[0] = large.counts[2] = is_es(context.gl()) ? 600 : 80;
  const Probe grid = make_probe(fixture.host.handle, large);
  const Probe small = make_probe(fixture.host.handle, {});
  const GlProbe uploaded = fixture.upload(small);
  CHECK(nook_gl_update_probe(uploaded.get(), grid.get()) == NOOK_ERROR_UNSUPPORTED);
  const std::vector<Query> queries = random_queries(8);
  compare(ask(context.gl(), info_of(uploaded), queries), computed(small.get(), queries));
}

TEST_CASE("a probe outlives its nook_gl, and a lost context needs no call") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  const Probe probe = make_probe(host.handle, {});
  nook_gl_upload uploaded = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl, probe.get(), NOOK_GL_PROBE_LOBES, &uploaded));
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(uploaded, &info));
  nook_gl_destroy(&gl);
  CHECK(context.gl().IsTexture(info.textures[0].texture));
  nook_gl_upload_destroy(&uploaded);
  CHECK(uploaded == nullptr);
  CHECK_FALSE(context.gl().IsTexture(info.textures[0].texture));
  nook_gl_upload_destroy(&uploaded);
  nook_gl_upload_destroy(nullptr);

  gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl, probe.get(), NOOK_GL_PROBE_LOBES, &uploaded));
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(uploaded, &info));
  NOOK_OK_OR_FAIL(nook_gl_context_lost(gl));
  CHECK(nook_gl_update_probe(uploaded, probe.get()) == NOOK_ERROR_GL);
  nook_gl_upload_destroy(&uploaded);
  nook_gl_destroy(&gl);
  // A lost context would have deleted the texture.
  context.gl().DeleteTextures(1, &info.textures[0].texture);
}
