// The rules that choose a sample of a pixel, by their errors against the mean AO over the pixel.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>

#include "tests/gl/nnao_sampled_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = sampled_width, height = sampled_height;

constexpr std::size_t ways = std::size(sample_rules);

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
      of_rule[r] = make_sampled_pass(fixture, 4, sample_rules[r], Normals::single, {.taps = taps});
  }
  ~RulePasses() {
    for (nook_nnao& pass : of_rule) nook_nnao_destroy(&pass);
  }
  RulePasses(const RulePasses&) = delete;
  RulePasses& operator=(const RulePasses&) = delete;

  nook_nnao of_rule[ways] = {};
};

// The truth of a pixel is the mean AO of pictures with 64 taps at 16 places in it, which are none of the
// samples: no rule has its own noise in it.
std::vector<float> mean_over_pixels(NnaoFixture& fixture, const Samples& fine, bool given) {
  nook_nnao pass = fixture.pass_of(64, 0, 1, nullptr);
  std::vector<float> mean(std::size_t(width * height), 0.0f);
  for (std::size_t s = 0; s < fine.stored.size(); ++s) {
    const GLuint depth = fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, fine.stored[s]);
    const GLuint normals = given ? fixture.normals_of(fine.pictures[s]) : 0;
    const std::vector<float> ao =
        drawn_ao(fixture, pass, frame_desc(fine.cameras[s], width, height, depth, normals, 0.5f));
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += ao[i] / float(fine.stored.size());
  }
  return mean;
}

// The normal of a pixel by each way to resolve its samples: the sample whose depth it has, the mean, or
// sample 0.
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
    add_errors(drawn_ao(fixture, passes.of_rule[r], sampled_frame(view.camera, depth, normals)), view, r,
               errors);
}

// Adds the errors of each way to resolve normals, with the depth of the median.
void measure_normal_rules(NnaoFixture& fixture, const RulePasses& passes, const MeasuredView& view,
                          RuleErrors& errors) {
  const GLuint depth = fixture.textures.samples(SampledImage::depth, width, height, view.samples.stored);
  for (std::size_t r = 0; r < ways; ++r) {
    const GLuint normals = single_normals(fixture, normals_by(r, view.samples));
    add_errors(drawn_ao(fixture, passes.of_rule[0], sampled_frame(view.camera, depth, normals)), view, r,
               errors);
  }
}

}  // namespace

TEST_CASE("nnao: the default rule has the smallest error against the mean over a pixel") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  NnaoFixture fixture(context);
  const std::vector<Camera> all = cameras(float(width) / height);
  PassDesc desc;
  REQUIRE(desc.debug.depth_sample == sample_rules[0]);
  const auto first_is_least = [](const RuleErrors& errors) {
    // With nine taps and rebuilt normals, the nearest sample is as good: by noise, 0.6 % better than the
    // median.
    for (std::size_t r = 1; r < ways; ++r) CHECK(errors.everywhere[0] < 1.02 * errors.everywhere[r]);
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
