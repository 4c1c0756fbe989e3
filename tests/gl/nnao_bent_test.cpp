// Bent normals: the reference, closed forms, targets, half resolution, and the functions of a host's shader.
#include <nook/experimental/nook_stages.h>
#include <algorithm>

#include "platform/program.h"
#include "sdk/src/nnao/lighting.h"
#include "sdk/src/nnao/network_file.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr float step = 1.0f / 255;  // of the 8 bits that each channel is kept in

struct Bent : NnaoFixture {
  using NnaoFixture::NnaoFixture;
  ~Bent() {
    for (nook_nnao& pass : made) nook_nnao_destroy(&pass);
  }

  nook_nnao bent_pass(int width, int height, int taps, int half, nook_nnao_path path,
                      const nnao::Network* network) {
    PassDesc desc = pass_desc(width, height);
    desc.taps = taps;
    desc.half_resolution = half;
    desc.debug.path = path;
    desc.bent_normals = 1;
    made.push_back(network ? create_pass(gl, desc, *network) : create_pass(gl, desc));
    return made.back();
  }

  std::vector<nook_nnao> made;
};

struct Texel {
  Vec3 bent_normal;
  float ao = 0;
};

std::vector<Texel> texels(const std::vector<float>& rgba) {
  std::vector<Texel> found;
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    found.push_back({normalised({2 * rgba[i] - 1, 2 * rgba[i + 1] - 1, 2 * rgba[i + 2] - 1}), rgba[i + 3]});
  return found;
}

std::vector<Texel> draw(Bent& fixture, nook_nnao pass, const Camera& camera, const Picture& picture,
                        float radius, nook_nnao_view view = NOOK_NNAO_VIEW_AO) {
  const int w = int(picture.width), h = int(picture.height);
  ScreenFrame frame =
      frame_desc(camera, w, h, fixture.depth_of(camera, picture), fixture.normals_of(picture), radius);
  frame.debug.show = view;
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  return texels(read_texture(fixture.context.gl(), info_of(pass).texture, w, h, 4));
}

float degrees_between(Vec3 a, Vec3 b) {
  return std::acos(std::clamp(dot(a, b), -1.0f, 1.0f)) * 57.29578f;
}

}  // namespace

TEST_CASE("nnao: bent normals are the reference's, and AO is the same as without them") {
  NOOK_NEED_CONTEXT(context);
  Bent fixture(context);
  const nnao::Network network = mild_network(nnao::NetworkForm::horizon);
  const std::vector<Camera> all = cameras(1.5f);
  for (const nook_nnao_path path : paths_of(context))
    for (const int taps : {9, 16, 64})
      for (const std::size_t c : {0u, 1u, 2u}) {
        const Picture picture = look(all[c], still_life(), 60, 40);
        nook_nnao pass = fixture.bent_pass(60, 40, taps, 0, path, &network);
        const std::vector<Texel> found = draw(fixture, pass, all[c], picture, 0.8f, NOOK_NNAO_VIEW_RAW);
        const nnao::Sampling sampling{0.8f, 10, std::uint32_t(taps)};
        float mean = 0, surfaces = 0;
        int far_off = 0, other_ao = 0;
        for (std::uint32_t y = 0; y < picture.height; ++y)
          for (std::uint32_t x = 0; x < picture.width; ++x) {
            const std::size_t i = picture.view().at(x, y);
            if (!picture.view().has_surface(x, y)) continue;
            const nnao::Openness wanted = nnao::evaluate_openness(network, picture.view(), picture.normal[i],
                                                                  sampling, x, y, nnao::tap_noise(x, y));
            other_ao += std::abs(found[i].ao - std::clamp(wanted.ao, 0.0f, 1.0f)) > step;
            // A direction away from the viewer is turned towards the rim, which the reference does not do.
            const Vec3 viewer = nnao::to_viewer(
                picture.rays,
                nnao::view_position(picture.rays, float(x) + 0.5f, float(y) + 0.5f, picture.depth[i]));
            if (dot(wanted.bent_normal, viewer) < 0.25f) continue;
            const float off = degrees_between(found[i].bent_normal, wanted.bent_normal);
            mean += off;
            far_off += off > 4;
            ++surfaces;
          }
        INFO(all[c].name << ", " << taps << " taps, path " << path);
        // Two coordinates and three in 8 bits: half a step of each is 0.3 degrees in the middle and 1 where
        // the bent normal is 75 degrees from the viewer, and flipped taps (see nnao_agreement_test.cpp) add a
        // few.
        CHECK(surfaces > 1000);
        CHECK(mean / surfaces < 0.6f);
        CHECK(float(far_off) < 0.003f * surfaces);
        CHECK(float(other_ao) < 0.002f * surfaces);
      }
}

