// Directional occlusion on the GPU: every tier against the CPU, the GLSL for hosts against the CPU's
// irradiance, and lights that come and go.
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_sg.h>
#include <nook/nook_gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "platform/program.h"
#include "sdk/src/character/bent_normal.h"
#include "sdk/src/nnao/lighting.h"
#include "shaders/character/specular_numbers.h"
#include "tests/gl/crowd.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

// nook_gl.h promises it.
constexpr float promised_light_difference = 4e-3f;

// Uneven, coloured, one constant; sharper and softer than a probe's.
std::vector<nook_lobe> lobes_of(std::uint32_t seed, std::size_t count = 9) {
  Numbers numbers(seed);
  std::vector<nook_lobe> lobes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 axis = numbers.direction();
    const float sharpness[] = {6, 0, 2, 14, 40};
    lobes.push_back({{axis.x, axis.y, axis.z},
                     sharpness[i % 5],
                     {numbers.between(0, 2), numbers.between(0, 1), numbers.between(0, 3)},
                     0});
  }
  return lobes;
}

void light(const Crowd& crowd, std::size_t index, const std::vector<nook_lobe>& lobes) {
  NOOK_OK_OR_FAIL(
      nook_scene_set_light(crowd.scene, crowd.ids[index], lobes.data(), std::uint32_t(lobes.size())));
}

std::vector<float> cpu_colours(const Crowd& crowd, nook_model model, std::size_t index) {
  const std::uint32_t count = file_vertices(model);
  std::vector<float> rgb(3 * std::size_t(count));
  NOOK_OK_OR_FAIL(nook_scene_read(crowd.scene, crowd.ids[index], NOOK_CHANNEL_DIRECTIONAL_AO,
                                  NOOK_FORMAT_FLOAT, rgb.data(), count, 0));
  return rgb;
}

std::vector<float> gpu_colours(nook_gl gl, const Crowd& crowd, nook_model model, std::size_t index) {
  const std::uint32_t count = file_vertices(model);
  std::vector<float> rgb(3 * std::size_t(count), -1.0f);
  NOOK_OK_OR_FAIL(
      nook_gl_scene_read(gl, crowd.scene, crowd.ids[index], NOOK_CHANNEL_DIRECTIONAL_AO, rgb.data(), count));
  return rgb;
}

nook_gl_view view_of(nook_gl gl, const Crowd& crowd, std::size_t index) {
  nook_gl_view view{};
  view.struct_size = sizeof view;
  NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, crowd.scene, crowd.ids[index], NOOK_CHANNEL_DIRECTIONAL_AO, &view));
  return view;
}

nook_result ask_view(nook_gl gl, const Crowd& crowd, std::size_t index) {
  nook_gl_view view{};
  view.struct_size = sizeof view;
  return nook_gl_scene_view(gl, crowd.scene, crowd.ids[index], NOOK_CHANNEL_DIRECTIONAL_AO, &view);
}

