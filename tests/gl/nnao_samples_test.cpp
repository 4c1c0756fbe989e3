// Multisampled depth and normals: the rules that choose a sample, their errors against the mean over the
// samples, two eyes in one call, bad input.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <span>

#include "sdk/src/gl/touched_state.h"
#include "sdk/src/nnao/host_depth.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 96, height = 64;
constexpr nook_nnao_sample rules[] = {NOOK_NNAO_SAMPLE_MEDIAN, NOOK_NNAO_SAMPLE_FIRST,
                                      NOOK_NNAO_SAMPLE_NEAREST};
constexpr std::size_t ways = std::size(rules);

bool message_has(const char* part) {
  INFO(nook_last_message());
  return std::strstr(nook_last_message(), part) != nullptr;
}

// Four, or none where the context has no such textures.
int samples_of(const platform::Context& context) {
  if (context.is_es() && version_of(context) < 31) return 0;
  GLint depths = 0, colours = 0;
  context.gl().GetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depths);
  context.gl().GetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &colours);
  return std::min(depths, colours) >= 4 ? 4 : 0;
}

bool has_sample_arrays(const platform::Context& context) {
  return samples_of(context) > 0 && (!context.is_es() || version_of(context) >= 32);
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
  std::vector<std::vector<float>> normals;  // as halved_range has them
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
    samples.normals.push_back(halved_range(flat(samples.pictures.back().normal)));
  }
  return samples;
}

// The sample of a pixel that the rule takes.
std::size_t chosen(nook_nnao_sample rule, const Samples& samples, std::size_t pixel) {
  std::vector<float> depths;
  for (const Picture& picture : samples.pictures) depths.push_back(picture.depth[pixel]);
  return nnao::chosen_sample(nnao::SampleRule(rule), depths);
}

// Depth and normals of the samples that the rule takes.
struct Resolved {
  std::vector<float> stored, normals;
};

Resolved resolved(nook_nnao_sample rule, const Samples& samples) {
  Resolved result;
  for (std::size_t pixel = 0; pixel < samples.stored[0].size(); ++pixel) {
    const std::size_t sample = chosen(rule, samples, pixel);
    result.stored.push_back(samples.stored[sample][pixel]);
    for (std::size_t c = 0; c < 3; ++c) result.normals.push_back(samples.normals[sample][3 * pixel + c]);
  }
  return result;
}

// The kinds of normals that a pass of multisampled depth reads.
enum class Normals { rebuilt, single, sampled };

struct PassSettings {
  int half = 0, temporal = 0, bent = 0, taps = 9;
  nook_nnao_path path = NOOK_NNAO_PATH_AUTOMATIC;
};

nook_nnao_desc sampled_desc(int samples, nook_nnao_sample rule, Normals normals,
                            const PassSettings& settings = {}) {
  nook_nnao_desc desc = pass_desc(width, height);
  desc.depth_samples = samples;
  desc.depth_sample = rule;
  desc.normal_samples = normals == Normals::sampled ? samples : 0;
  desc.half_resolution = settings.half;
  desc.temporal_frames = settings.temporal;
  desc.bent_normals = settings.bent;
  desc.taps = settings.taps;
  desc.path = settings.path;
  return desc;
}

nook_nnao make_pass(NnaoFixture& fixture, int samples, nook_nnao_sample rule,
                    Normals normals = Normals::rebuilt, const PassSettings& settings = {}) {
  return create_pass(fixture.gl, sampled_desc(samples, rule, normals, settings));
}

// A frame whose normals are as halved_range has them.
nook_nnao_frame_desc sampled_frame(const Camera& camera, GLuint depth, GLuint normals) {
  nook_nnao_frame_desc frame = frame_desc(camera, width, height, depth, normals, 0.5f);
  frame.normal_scale = 2;
  frame.normal_bias = -1;
  return frame;
}

GLuint single_normals(NnaoFixture& fixture, const std::vector<float>& normals) {
  return fixture.textures.floats(GL_RGB32F, 3, width, height, normals);
}