TEST_CASE("nnao: the bent normal of a plane is its normal, and the sky's points to the viewer") {
  NOOK_NEED_CONTEXT(context);
  Bent fixture(context);
  const Camera camera = plain_camera(1.5f);
  for (const Vec3 normal :
       {Vec3{0, 0, 1}, normalised(Vec3{0.57f, 0, 0.82f}), normalised(Vec3{0, 0.87f, 0.5f})})
    for (const int half : {0, 1}) {
      const Picture picture = look(camera, {plane_through({0, 0, -3}, normal)}, 60, 40);
      nook_nnao pass = fixture.bent_pass(60, 40, 9, half, NOOK_NNAO_PATH_AUTOMATIC, nullptr);
      float largest = 0;
      for (std::size_t i = 0; const Texel& texel : draw(fixture, pass, camera, picture, 0.5f)) {
        if (std::isfinite(picture.depth[i]))
          largest = std::max(largest, degrees_between(texel.bent_normal, picture.normal[i]));
        else
          CHECK(texel.ao == 1);
        ++i;
      }
      INFO("half " << half << ", normal " << normal.x << " " << normal.y << " " << normal.z);
      // The 8 bits: see above. Half the texels are decoded for a viewer a pixel aside, which is 1.5 degrees
      // here. At the border the filter has texels on one side alone, which adds a degree at half resolution.
      CHECK(largest < (half ? 4.5f : 2.0f));
    }
}

TEST_CASE("nnao: in the corner of a floor and a wall it leans by atan(2 / pi), as the integral says") {
  NOOK_NEED_CONTEXT(context);
  Bent fixture(context);
  // Under a wall a floor sees a quarter of the sphere: the cosine-weighted mean of its directions is pi / 3
  // along the normal and 2 / 3 away from the wall.
  const Camera camera = plain_camera(1.5f);
  const Vec3 floor = normalised({0, 0.8f, 0.6f}), wall = normalised({0, -0.6f, 0.8f});
  const Picture picture =
      look(camera, {plane_through({0, -0.5f, -3}, floor), plane_through({0, -0.5f, -3}, wall)}, 96, 64);
  const Vec3 wanted = normalised(floor * (1.0471976f) + wall * (2.0f / 3));
  for (const int taps : {9, 32}) {
    nook_nnao pass = fixture.bent_pass(96, 64, taps, 0, NOOK_NNAO_PATH_AUTOMATIC, nullptr);
    const std::vector<Texel> found = draw(fixture, pass, camera, picture, 1.5f);
    float leaning = 0, aside = 0, count = 0;
    for (std::uint32_t x = 24; x < 72; ++x)
      for (std::uint32_t y = 1; y < 63; ++y) {
        // The first floor pixel before the wall.
        const std::size_t i = picture.view().at(x, y), next = picture.view().at(x, y + 1);
        if (dot(picture.normal[i], floor) < 0.99f || dot(picture.normal[next], wall) < 0.99f) continue;
        leaning += degrees_between(found[i].bent_normal, floor);
        aside += degrees_between(found[i].bent_normal, wanted);
        ++count;
      }
    INFO(taps << " taps: leans by " << leaning / count << " degrees, " << aside / count
              << " from the integral");
    REQUIRE(count > 40);
    // 32.5 degrees. The pixel beside a crease also looks like the deeper corners of the training, which lean
    // more; the median error of the network is 9 degrees.
    CHECK(aside / count < 15);
    CHECK((leaning / count > 20 && leaning / count < 50));
  }
}