// Two instances in three have a light, each its own; three frames.
void check_agreement(platform::Context& context, const Cast& cast, const CrowdOptions& options,
                     std::uint32_t terms = NOOK_TERM_ALL) {
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    Crowd on_cpu(cast.context.handle, cast.models, cast.bone_counts, options);
    Crowd on_gpu(cast.context.handle, cast.models, cast.bone_counts, options);
    for (const Crowd* crowd : {&on_cpu, &on_gpu}) {
      NOOK_OK_OR_FAIL(nook_scene_set_terms(crowd->scene, terms));
      for (std::size_t i = 0; i < crowd->ids.size(); ++i)
        if (i % 3) light(*crowd, i, lobes_of(std::uint32_t(i)));
    }
    nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
    float largest = 0, ao_largest = 0, colourful = 0;
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
      on_cpu.pose(frame);
      on_gpu.pose(frame);
      NOOK_OK_OR_FAIL(nook_scene_update(on_cpu.scene));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_gpu.scene));
      for (std::size_t i = 0; i < on_cpu.ids.size(); ++i) {
        const nook_model model = cast.model_of(i);
        const std::vector<float> ao = cpu_ao(on_cpu, model, i);
        ao_largest = std::max(ao_largest, largest_difference(gpu_ao(gl, on_gpu, model, i), ao));
        if (i % 3 == 0) {
          CHECK(ask_view(gl, on_gpu, i) == NOOK_ERROR_INVALID_HANDLE);
          continue;
        }
        const std::vector<float> want = cpu_colours(on_cpu, model, i);
        largest = std::max(largest, largest_difference(gpu_colours(gl, on_gpu, model, i), want));
        for (std::size_t v = 0; v < want.size(); ++v)
          colourful = std::max(colourful, std::abs(want[v] - ao[v / 3]));
      }
    }
    CHECK(largest < promised_light_difference);
    CHECK(ao_largest < promised_difference);
    // Were the light left out, the picture would be the AO's; the ground alone has the smallest change.
    CHECK(colourful > 0.03f);
    nook_gl_destroy(&gl);
    CHECK(take_debug_messages().empty());
    CHECK(context.gl().GetError() == GL_NO_ERROR);
  }
}

const char* const vertex_text =
    "void main() { gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0); }\n";
const char* const fragment_text =
    "uniform highp sampler2D normals; uniform int light; out vec4 answer;\n"
    "void main() {\n"
    "  vec3 n = texelFetch(normals, ivec2(gl_FragCoord.x, 0), 0).xyz;\n"
    "  answer = vec4(nook_scene_irradiance(light, n, vec3(1.0, 0.5, 0.25)), 1.0);\n"
    "}\n";

// Occluded irradiance of each normal in a host's shader, made of `texts`, four floats each.
std::vector<float> ask(const GladGLContext& gl, const nook_gl_view& view, const std::vector<float>& texels,
                       std::initializer_list<const char*> texts) {
  const int width = int(texels.size() / 4);
  Textures textures(gl);
  const GLuint normals = textures.floats(GL_RGBA32F, 4, width, 1, texels),
               answer = textures.floats(GL_RGBA32F, 4, width, 1, {});
  GLuint framebuffer, array;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &array);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, normals);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, answer, 0);
  gl.Viewport(0, 0, width, 1);
  const GLuint program = platform::link_program(gl, {glsl_header(gl), vertex_text}, texts);
  gl.UseProgram(program);
  gl.BindTexture(table_target(gl), view.texture);
  gl.Uniform1i(gl.GetUniformLocation(program, "nook_scene_lights"), 0);
  gl.Uniform1i(gl.GetUniformLocation(program, "normals"), 1);
  gl.Uniform1i(gl.GetUniformLocation(program, "light"), view.light);
  gl.BindVertexArray(array);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> answers = read_texture(gl, answer, width, 1, 4);
  gl.BindTexture(table_target(gl), 0);
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.DeleteProgram(program);
  gl.DeleteVertexArrays(1, &array);
  gl.DeleteFramebuffers(1, &framebuffer);
  return answers;
}

// The source that hosts include for probes.
std::string probe_glsl(nook_context context, nook_gl gl) {
  nook_probe_fit_desc desc;
  NOOK_OK_OR_FAIL(nook_probe_fit_desc_init(&desc));
  nook_probe_fit fit = nullptr;
  NOOK_OK_OR_FAIL(nook_probe_fit_create(context, &desc, &fit));
  const float up[3] = {0, 1, 0}, white[3] = {1, 1, 1};
  NOOK_OK_OR_FAIL(nook_probe_fit_add_samples(fit, up, white, nullptr, 1));
  nook_probe probe = nullptr;
  NOOK_OK_OR_FAIL(nook_probe_fit_solve(fit, &probe));
  nook_gl_upload uploaded = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_upload_probe(gl, probe, NOOK_GL_PROBE_LOBES, &uploaded));
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(uploaded, &info));
  nook_gl_upload_destroy(&uploaded);
  nook_probe_destroy(&probe);
  nook_probe_fit_destroy(&fit);
  return info.glsl;
}