// Sums of squared errors of each rule.
struct RuleErrors {
  double everywhere[ways] = {}, edges[ways] = {};
  double pixels = 0, edge_pixels = 0;

  void print(const char* title, const std::array<const char*, ways>& names) const {
    for (std::size_t r = 0; r < ways; ++r)
      std::printf("%s, %s: mse %.2e, on edges %.2e\n", title, names[r], everywhere[r] / pixels,
                  edges[r] / edge_pixels);
  }
};

bool is_edge(const Samples& samples, std::size_t pixel) {
  float nearest = 1e30f, farthest = 0;
  for (const Picture& picture : samples.pictures) {
    nearest = std::min(nearest, picture.depth[pixel]);
    farthest = std::max(farthest, picture.depth[pixel]);
  }
  return farthest > 1.1f * nearest;
}

// Passes that are measured: one for each rule of depth.
struct RulePasses {
  RulePasses(NnaoFixture& fixture, int taps) {
    for (std::size_t r = 0; r < ways; ++r)
      of_rule[r] = make_pass(fixture, 4, rules[r], Normals::single, {.taps = taps});
  }
  ~RulePasses() {
    for (nook_nnao& pass : of_rule) nook_nnao_destroy(&pass);
  }
  RulePasses(const RulePasses&) = delete;
  RulePasses& operator=(const RulePasses&) = delete;

  nook_nnao of_rule[ways] = {};
};

std::vector<float> drawn(NnaoFixture& fixture, nook_nnao pass, const nook_nnao_frame_desc& frame) {
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
  return own_ao(fixture.context.gl(), pass, width, height);
}

// The truth of a pixel is the mean AO of pictures with 64 taps at 16 places in it, which are none of the
// samples: no rule has its own noise in it.
std::vector<float> mean_over_pixels(NnaoFixture& fixture, const Samples& fine, bool given) {
  nook_nnao pass = fixture.pass_of(64, 0, 1, nullptr);
  std::vector<float> mean(std::size_t(width * height), 0.0f);
  for (std::size_t s = 0; s < fine.stored.size(); ++s) {
    const GLuint depth = fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, fine.stored[s]);
    const GLuint normals = given ? fixture.normals_of(fine.pictures[s]) : 0;
    const std::vector<float> ao =
        drawn(fixture, pass, frame_desc(fine.cameras[s], width, height, depth, normals, 0.5f));
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += ao[i] / float(fine.stored.size());
  }
  return mean;
}

// Normals for a pixel by the ways to resolve those of its samples: that of the sample whose depth it has, the
// mean, that of sample 0.
std::vector<float> normals_by(std::size_t rule, const Samples& samples) {
  if (rule == 0) return resolved(NOOK_NNAO_SAMPLE_MEDIAN, samples).normals;
  if (rule == 2) return samples.normals[0];
  std::vector<float> mean(samples.normals[0].size(), 0.0f);
  for (const std::vector<float>& normals : samples.normals)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += normals[i] / float(samples.normals.size());
  return mean;
}

// A view with the truth of its pixels.
struct MeasuredView {
  Camera camera;
  Samples samples;
  std::vector<float> mean;
  std::vector<bool> edge;
};

MeasuredView measured_view(NnaoFixture& fixture, const Camera& camera, bool given) {
  Places places;
  for (int i = 0; i < 16; ++i)
    places.push_back({(float(i % 4) - 1.5f) / 4 + 0.02f, (float(i / 4) - 1.5f) / 4 - 0.03f});
  const Samples fine = look_at_samples(camera, fenced_still_life(), places);
  MeasuredView view{
      camera, look_at_samples(camera, fenced_still_life()), mean_over_pixels(fixture, fine, given), {}};
  for (std::size_t i = 0; i < view.mean.size(); ++i) view.edge.push_back(is_edge(fine, i));
  return view;
}