TEST_CASE("nnao: a host's target gets bent normals when it is written, and AO when it is multiplied") {
  NOOK_NEED_CONTEXT(context);
  Bent fixture(context);
  const Camera camera = plain_camera(1.5f);
  const Picture picture = look(camera, still_life(), 60, 40);
  nook_nnao pass = fixture.bent_pass(60, 40, 9, 0, NOOK_NNAO_PATH_AUTOMATIC, nullptr);
  const std::vector<Texel> own = draw(fixture, pass, camera, picture, 0.8f);
  ScreenFrame frame =
      frame_desc(camera, 60, 40, fixture.depth_of(camera, picture), fixture.normals_of(picture), 0.8f);
  frame.target = NOOK_TARGET_TEXTURE;
  frame.target_name = fixture.textures.floats(GL_RGBA32F, 4, 60, 40, std::vector<float>(60 * 40 * 4, 0.5f));
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  const std::vector<Texel> written = texels(read_texture(context.gl(), frame.target_name, 60, 40, 4));
  for (std::size_t i = 0; i < own.size(); ++i) {
    CHECK(std::abs(written[i].ao - own[i].ao) < step);
    // The own texture rounds three coordinates to 8 bits.
    CHECK(degrees_between(written[i].bent_normal, own[i].bent_normal) < 0.6f);
  }
  frame.blend = NOOK_BLEND_MULTIPLY;
  frame.target_name = fixture.textures.floats(GL_RGBA32F, 4, 60, 40, std::vector<float>(60 * 40 * 4, 0.5f));
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  const std::vector<float> multiplied = read_texture(context.gl(), frame.target_name, 60, 40, 4);
  for (std::size_t i = 0; i < own.size(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel)
      CHECK(std::abs(multiplied[4 * i + channel] - 0.5f * own[i].ao) < step);
    CHECK(multiplied[4 * i + 3] == 0.5f);
  }
}

TEST_CASE("nnao: bent normals at half resolution are near those at full resolution") {
  NOOK_NEED_CONTEXT(context);
  Bent fixture(context);
  const Camera camera = plain_camera(1.5f);
  const Picture picture = look(camera, still_life(), 96, 64);
  const std::vector<Texel> full = draw(
      fixture, fixture.bent_pass(96, 64, 16, 0, NOOK_NNAO_PATH_AUTOMATIC, nullptr), camera, picture, 0.8f);
  const std::vector<Texel> half = draw(
      fixture, fixture.bent_pass(96, 64, 16, 1, NOOK_NNAO_PATH_AUTOMATIC, nullptr), camera, picture, 0.8f);
  float mean = 0;
  for (std::size_t i = 0; i < full.size(); ++i)
    mean += degrees_between(full[i].bent_normal, half[i].bent_normal) / float(full.size());
  // Balls of 20 pixels turn by 6 degrees within a pixel of half resolution.
  CHECK(mean < 4);
}

TEST_CASE("nnao: bent normals need a network of the horizon form, and their memory is known before") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  PassDesc desc = pass_desc(3840, 2160);
  desc.bent_normals = 1;
  std::uint64_t bytes = 0;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * 16);
  CHECK(bytes <= 140'000'000);
  desc.half_resolution = 1;
  NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &bytes));
  CHECK(bytes == std::uint64_t{3840} * 2160 * 7);
  const std::vector<std::byte> paper = nnao::write_network(mild_network(nnao::NetworkForm::paper));
  desc.network = paper.data();
  desc.network_size = paper.size();
  CHECK(nook_nnao_memory(&desc, &bytes) == NOOK_ERROR_INVALID_ARGUMENT);
  desc.max_width = desc.max_height = 16;
  nook_nnao pass = nullptr;
  CHECK(nook_nnao_create(fixture.gl, &desc, &pass) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(pass == nullptr);
  CHECK(std::string(nook_last_message()).find("bent_normals") != std::string::npos);
  desc.network = nullptr;
  desc.network_size = 0;
  desc.bent_normals = 2;
  CHECK(nook_nnao_create(fixture.gl, &desc, &pass) == NOOK_ERROR_INVALID_ARGUMENT);
}