// The occluded directions and the AO of a point are functions of its normal, so that one texel holds its
// inputs.
const char* const bent_text =
    "uniform highp sampler2D normals; out vec4 answer;\n"
    "void main() {\n"
    "  vec3 n = texelFetch(normals, ivec2(gl_FragCoord.x, 0), 0).xyz;\n"
    "  float ao = 0.5 + 0.5 * n.x;\n"
    "  vec3 bent = nook_scene_bent_normal(n, 0.6 * n.yzx, 0.2 * n.zxy, ao);\n"
    "  float roughness = 0.5 + 0.5 * n.y;\n"
    "  vec3 viewer = normalize(n + 0.5 * n.yzx);\n"
    "  answer = vec4(bent, nook_scene_specular_occlusion(bent, ao, n, viewer, roughness));\n"
    "}\n";

nnao::SpecularNumbers specular_numbers_of_characters() {
  constexpr float rows[7][8] = {
      {NOOK_SCENE_SPECULAR_0, NOOK_SCENE_SPECULAR_1},   {NOOK_SCENE_SPECULAR_2, NOOK_SCENE_SPECULAR_3},
      {NOOK_SCENE_SPECULAR_4, NOOK_SCENE_SPECULAR_5},   {NOOK_SCENE_SPECULAR_6, NOOK_SCENE_SPECULAR_7},
      {NOOK_SCENE_SPECULAR_8, NOOK_SCENE_SPECULAR_9},   {NOOK_SCENE_SPECULAR_10, NOOK_SCENE_SPECULAR_11},
      {NOOK_SCENE_SPECULAR_12, NOOK_SCENE_SPECULAR_13},
  };
  nnao::SpecularNumbers numbers;
  for (std::size_t u = 0; u < 8; ++u) {
    for (std::size_t i = 0; i < 5; ++i) numbers.weights[i][u] = rows[i][u];
    numbers.bias[u] = rows[5][u];
    numbers.out[u] = rows[6][u];
  }
  numbers.out_bias = NOOK_SCENE_SPECULAR_BIAS;
  return numbers;
}

}  // namespace

TEST_CASE("GPU and CPU agree on directional occlusion for every kernel and way to combine") {
  NOOK_NEED_CONTEXT(context);
  for (const KernelForm form : {KernelForm::paper, KernelForm::nook, KernelForm::rational})
    for (const float gamma : {1.0f, 1.7f}) {
      const Cast cast(form, gamma);
      for (const nook_form combine : {NOOK_FORM_DEFAULT, NOOK_FORM_PAPER}) {
        INFO("form " << static_cast<int>(form) << ", gamma " << gamma << ", combine " << combine);
        CrowdOptions options;
        options.form = combine;
        check_agreement(context, cast, options);
      }
    }
}

TEST_CASE("GPU and CPU agree on directional occlusion for each kind of caster and at every level of detail") {
  NOOK_NEED_CONTEXT(context);
  const Cast plain(KernelForm::nook, 1);
  for (const std::uint32_t term : {NOOK_TERM_SELF, NOOK_TERM_LINKS, NOOK_TERM_GROUND, NOOK_TERM_OCCLUDERS}) {
    INFO("term " << term);
    check_agreement(context, plain, {}, term);
  }
  const Cast cast(KernelForm::nook, 1.5f, true);
  CrowdOptions options;
  options.camera = true;
  options.lod_error = cast.coarsest_error / 2.5f;
  check_agreement(context, cast, options);
}

