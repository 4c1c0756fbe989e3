// Multisampled depth: the rules that choose a sample, their errors against the mean over the samples, bad
// input.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "sdk/src/gl/touched_state.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 96, height = 64;
constexpr nook_nnao_sample rules[] = {NOOK_NNAO_SAMPLE_MEDIAN, NOOK_NNAO_SAMPLE_FIRST,
                                      NOOK_NNAO_SAMPLE_NEAREST};

bool message_has(const char* part) {
  INFO(nook_last_message());
  return std::strstr(nook_last_message(), part) != nullptr;
}

// Four, or none where the context has no such depth textures.
int samples_of(const platform::Context& context) {
  if (context.is_es() && version_of(context) < 31) return 0;
  GLint most = 0;
  context.gl().GetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &most);
  return most >= 4 ? 4 : 0;
}

#define NOOK_NEED_SAMPLES(context)                                    \
  if (samples_of(context) == 0) {                                     \
    std::printf("no multisampled depth textures: not tested here\n"); \
    return;                                                           \
  }

// Balls, and a fence of thin ones, whose edges cover parts of pixels.
std::vector<Surface> fenced_still_life() {
  std::vector<Surface> scene = still_life();
  for (int i = 0; i < 12; ++i)
    scene.push_back(ball({-1.0f + 0.18f * float(i), -0.2f + 0.05f * float(i % 3), -2.8f}, 0.035f));
  return scene;
}

// Moves what a pixel shows by a share of a pixel.
Camera shifted(Camera camera, float x_px, float y_px) {
  const bool perspective = camera.projection[11] != 0;
  const float x = 2 * x_px / width, y = 2 * y_px / height;
  camera.projection[perspective ? 8 : 12] += perspective ? x : -x;
  camera.projection[perspective ? 9 : 13] += perspective ? y : -y;
  return camera;
}

struct Samples {
  std::vector<Camera> cameras;  // of each sample
  std::vector<Picture> pictures;
  std::vector<std::vector<float>> stored;
};

// The pictures at places in a pixel, from its centre: those of a rotated grid, as GPUs have it.
using Places = std::vector<std::pair<float, float>>;
const Places rotated_grid{{-0.125f, -0.375f}, {0.375f, -0.125f}, {-0.375f, 0.125f}, {0.125f, 0.375f}};

Samples look_at_samples(const Camera& camera, const std::vector<Surface>& scene,
                        const Places& places = rotated_grid) {
  Samples samples;
  for (const auto& [x, y] : places) {
    samples.cameras.push_back(shifted(camera, x, y));
    samples.pictures.push_back(look(samples.cameras.back(), scene, width, height));
    samples.stored.push_back(stored_depth(samples.cameras.back(), samples.pictures.back()));
  }
  return samples;
}

// The depth that the rule takes of the samples of a pixel, as stored.
float chosen(nook_nnao_sample rule, const Samples& samples, std::size_t pixel) {
  std::vector<std::pair<float, float>> depths;  // in view space, as stored
  for (std::size_t s = 0; s < samples.stored.size(); ++s)
    depths.push_back({samples.pictures[s].depth[pixel], samples.stored[s][pixel]});
  if (rule == NOOK_NNAO_SAMPLE_FIRST) return depths[0].second;
  std::ranges::sort(depths);
  return depths[rule == NOOK_NNAO_SAMPLE_NEAREST ? 0 : (depths.size() - 1) / 2].second;
}

nook_nnao make_pass(NnaoFixture& fixture, int samples, nook_nnao_sample rule, int half = 0, int taps = 9) {
  nook_nnao_desc desc = pass_desc(width, height);
  desc.depth_samples = samples;
  desc.depth_sample = rule;
  desc.half_resolution = half;
  desc.taps = taps;
  return create_pass(fixture.gl, desc);
}

// Sums of squared errors of each rule.
struct RuleErrors {
  double everywhere[std::size(rules)] = {}, edges[std::size(rules)] = {};
  double pixels = 0, edge_pixels = 0;
};

bool is_edge(const Samples& samples, std::size_t pixel) {
  float nearest = 1e30f, farthest = 0;
  for (const Picture& picture : samples.pictures) {
    nearest = std::min(nearest, picture.depth[pixel]);
    farthest = std::max(farthest, picture.depth[pixel]);
  }
  return farthest > 1.1f * nearest;
}