void add_errors(const std::vector<float>& ao, const MeasuredView& view, std::size_t way, RuleErrors& errors) {
  for (std::size_t i = 0; i < ao.size(); ++i) {
    const double squared = (ao[i] - view.mean[i]) * (ao[i] - view.mean[i]);
    errors.everywhere[way] += squared;
    errors.pixels += way == 0;
    if (!view.edge[i]) continue;
    errors.edges[way] += squared;
    errors.edge_pixels += way == 0;
  }
}

// normals 0: the pass reconstructs them.
void measure_depth_rules(NnaoFixture& fixture, const RulePasses& passes, const MeasuredView& view,
                         GLuint normals, RuleErrors& errors) {
  const GLuint depth = fixture.textures.samples(SampledImage::depth, width, height, view.samples.stored);
  for (std::size_t r = 0; r < ways; ++r)
    add_errors(drawn(fixture, passes.of_rule[r], sampled_frame(view.camera, depth, normals)), view, r,
               errors);
}

// Adds the errors of each way to resolve normals, with the depth of the median.
void measure_normal_rules(NnaoFixture& fixture, const RulePasses& passes, const MeasuredView& view,
                          RuleErrors& errors) {
  const GLuint depth = fixture.textures.samples(SampledImage::depth, width, height, view.samples.stored);
  for (std::size_t r = 0; r < ways; ++r) {
    const GLuint normals = single_normals(fixture, normals_by(r, view.samples));
    add_errors(drawn(fixture, passes.of_rule[0], sampled_frame(view.camera, depth, normals)), view, r,
               errors);
  }
}

}  // namespace

TEST_CASE("nnao: the number of the sample that a rule takes") {
  const std::vector<float> depths{3, 1, 2, 2, std::numeric_limits<float>::infinity()};
  CHECK(nnao::chosen_sample(nnao::SampleRule::first, depths) == 0);
  CHECK(nnao::chosen_sample(nnao::SampleRule::nearest, depths) == 1);
  CHECK(nnao::chosen_sample(nnao::SampleRule::median, depths) == 3);
  // Of an even number the nearer one in the middle; of equal depths in their order.
  CHECK(nnao::chosen_sample(nnao::SampleRule::median, std::span(depths).first(4)) == 2);
  CHECK(nnao::chosen_sample(nnao::SampleRule::median, std::vector<float>(4, 5.0f)) == 1);
  CHECK(nnao::chosen_sample(nnao::SampleRule::nearest, std::vector<float>(4, 5.0f)) == 0);
  CHECK(nnao::chosen_sample(nnao::SampleRule::median, std::span(depths).first(1)) == 0);
}

TEST_CASE("nnao: each rule gives the AO of the depth and the normal of the sample that it takes") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  NnaoFixture fixture(context);
  struct View {
    Camera camera;
    Samples samples;
    GLuint depth, normals, centre_normals;
  };
  std::vector<View> views;
  const std::vector<Camera> all = cameras(float(width) / height);
  for (const std::size_t index : {0u, 2u, 7u}) {
    const Samples samples = look_at_samples(all[index], fenced_still_life());
    const Picture centre = look(all[index], fenced_still_life(), width, height);
    views.push_back({all[index], samples,
                     fixture.textures.samples(SampledImage::depth, width, height, samples.stored),
                     fixture.textures.samples(SampledImage::colours, width, height, samples.normals),
                     single_normals(fixture, halved_range(flat(centre.normal)))});
  }
  for (const int half : {0, 1})
    for (const nook_nnao_path path : paths_of(context)) {
      const PassSettings settings{.half = half, .path = path};
      nook_nnao plain = make_pass(fixture, 0, NOOK_NNAO_SAMPLE_MEDIAN, Normals::single, settings);
      for (const nook_nnao_sample rule : rules)
        for (const Normals kind : {Normals::single, Normals::sampled}) {
          // A compute shader reads samples of normals alone.
          if (path == NOOK_NNAO_PATH_COMPUTE && kind != Normals::sampled) continue;
          nook_nnao pass = make_pass(fixture, 4, rule, kind, settings);
          for (const View& view : views)
            for (const bool given : {true, false}) {
              if (!given && kind == Normals::sampled) continue;
              const Resolved taken = resolved(rule, view.samples);
              const GLuint depth_taken =
                  fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, taken.stored);
              GLuint sampled = 0, single = 0;
              if (given) {
                sampled = kind == Normals::sampled ? view.normals : view.centre_normals;
                single =
                    kind == Normals::sampled ? single_normals(fixture, taken.normals) : view.centre_normals;
              }
              INFO(view.camera.name << ", rule " << rule << ", normals " << int(kind) << ", half " << half);
              // Samples of one depth in view space may be stored apart by a rounding, which is another tap
              // for a pixel in a thousand; elsewhere both are the same bits.
              CHECK(difference(drawn(fixture, pass, sampled_frame(view.camera, view.depth, sampled)),
                               drawn(fixture, plain, sampled_frame(view.camera, depth_taken, single)),
                               1.5f / 255)
                        .beyond <= 0.001f);
            }
          nook_nnao_destroy(&pass);
        }
      nook_nnao_destroy(&plain);
    }
}