TEST_CASE("the GLSL for hosts gives the irradiance of an instance's lobes") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast(KernelForm::nook, 1);
  Crowd crowd(cast.context.handle, cast.models, cast.bone_counts, {});
  Numbers numbers(5);
  std::vector<float> normals, texels;
  for (int i = 0; i < 64; ++i) {
    const Vec3 n = numbers.direction();
    normals.insert(normals.end(), {n.x, n.y, n.z});
    texels.insert(texels.end(), {n.x, n.y, n.z, 0});
  }
  for (const int tier : tiers_of(context)) {
    nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
    const std::string probes = probe_glsl(cast.context.handle, gl);
    for (const std::size_t i : {1, 4}) light(crowd, i, lobes_of(std::uint32_t(20 + i)));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    for (const std::size_t i : {1, 4}) {
      const std::vector<nook_lobe> lobes = lobes_of(std::uint32_t(20 + i));
      std::vector<float> want(normals.size());
      NOOK_OK_OR_FAIL(nook_sg_irradiance(lobes.data(), std::uint32_t(lobes.size()),
                                         NOOK_PROBE_IRRADIANCE_BANDS, normals.data(), want.data(), 64));
      const float largest = *std::ranges::max_element(want);
      const nook_gl_view view = view_of(gl, crowd, i);
      const char* const version = glsl_header(context.gl());
      // Beside the text for probes, in either order.
      for (const std::vector<float>& found :
           {ask(context.gl(), view, texels, {version, view.glsl, fragment_text}),
            ask(context.gl(), view, texels, {version, probes.c_str(), view.glsl, fragment_text}),
            ask(context.gl(), view, texels, {version, view.glsl, probes.c_str(), fragment_text})})
        for (std::size_t v = 0; v < 64; ++v)
          for (std::size_t c = 0; c < 3; ++c) {
            const float occlusion = 1 / float(1 << c);
            // nook_gl.h's promise for the same functions.
            CHECK(std::abs(found[4 * v + c] - occlusion * std::max(want[3 * v + c], 0.0f)) < 1e-4f * largest);
          }
    }
    nook_gl_destroy(&gl);
  }
}

TEST_CASE("the GLSL for hosts gives the bent normal of occluded directions and its specular occlusion") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast(KernelForm::nook, 1);
  Crowd crowd(cast.context.handle, cast.models, cast.bone_counts, {});
  Numbers numbers(7);
  std::vector<Vec3> normals;
  std::vector<float> texels;
  for (int i = 0; i < 64; ++i) {
    // The first is open, and its reflection loses nothing.
    const Vec3 n = i == 0 ? Vec3{1, 0, 0} : numbers.direction();
    normals.push_back(n);
    texels.insert(texels.end(), {n.x, n.y, n.z, 0});
  }
  nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tiers_of(context).front());
  light(crowd, 1, lobes_of(3));
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
  const nook_gl_view view = view_of(gl, crowd, 1);
  const std::vector<float> found =
      ask(context.gl(), view, texels, {glsl_header(context.gl()), view.glsl, bent_text});
  nook_gl_destroy(&gl);
  CHECK(found[3] == 1);
  const nnao::SpecularNumbers network = specular_numbers_of_characters();
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 n = normals[i], turned{n.y, n.z, n.x};
    const float ao = 0.5f + 0.5f * n.x;
    const Vec3 bent = bent_normal(n, OccludedEnds{0.6f * turned, 0.2f * Vec3{n.z, n.x, n.y}}.at(ao));
    const nnao::LitPixel pixel{bent, n, normalised(n + 0.5f * turned), ao};
    // Sums of eight products of numbers below 8, in float.
    CHECK(length(Vec3{found[4 * i], found[4 * i + 1], found[4 * i + 2]} - bent) < 1e-5f);
    CHECK(std::abs(found[4 * i + 3] - nnao::specular_occlusion(network, pixel, 0.5f + 0.5f * n.y)) < 1e-4f);
  }
}