// The truth of a pixel is the mean AO of pictures with 64 taps at 16 places in it, which are none of the
// samples: no rule has its own noise in it.
std::vector<float> mean_over_pixels(NnaoFixture& fixture, const Samples& fine, bool given) {
  nook_nnao_desc desc = pass_desc(width, height);
  desc.taps = 64;
  nook_nnao pass = create_pass(fixture.gl, desc);
  std::vector<float> mean(std::size_t(width * height), 0.0f);
  for (std::size_t s = 0; s < fine.stored.size(); ++s) {
    const GLuint depth = fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, fine.stored[s]);
    const GLuint normals = given ? fixture.normals_of(fine.pictures[s]) : 0;
    const nook_nnao_frame_desc frame = frame_desc(fine.cameras[s], width, height, depth, normals, 0.5f);
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
    const std::vector<float> ao = own_ao(fixture.context.gl(), pass, width, height);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += ao[i] / float(fine.stored.size());
  }
  nook_nnao_destroy(&pass);
  return mean;
}

// given: normals of the pixels' centres; otherwise the pass reconstructs them.
void measure_rules(NnaoFixture& fixture, const Camera& camera, int taps, bool given, RuleErrors& errors) {
  Places places;
  for (int i = 0; i < 16; ++i)
    places.push_back({(float(i % 4) - 1.5f) / 4 + 0.02f, (float(i / 4) - 1.5f) / 4 - 0.03f});
  const Samples samples = look_at_samples(camera, fenced_still_life());
  const Samples fine = look_at_samples(camera, fenced_still_life(), places);
  const std::vector<float> mean = mean_over_pixels(fixture, fine, given);
  const GLuint depth = fixture.textures.depth_samples(width, height, samples.stored);
  const GLuint normals = given ? fixture.normals_of(look(camera, fenced_still_life(), width, height)) : 0;
  for (std::size_t r = 0; r < std::size(rules); ++r) {
    nook_nnao pass = make_pass(fixture, 4, rules[r], 0, taps);
    const nook_nnao_frame_desc frame = frame_desc(camera, width, height, depth, normals, 0.5f);
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
    const std::vector<float> ao = own_ao(fixture.context.gl(), pass, width, height);
    nook_nnao_destroy(&pass);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const double squared = (ao[i] - mean[i]) * (ao[i] - mean[i]);
      errors.everywhere[r] += squared;
      errors.pixels += r == 0;
      if (!is_edge(fine, i)) continue;
      errors.edges[r] += squared;
      errors.edge_pixels += r == 0;
    }
  }
}

}  // namespace

TEST_CASE("nnao: each rule of multisampled depth gives the AO of the depth that it takes") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  NnaoFixture fixture(context);
  const std::vector<Camera> all = cameras(float(width) / height);
  for (const std::size_t index : {0u, 2u, 7u}) {
    const Camera& camera = all[index];
    const Samples samples = look_at_samples(camera, fenced_still_life());
    const GLuint depth = fixture.textures.depth_samples(width, height, samples.stored);
    const GLuint normals = fixture.normals_of(look(camera, fenced_still_life(), width, height));
    for (const nook_nnao_sample rule : rules)
      for (const int half : {0, 1}) {
        std::vector<float> single;
        for (std::size_t i = 0; i < std::size_t(width * height); ++i)
          single.push_back(chosen(rule, samples, i));
        const GLuint resolved = fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, single);
        nook_nnao pass = make_pass(fixture, 4, rule, half), plain = make_pass(fixture, 0, rule, half);
        for (const GLuint normal : {0u, normals}) {
          nook_nnao_frame_desc frame = frame_desc(camera, width, height, depth, normal, 0.5f);
          NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
          frame.depth_texture = resolved;
          NOOK_OK_OR_FAIL(nook_nnao_render(plain, &frame));
          INFO(camera.name << ", rule " << rule << ", half " << half);
          // Samples of one depth in view space may be stored apart by a rounding, which is another tap for a
          // pixel in a thousand; elsewhere both are the same bits.
          CHECK(difference(own_ao(context.gl(), pass, width, height),
                           own_ao(context.gl(), plain, width, height), 1.5f / 255)
                    .beyond <= 0.001f);
        }
        nook_nnao_destroy(&pass);
        nook_nnao_destroy(&plain);
      }
  }
}