TEST_CASE("nnao: of multisampled normals the one of the sample that the depth rule takes is shown") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  // Planted: the order of the depths differs from pixel to pixel, and each sample has a normal of its own.
  const float planted[4][3] = {{0, 0, 1}, {0.6f, 0, 0.8f}, {0, -0.6f, 0.8f}, {-0.8f, 0, 0.6f}};
  std::vector<std::vector<float>> depths(4), normals(4);
  for (std::size_t pixel = 0; pixel < std::size_t(width * height); ++pixel)
    for (std::size_t sample = 0; sample < 4; ++sample) {
      depths[sample].push_back(0.8f + 0.01f * float((pixel * 7 / 3 + sample * (1 + 2 * (pixel % 2))) % 4));
      normals[sample].insert(normals[sample].end(), planted[sample], planted[sample] + 3);
    }
  for (std::vector<float>& image : normals) image = halved_range(image);
  const GLuint depth = fixture.textures.samples(SampledImage::depth, width, height, depths),
               normal = fixture.textures.samples(SampledImage::colours, width, height, normals),
               target = fixture.textures.floats(GL_RGBA8, 4, width, height, {});
  for (const nook_nnao_sample rule : rules)
    for (const int half : {0, 1}) {
      nook_nnao pass = make_pass(fixture, 4, rule, Normals::sampled, {.half = half});
      nook_nnao_frame_desc frame = sampled_frame(camera, depth, normal);
      frame.view = NOOK_NNAO_VIEW_NORMALS;
      frame.target = NOOK_NNAO_TARGET_TEXTURE;
      frame.target_name = target;
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
      const std::vector<float> shown = read_texture(context.gl(), target, width, height, 3);
      std::vector<float> wanted;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const auto pixel = std::size_t(half ? y / 2 * 2 * width + x / 2 * 2 : y * width + x);
          const float of_samples[] = {depths[0][pixel], depths[1][pixel], depths[2][pixel], depths[3][pixel]};
          const std::size_t sample = nnao::chosen_sample(nnao::SampleRule(rule), of_samples);
          for (const float number : planted[sample]) wanted.push_back(0.5f * number + 0.5f);
        }
      INFO("rule " << rule << ", half " << half);
      // 8 bits of the stored normal, turned and of unit length, and of the target.
      CHECK(difference(shown, wanted, 2.0f / 255).beyond == 0);
      nook_nnao_destroy(&pass);
    }
}