TEST_CASE("lights come, move and go") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast(KernelForm::nook, 1);
  CrowdOptions options;
  // Distant instances take turns: a new light does not wait for its own.
  options.camera = true;
  options.lod_max_interval = 8;
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    Crowd crowd(cast.context.handle, cast.models, cast.bone_counts, options);
    nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    nook_gl_view before{}, after{};
    before.struct_size = after.struct_size = sizeof before;
    NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, crowd.scene, crowd.ids[8], NOOK_CHANNEL_AO, &before));
    CHECK(ask_view(gl, crowd, 8) == NOOK_ERROR_INVALID_HANDLE);
    light(crowd, 8, lobes_of(1));
    CHECK(ask_view(gl, crowd, 8) == NOOK_ERROR_INVALID_HANDLE);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    const nook_gl_view first = view_of(gl, crowd, 8);
    NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, crowd.scene, crowd.ids[8], NOOK_CHANNEL_AO, &after));
    CHECK(after.buffer == before.buffer);
    CHECK(after.offset == before.offset);
    const std::vector<float> lit = gpu_colours(gl, crowd, cast.model_of(8), 8);
    // Colours, and not the AO that stood there: the built-in light is brighter on one side.
    const std::vector<float> ao = gpu_ao(gl, crowd, cast.model_of(8), 8);
    float apart = 0;
    for (std::size_t v = 0; v < ao.size(); ++v)
      for (std::size_t c = 0; c < 3; ++c) apart = std::max(apart, std::abs(lit[3 * v + c] - ao[v]));
    CHECK(apart > 0.03f);
    // An instance before it: its light moves in the texture, its values stay.
    light(crowd, 2, lobes_of(2));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    const nook_gl_view second = view_of(gl, crowd, 8);
    CHECK(second.light > first.light);
    CHECK(second.buffer == first.buffer);
    CHECK(second.offset == first.offset);
    CHECK(second.texture == first.texture);
    light(crowd, 8, {});
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(ask_view(gl, crowd, 8) == NOOK_ERROR_INVALID_HANDLE);
    CHECK(ask_view(gl, crowd, 2) == NOOK_OK);
    NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd.scene, crowd.ids[2]));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(ask_view(gl, crowd, 2) == NOOK_ERROR_INVALID_HANDLE);
    nook_gl_destroy(&gl);
    CHECK(context.gl().GetError() == GL_NO_ERROR);
  }
}

TEST_CASE("lights beyond a texture buffer are refused, and fewer are fine again") {
  NOOK_NEED_CONTEXT(context);
  Trace trace(context);
  if (context.is_es()) {
    std::printf(
        "the smallest 2D textures hold 29,959 lights of 64 lobes, more than a test should make; "
        "probes go through the same check\n");
    return;
  }
  trace.limits[GL_MAX_TEXTURE_BUFFER_SIZE] = 65536;
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(9, {3, 4, 20, 30, 5, 2}));
  CrowdOptions options;
  options.instances = 480;  // 12 + 2 * 64 texels each
  options.links = options.nearest = false;
  for (const int tier : tiers_of(context)) {
    Crowd crowd(host.handle, {model}, {3}, options);
    for (std::size_t i = 0; i < crowd.ids.size(); ++i) light(crowd, i, lobes_of(1, 64));
    nook_gl gl = create_gl(host.handle, Trace::loader, &trace, tier);
    CHECK(nook_gl_scene_update(gl, crowd.scene) == NOOK_ERROR_UNSUPPORTED);
    CHECK(std::string(nook_last_message()).find("use fewer lobes") != std::string::npos);
    for (std::size_t i = 0; i < crowd.ids.size(); ++i) light(crowd, i, lobes_of(1, 12));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    const std::vector<float> on_gpu = gpu_colours(gl, crowd, model, 479);
    NOOK_OK_OR_FAIL(nook_scene_update(crowd.scene));
    CHECK(largest_difference(on_gpu, cpu_colours(crowd, model, 479)) < promised_light_difference);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
}