TEST_CASE(
    "nnao: the default rule of multisampled depth has the smallest error against the mean over a pixel") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  NnaoFixture fixture(context);
  const std::vector<Camera> all = cameras(float(width) / height);
  for (const bool given : {false, true})
    for (const int taps : {9, 64}) {
      RuleErrors errors;
      for (const std::size_t index : {0u, 6u, 9u}) measure_rules(fixture, all[index], taps, given, errors);
      const char* const names[] = {"median", "first", "nearest"};
      for (std::size_t r = 0; r < std::size(rules); ++r)
        std::printf("multisampled depth, %d taps, normals %s, %s: mse %.2e, on edges %.2e\n", taps,
                    given ? "given" : "rebuilt", names[r], errors.everywhere[r] / errors.pixels,
                    errors.edges[r] / errors.edge_pixels);
      REQUIRE(errors.edge_pixels > 500);
      nook_nnao_desc desc;
      NOOK_OK_OR_FAIL(nook_nnao_desc_init(&desc, sizeof desc, NOOK_VERSION));
      for (std::size_t r = 0; r < std::size(rules); ++r)
        if (rules[r] != desc.depth_sample)
          CHECK(errors.everywhere[std::size_t(desc.depth_sample)] < errors.everywhere[r]);
    }
}

TEST_CASE("nnao: multisampled depth is refused where it does not fit, and by its name") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  if (context.is_es() && version_of(context) < 31) {
    nook_nnao_desc desc = pass_desc(width, height);
    desc.depth_samples = 4;
    nook_nnao pass = nullptr;
    CHECK(nook_nnao_create(fixture.gl, &desc, &pass) == NOOK_ERROR_UNSUPPORTED);
    CHECK(pass == nullptr);
    CHECK(
        message_has("desc.depth_samples needs multisample textures (got OpenGL ES 3.0, need 3.1 or newer)"));
    return;
  }
  NOOK_NEED_SAMPLES(context);
  const std::vector<std::vector<float>> half(4, std::vector<float>(std::size_t(width * height), 0.9f));
  const GLuint samples = fixture.textures.depth_samples(width, height, half);
  const GLuint flat = fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, half[0]);
  nook_nnao pass = make_pass(fixture, 4, NOOK_NNAO_SAMPLE_MEDIAN),
            plain = make_pass(fixture, 0, NOOK_NNAO_SAMPLE_MEDIAN),
            eight = make_pass(fixture, 8, NOOK_NNAO_SAMPLE_MEDIAN);
  const auto refused = [&](nook_nnao by, GLuint depth, GLuint normal, const char* message) {
    nook_nnao_frame_desc frame = frame_desc(camera, width, height, depth, normal, 0.5f);
    CHECK(nook_nnao_render(by, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has(message));
    CHECK(context.gl().GetError() == GL_NO_ERROR);
    take_debug_messages();
  };
  refused(pass, flat, 0, "frame.depth_texture is a texture of another kind");
  refused(pass, flat, 0, "need a multisample texture");
  refused(plain, samples, 0, "need a 2D texture without layers or samples");
  refused(pass, samples, samples, "frame.normal_texture is a texture of another kind");
  refused(eight, samples, 0,
          "frame.depth_texture has another size (got 4 samples, need desc.depth_samples, 8)");
  nook_nnao_frame_desc frame = frame_desc(camera, width, height, samples, 0, 0.5f);
  nook_nnao_recording recording = nullptr;
  CHECK(nook_nnao_record(pass, &frame, nullptr, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("the pass reads texture arrays or samples"));
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
  for (nook_nnao* made : {&pass, &plain, &eight}) nook_nnao_destroy(made);
}

TEST_CASE("nnao: a pass of multisampled depth keeps the state contract") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS}) {
    NnaoFixture fixture(context, mode);
    const Camera camera = plain_camera(float(width) / height);
    const std::vector<std::vector<float>> half(4, std::vector<float>(std::size_t(width * height), 0.9f));
    const nook_nnao_frame_desc frame =
        frame_desc(camera, width, height, fixture.textures.depth_samples(width, height, half), 0, 0.5f);
    nook_nnao pass = make_pass(fixture, 4, NOOK_NNAO_SAMPLE_MEDIAN, 1);
    const unsigned compute = info_of(pass).path == NOOK_NNAO_PATH_COMPUTE ? unsigned{gl::screen_compute} : 0u;
    Poison poison(context, gl::screen | gl::screen_samples | compute);
    if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
    StateValues before = poison.touched();
    const StateValues untouched = poison.untouched();
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
    StateValues after = poison.touched();
    if (mode == NOOK_GL_STATE_DEFAULTS) before = poison.defaults(), after.erase("viewport");
    CHECK(after == before);
    CHECK(poison.untouched() == untouched);
    nook_nnao_destroy(&pass);
  }
}