TEST_CASE("nnao: two eyes of samples in one call have the AO of two calls") {
  NOOK_NEED_CONTEXT(context);
  if (!has_sample_arrays(context)) {
    std::printf("no arrays of multisample textures: not tested here\n");
    return;
  }
  NnaoFixture fixture(context);
  Textures& textures = fixture.textures;
  const std::vector<Camera> all = cameras(float(width) / height);
  const Camera eyes[] = {all[0], all[9]};
  std::vector<std::vector<std::vector<float>>> depths, normals;
  std::vector<std::vector<float>> centres;
  std::vector<float> projections;
  for (const Camera& eye : eyes) {
    const Samples samples = look_at_samples(eye, fenced_still_life());
    depths.push_back(samples.stored);
    normals.push_back(samples.normals);
    centres.push_back(halved_range(flat(look(eye, fenced_still_life(), width, height).normal)));
    projections.insert(projections.end(), eye.projection, eye.projection + 16);
  }
  const GLuint depth = textures.sample_array(SampledImage::depth, width, height, depths),
               sampled = textures.sample_array(SampledImage::colours, width, height, normals),
               single = textures.array(GL_RGB32F, 3, width, height, centres);
  const nook_nnao_path best = paths_of(context).back();
  const struct {
    PassSettings settings;
    Normals kind;
  } cases[] = {{{.path = NOOK_NNAO_PATH_FRAGMENT}, Normals::single},
               {{.path = NOOK_NNAO_PATH_FRAGMENT}, Normals::sampled},
               {{.half = 1, .temporal = 4, .path = best}, Normals::sampled},
               {{.bent = 1, .path = best}, Normals::rebuilt}};
  for (const auto& [settings, kind] : cases) {
    nook_nnao_desc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, kind, settings);
    nook_nnao alone[] = {create_pass(fixture.gl, desc), create_pass(fixture.gl, desc)};
    desc.layers = 2;
    nook_nnao both = create_pass(fixture.gl, desc);
    const int channels = settings.bent ? 4 : 1;
    for (int count = 0; count < (settings.temporal ? 2 : 1); ++count) {
      const GLuint of_both = kind == Normals::sampled ? sampled : kind == Normals::single ? single : 0;
      nook_nnao_frame_desc frame = sampled_frame(eyes[0], depth, of_both);
      frame.layer_projections = projections.data();
      NOOK_OK_OR_FAIL(nook_nnao_render(both, &frame));
      for (std::size_t eye = 0; eye < 2; ++eye) {
        GLuint normal = 0;
        if (kind == Normals::sampled)
          normal = textures.samples(SampledImage::colours, width, height, normals[eye]);
        if (kind == Normals::single) normal = single_normals(fixture, centres[eye]);
        const GLuint of_eye = textures.samples(SampledImage::depth, width, height, depths[eye]);
        frame = sampled_frame(eyes[eye], of_eye, normal);
        NOOK_OK_OR_FAIL(nook_nnao_render(alone[eye], &frame));
        INFO("eye " << eye << ", normals " << int(kind) << ", half " << settings.half);
        CHECK((read_texture(context.gl(), info_of(both).texture, width, height, channels, int(eye)) ==
               read_texture(context.gl(), info_of(alone[eye]).texture, width, height, channels)));
      }
    }
    for (nook_nnao* made : {&both, &alone[0], &alone[1]}) nook_nnao_destroy(made);
  }
}

TEST_CASE("nnao: the default rule has the smallest error against the mean over a pixel") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  NnaoFixture fixture(context);
  const std::vector<Camera> all = cameras(float(width) / height);
  nook_nnao_desc desc;
  NOOK_OK_OR_FAIL(nook_nnao_desc_init(&desc, sizeof desc, NOOK_VERSION));
  REQUIRE(desc.depth_sample == rules[0]);
  const auto first_is_least = [](const RuleErrors& errors) {
    for (std::size_t r = 1; r < ways; ++r) CHECK(errors.everywhere[0] < errors.everywhere[r]);
  };
  const RulePasses few(fixture, 9), many(fixture, 64);
  for (const bool given : {false, true}) {
    RuleErrors depth_errors[2], normal_errors[2];
    for (const std::size_t index : {0u, 6u, 9u}) {
      const MeasuredView view = measured_view(fixture, all[index], given);
      const Picture centre = look(all[index], fenced_still_life(), width, height);
      const GLuint normals = given ? single_normals(fixture, halved_range(flat(centre.normal))) : 0;
      for (const std::size_t i : {0u, 1u}) {
        const RulePasses& passes = i == 0 ? few : many;
        measure_depth_rules(fixture, passes, view, normals, depth_errors[i]);
        if (given) measure_normal_rules(fixture, passes, view, normal_errors[i]);
      }
    }
    for (const std::size_t i : {0u, 1u}) {
      char title[64];
      std::snprintf(title, sizeof title, "multisampled depth, %d taps, normals %s", i == 0 ? 9 : 64,
                    given ? "given" : "rebuilt");
      depth_errors[i].print(title, {"median", "first", "nearest"});
      REQUIRE(depth_errors[i].edge_pixels > 500);
      first_is_least(depth_errors[i]);
      if (!given) continue;
      std::snprintf(title, sizeof title, "multisampled depth and normals, %d taps", i == 0 ? 9 : 64);
      normal_errors[i].print(title, {"normal of the median's sample", "mean", "first"});
      first_is_least(normal_errors[i]);
    }
  }
}