namespace {

const char* const vertex_text =
    "void main() { gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0); }\n";
// Three texels hold a question: bent normal and AO, normal and roughness, direction to the viewer and albedo.
const char* const fragment_text =
    "uniform highp sampler2D questions; out vec4 answer;\n"
    "vec4 question(int i) { return texelFetch(questions, ivec2(3 * int(gl_FragCoord.x) + i, 0), 0); }\n"
    "void main() {\n"
    "  vec4 a = question(0), b = question(1), c = question(2);\n"
    "  answer = vec4(nook_nnao_specular_occlusion(a.xyz, a.w, b.xyz, c.xyz, b.w),\n"
    "                nook_nnao_multi_bounce(a.w, vec3(c.w)).x, nook_nnao_cone_cosine(a.w),\n"
    "                nook_nnao_bent_normal(vec4(0.5 * a.xyz + 0.5, a.w)).x);\n"
    "}\n";

}  // namespace

TEST_CASE("nnao: the functions for a host's shader are those on the CPU") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const GladGLContext& gl = context.gl();
  constexpr int count = 200;
  std::vector<float> questions;
  std::vector<nnao::LitPixel> pixels;
  std::vector<float> roughness, albedo;
  for (int i = 0; i < count; ++i) {
    const float t = float(i);
    const Vec3 normal = normalised({std::sin(t), std::cos(1.3f * t), 1.2f});
    const Vec3 bent = normalised(normal + 0.7f * Vec3{std::cos(2.1f * t), std::sin(0.7f * t), 0.2f});
    const Vec3 viewer = normalised(normal + Vec3{std::sin(3.7f * t), std::sin(5.3f * t), std::cos(4.1f * t)});
    pixels.push_back({bent, normal, viewer, 0.5f + 0.5f * std::sin(0.37f * t)});
    roughness.push_back(0.5f + 0.5f * std::cos(1.9f * t));
    albedo.push_back(0.5f + 0.5f * std::cos(0.9f * t));
    questions.insert(questions.end(), {bent.x, bent.y, bent.z, pixels.back().ao, normal.x, normal.y, normal.z,
                                       roughness.back(), viewer.x, viewer.y, viewer.z, albedo.back()});
  }
  nook_nnao pass = fixture.pass_of(16, 0, 1, nullptr);
  const GLuint asked = fixture.textures.floats(GL_RGBA32F, 4, 3 * count, 1, questions);
  const GLuint answers = fixture.textures.floats(GL_RGBA32F, 4, count, 1, {});
  GLuint framebuffer = 0, array = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &array);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, asked);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, answers, 0);
  gl.Viewport(0, 0, count, 1);
  const GLuint program = platform::link_program(gl, {glsl_header(gl), vertex_text},
                                                {glsl_header(gl), info_of(pass).glsl, fragment_text});
  gl.UseProgram(program);
  gl.Uniform1i(gl.GetUniformLocation(program, "questions"), 0);
  gl.BindVertexArray(array);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  const std::vector<float> found = read_texture(gl, answers, count, 1, 4);
  gl.DeleteProgram(program);
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteVertexArrays(1, &array);
  const nnao::SpecularNumbers numbers = nnao::specular_numbers();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    INFO("question " << i);
    // Sums of some forty floats, and roots that a driver rounds in its own way.
    CHECK(std::abs(found[4 * i] - nnao::specular_occlusion(numbers, pixels[i], roughness[i])) < 1e-4f);
    CHECK(std::abs(found[4 * i + 1] - nnao::multi_bounce(pixels[i].ao, albedo[i])) < 1e-4f);
    CHECK(std::abs(found[4 * i + 2] - nnao::cone_cosine(pixels[i].ao)) < 1e-4f);
    CHECK(std::abs(found[4 * i + 3] - pixels[i].bent_normal.x) < 1e-4f);
  }
}
