#include "tests/gl/nnao_sampled_images.h"

#include <algorithm>

#include "sdk/src/nnao/host_depth.h"
#include "tests/gl/test_context.h"

namespace nook::test {
namespace {

// Moves what a pixel shows by a share of a pixel.
Camera shifted(Camera camera, float x_px, float y_px) {
  const bool perspective = camera.projection[11] != 0;
  const float x = 2 * x_px / sampled_width, y = 2 * y_px / sampled_height;
  camera.projection[perspective ? 8 : 12] += perspective ? x : -x;
  camera.projection[perspective ? 9 : 13] += perspective ? y : -y;
  return camera;
}

// The sample of a pixel that the rule takes.
std::size_t chosen(nook_nnao_sample rule, const Samples& samples, std::size_t pixel) {
  std::vector<float> depths;
  for (const Picture& picture : samples.pictures) depths.push_back(picture.depth[pixel]);
  return nnao::chosen_sample(nnao::SampleRule(rule), depths);
}

}  // namespace

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

// Balls, and a fence of thin ones, whose edges cover parts of pixels.
std::vector<Surface> fenced_still_life() {
  std::vector<Surface> scene = still_life();
  for (int i = 0; i < 12; ++i)
    scene.push_back(ball({-1.0f + 0.18f * float(i), -0.2f + 0.05f * float(i % 3), -2.8f}, 0.035f));
  return scene;
}

Places rotated_grid() {
  return {{-0.125f, -0.375f}, {0.375f, -0.125f}, {-0.375f, 0.125f}, {0.125f, 0.375f}};
}

Samples look_at_samples(const Camera& camera, const std::vector<Surface>& scene, const Places& places) {
  Samples samples;
  for (const auto& [x, y] : places) {
    samples.cameras.push_back(shifted(camera, x, y));
    samples.pictures.push_back(look(samples.cameras.back(), scene, sampled_width, sampled_height));
    samples.stored.push_back(stored_depth(samples.cameras.back(), samples.pictures.back()));
    samples.normals.push_back(halved_range(flat(samples.pictures.back().normal)));
  }
  return samples;
}

Resolved resolved(nook_nnao_sample rule, const Samples& samples) {
  Resolved result;
  for (std::size_t pixel = 0; pixel < samples.stored[0].size(); ++pixel) {
    const std::size_t sample = chosen(rule, samples, pixel);
    result.stored.push_back(samples.stored[sample][pixel]);
    for (std::size_t c = 0; c < 3; ++c) result.normals.push_back(samples.normals[sample][3 * pixel + c]);
  }
  return result;
}

PassDesc sampled_desc(int samples, nook_nnao_sample rule, Normals normals, const SampledSettings& settings) {
  PassDesc desc = pass_desc(sampled_width, sampled_height);
  desc.depth_samples = samples;
  desc.debug.depth_sample = rule;
  desc.normal_samples = normals == Normals::sampled ? samples : 0;
  desc.half_resolution = settings.half;
  desc.max_history_frames = settings.temporal;
  desc.bent_normals = settings.bent;
  desc.taps = settings.taps;
  desc.debug.path = settings.path;
  return desc;
}

nook_nnao make_sampled_pass(NnaoFixture& fixture, int samples, nook_nnao_sample rule, Normals normals,
                            const SampledSettings& settings) {
  return create_pass(fixture.gl, sampled_desc(samples, rule, normals, settings));
}

ScreenFrame sampled_frame(const Camera& camera, GLuint depth, GLuint normals) {
  ScreenFrame frame = frame_desc(camera, sampled_width, sampled_height, depth, normals, 0.5f);
  frame.normal_scale = 2;
  frame.normal_bias = -1;
  return frame;
}

GLuint single_normals(NnaoFixture& fixture, const std::vector<float>& normals) {
  return fixture.textures.floats(GL_RGB32F, 3, sampled_width, sampled_height, normals);
}

std::vector<float> drawn_ao(NnaoFixture& fixture, nook_nnao pass, const ScreenFrame& frame) {
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  return own_ao(fixture.context.gl(), pass, sampled_width, sampled_height);
}

}  // namespace nook::test