TEST_CASE("nnao: multisampled images are refused where they do not fit, and by their name") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  Textures& textures = fixture.textures;
  const Camera camera = plain_camera(float(width) / height);
  nook_nnao pass = nullptr;
  const auto unsupported = [&](int layers, const char* message) {
    nook_nnao_desc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, Normals::sampled);
    desc.layers = layers;
    CHECK(nook_nnao_create(fixture.gl, &desc, &pass) == NOOK_ERROR_UNSUPPORTED);
    CHECK(pass == nullptr);
    CHECK(message_has(message));
  };
  if (context.is_es() && version_of(context) < 31) {
    unsupported(0, "desc.depth_samples needs multisample textures (got OpenGL ES 3.0, need 3.1 or newer)");
    unsupported(2, "desc.depth_samples needs multisample textures");
    return;
  }
  if (context.is_es() && version_of(context) < 32)
    unsupported(2,
                "desc.layers with desc.depth_samples needs multisample texture arrays (got OpenGL ES 3.1, "
                "need 3.2 or newer)");
  NOOK_NEED_SAMPLES(context);
  const std::vector<float> image(std::size_t(width * height), 0.9f), colours(3 * image.size(), 0.9f);
  const std::vector<std::vector<float>> four(4, image), four_colours(4, colours), two_colours(2, colours);
  const GLuint samples = textures.samples(SampledImage::depth, width, height, four),
               normals = textures.samples(SampledImage::colours, width, height, four_colours),
               two_normals = textures.samples(SampledImage::colours, width, height, two_colours),
               flat_normals = single_normals(fixture, colours),
               flat = textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, image);
  pass = make_pass(fixture, 4, NOOK_NNAO_SAMPLE_MEDIAN);
  nook_nnao plain = make_pass(fixture, 0, NOOK_NNAO_SAMPLE_MEDIAN),
            eight = make_pass(fixture, 8, NOOK_NNAO_SAMPLE_MEDIAN),
            both = make_pass(fixture, 4, NOOK_NNAO_SAMPLE_MEDIAN, Normals::sampled);
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
  refused(plain, flat, normals, "frame.normal_texture is a texture of another kind");
  refused(pass, samples, normals, "frame.normal_texture is a texture of another kind");
  refused(both, samples, flat_normals, "frame.normal_texture is a texture of another kind");
  refused(both, samples, flat_normals, "need a multisample texture");
  refused(eight, samples, 0,
          "frame.depth_texture has another size (got 4 samples, need desc.depth_samples, 8)");
  GLint least = 0;  // a driver may round the number up
  context.gl().BindTexture(GL_TEXTURE_2D_MULTISAMPLE, two_normals);
  context.gl().GetTexLevelParameteriv(GL_TEXTURE_2D_MULTISAMPLE, 0, GL_TEXTURE_SAMPLES, &least);
  context.gl().BindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
  if (least == 2)
    refused(both, samples, two_normals,
            "frame.normal_texture has another size (got 2 samples, need desc.depth_samples, 4)");
  nook_nnao_frame_desc frame = frame_desc(camera, width, height, samples, 0, 0.5f);
  nook_nnao_recording recording = nullptr;
  CHECK(nook_nnao_record(pass, &frame, nullptr, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("the pass reads texture arrays or samples"));
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
  // Normals are optional with samples as without.
  NOOK_OK_OR_FAIL(nook_nnao_render(both, &frame));
  for (nook_nnao* made : {&plain, &eight}) nook_nnao_destroy(made);
  if (has_sample_arrays(context)) {
    nook_nnao_desc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, Normals::sampled);
    desc.layers = 2;
    nook_nnao eyes = create_pass(fixture.gl, desc);
    const GLuint array = textures.sample_array(SampledImage::depth, width, height, {four, four}),
                 one = textures.sample_array(SampledImage::depth, width, height, {four});
    refused(eyes, samples, 0, "need a multisample texture array");
    refused(eyes, one, 0, "frame.depth_texture has another size (got 1 layers, need desc.layers, 2)");
    refused(eyes, array, normals, "frame.normal_texture is a texture of another kind");
    refused(pass, array, 0, "frame.depth_texture is a texture of another kind");
    nook_nnao_destroy(&eyes);
  }
  for (nook_nnao* made : {&pass, &both}) nook_nnao_destroy(made);
}

