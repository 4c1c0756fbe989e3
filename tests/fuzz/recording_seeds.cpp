#include "sdk/src/nnao/recording_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/nnao/recording_sample.h"

namespace nook::test {

std::vector<Seed> seeds() {
  nnao::Recording linear = sample_recording(5, 4);
  linear.frame.depth_kind = 1;
  linear.frame.sky_depth = 0.98f;
  linear.frame.view = 2;
  linear.pass.half_resolution = 1;
  nnao::Recording orthographic = sample_recording(4, 4, false);
  const float parallel[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, -0.2f, 0, 0, 0, -1, 1};
  std::ranges::copy(parallel, orthographic.frame.projection);
  return {{"recording_0.nook", nnao::write_recording(sample_recording(6, 5))},
          {"recording_1.nook", nnao::write_recording(linear)},
          {"recording_2.nook", nnao::write_recording(orthographic)}};
}

}  // namespace nook::test
