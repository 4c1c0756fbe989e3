// Multisampled depth and normals of a small scene, the samples that the rules take, and passes that read
// them.
#pragma once

#include <cstdio>
#include <utility>
#include <vector>

#include "tests/gl/nnao_images.h"

namespace nook::test {

// The size of the images, in pixels.
constexpr int sampled_width = 96, sampled_height = 64;

// The default one first.
constexpr nook_nnao_sample sample_rules[] = {NOOK_NNAO_SAMPLE_MEDIAN, NOOK_NNAO_SAMPLE_FIRST,
                                             NOOK_NNAO_SAMPLE_NEAREST};

// Four, or none where the context has no multisample textures.
int samples_of(const platform::Context& context);
bool has_sample_arrays(const platform::Context& context);

#define NOOK_NEED_SAMPLES(context)                                    \
  if (samples_of(context) == 0) {                                     \
    std::printf("no multisampled depth textures: not tested here\n"); \
    return;                                                           \
  }

// Balls, and a fence of thin ones, whose edges cover parts of pixels.
std::vector<Surface> fenced_still_life();

struct Samples {
  std::vector<Camera> cameras;  // of each sample
  std::vector<Picture> pictures;
  std::vector<std::vector<float>> stored;
  std::vector<std::vector<float>> normals;  // as halved_range has them
};

// Places in a pixel, from its centre: by default a rotated grid, as GPUs have it.
using Places = std::vector<std::pair<float, float>>;
Places rotated_grid();
Samples look_at_samples(const Camera& camera, const std::vector<Surface>& scene,
                        const Places& places = rotated_grid());

// Depth and normals of the samples that the rule takes.
struct Resolved {
  std::vector<float> stored, normals;
};
Resolved resolved(nook_nnao_sample rule, const Samples& samples);

// The kinds of normals that a pass of multisampled depth reads.
enum class Normals { rebuilt, single, sampled };

struct SampledSettings {
  int half = 0, temporal = 0, bent = 0, taps = 9;
  nook_nnao_path path = NOOK_NNAO_PATH_AUTOMATIC;
};
PassDesc sampled_desc(int samples, nook_nnao_sample rule, Normals normals,
                      const SampledSettings& settings = {});
nook_nnao make_sampled_pass(NnaoFixture& fixture, int samples, nook_nnao_sample rule,
                            Normals normals = Normals::rebuilt, const SampledSettings& settings = {});

// A frame whose normals are as halved_range has them.
ScreenFrame sampled_frame(const Camera& camera, GLuint depth, GLuint normals);
// A texture of one normal for each pixel.
GLuint single_normals(NnaoFixture& fixture, const std::vector<float>& normals);
// The pass's own AO of a frame.
std::vector<float> drawn_ao(NnaoFixture& fixture, nook_nnao pass, const ScreenFrame& frame);

}  // namespace nook::test