TEST_CASE("nnao: the number of a normal's sample takes four bytes of each pixel of the surface") {
  nook_nnao_desc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, Normals::rebuilt);
  for (const int half : {0, 1})
    for (const int temporal : {0, 4}) {
      desc.half_resolution = half;
      desc.temporal_frames = temporal;
      std::uint64_t one = 0, with = 0;
      desc.normal_samples = 0;
      NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &one));
      desc.normal_samples = 4;
      NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &with));
      CHECK(with - one == std::uint64_t((temporal ? 8 : 4) * width * height / (half ? 4 : 1)));
    }
}

TEST_CASE("nnao: passes of multisampled images keep the state contract") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  const std::vector<float> image(std::size_t(width * height), 0.9f), colours(3 * image.size(), 0.9f);
  const std::vector<std::vector<float>> four(4, image), four_colours(4, colours);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS})
    for (const int layers : {0, 2})
      for (const Normals kind : {Normals::single, Normals::sampled}) {
        if (layers && !has_sample_arrays(context)) continue;
        NnaoFixture fixture(context, mode);
        Textures& textures = fixture.textures;
        const auto sampled = [&](SampledImage of, const std::vector<std::vector<float>>& images) {
          return layers ? textures.sample_array(of, width, height, {images, images})
                        : textures.samples(of, width, height, images);
        };
        const GLuint normals = kind == Normals::sampled ? sampled(SampledImage::colours, four_colours)
                               : layers ? textures.array(GL_RGB32F, 3, width, height, {colours, colours})
                                        : single_normals(fixture, colours);
        const nook_nnao_frame_desc frame =
            sampled_frame(plain_camera(float(width) / height), sampled(SampledImage::depth, four), normals);
        nook_nnao_desc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, kind, {.half = 1});
        desc.layers = layers;
        nook_nnao pass = create_pass(fixture.gl, desc);
        const unsigned compute =
            info_of(pass).path == NOOK_NNAO_PATH_COMPUTE ? unsigned{gl::screen_compute} : 0u;
        const unsigned images = layers ? gl::screen_layers | gl::screen_sample_layers : gl::screen_samples;
        Poison poison(context, gl::screen | images | compute);
        if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
        StateValues before = poison.touched();
        const StateValues untouched = poison.untouched();
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame));
        StateValues after = poison.touched();
        if (mode == NOOK_GL_STATE_DEFAULTS) before = poison.defaults(), after.erase("viewport");
        INFO("layers " << layers << ", normals " << int(kind));
        CHECK(after == before);
        CHECK(poison.untouched() == untouched);
        nook_nnao_destroy(&pass);
      }
}
