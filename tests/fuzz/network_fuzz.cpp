// Loads bytes as a network of the screen-space pass, renders frames with it through the C ABI and evaluates
// it by the reference: nothing may crash, and AO lies in [0, 1], whatever the bytes. Built for libFuzzer with
// clang; elsewhere network_fuzz_replay.cpp drives it.
#include <nook/experimental/nook_recording.h>
#include <nook/experimental/nook_stages.h>

#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/network_evaluate.h"
#include "sdk/src/nnao/network_file.h"
#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"
#include "tests/gl/chained_descs.h"

namespace {

using namespace nook::test;

// A step with sky above it.
struct Picture {
  static constexpr std::uint32_t size = 8;
  std::vector<float> depth;
  std::vector<nook::Vec3> normal;

  Picture() {
    for (std::uint32_t i = 0; i < size * size; ++i) {
      depth.push_back(i / size < 3 ? 2.0f : i / size < 6 ? 2.2f : std::numeric_limits<float>::infinity());
      normal.push_back({0, 0, 1});
    }
  }
  nook::nnao::View view(bool orthographic) const {
    return {size, size, {0.2f, -0.8f, 0.2f, -0.8f, orthographic}, depth, normal};
  }
};

// At the four corners of a block of noise, and in the sky.
void evaluate(const std::vector<std::byte>& file, Script& script) {
  constexpr std::array<std::uint32_t, 5> taps{16, 32, 64, 128, 256};
  const Picture picture;
  const nook::nnao::View view = picture.view(script.below(2) == 1);
  try {
    const nook::nnao::Network network = nook::nnao::read_network(file);
    const nook::nnao::Sampling sampling{0.7f, 16, taps[script.below(2)]};
    for (const std::uint32_t y : {1u, 4u, 7u})
      for (const std::uint32_t x : {1u, 6u}) {
        const float ao = nook::nnao::evaluate_pixel(network, view, sampling, x, y);
        require(ao >= 0 && ao <= 1);
      }
  } catch (const nook::Failure&) {
  }
}

PassDesc pass_of(const std::vector<std::byte>& file, Script& script) {
  PassDesc desc;
  desc.max_width = desc.max_height = 16;
  desc.network = file.data();
  desc.network_size = file.size();
  const std::uint32_t settings = script.byte();
  desc.half_resolution = settings & 1;
  desc.blur = !(settings & 2);
  desc.debug.timers = settings >> 2 & 1;
  desc.debug.path = nook_nnao_path(settings >> 3 & 3);
  if (settings & 32) desc.taps = 1 << script.below(10);
  if (settings & 64) desc.blur_sharpness = script.number();
  if (settings & 128) {
    desc.views = std::int32_t(script.below(10)) - 1;
    desc.depth_samples = std::int32_t(script.below(20)) - 2;
    desc.debug.depth_sample = nook_nnao_sample(script.below(4));
    desc.normal_samples = script.below(4) ? desc.depth_samples : std::int32_t(script.below(20)) - 2;
  }
  return desc;
}

// A frame that is sound unless the script says otherwise.
ScreenFrame frame_of(Script& script) {
  ScreenFrame frame;
  frame.width = silent_gl().width;
  frame.height = silent_gl().height;
  frame.depth_texture = 1000;
  frame.radius = 0.5f;
  const float projection[16] = {1.5f, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, -1.002f, -1, 0, 0, -0.2f, 0};
  std::copy_n(projection, 16, frame.projection);
  const std::uint32_t settings = script.byte();
  if (settings & 1) frame.normal_texture = 1001;
  if (settings & 2) {
    frame.gbuffer_ao = nook_gbuffer_ao(script.below(6));
    frame.gbuffer_ao_texture = 1002;
  }
  if (settings & 4) {
    frame.target = nook_target(script.below(4));
    frame.target_name = 999 + script.below(6);
    frame.blend = nook_blend(script.below(3));
  }
  if (settings & 8) frame.debug.show = nook_nnao_view(script.below(5));
  if (settings & 16) {
    frame.depth_kind = nook_depth_kind(script.below(4));
    frame.radius_kind = nook_nnao_radius_kind(script.below(4));
    for (float* number :
         {&frame.scene_size, &frame.depth_log_scale, &frame.depth_log_near, &frame.depth_log_far})
      *number = script.number();
    frame.sky_depth = script.number();
    frame.clip_space = nook_clip_space(script.below(3));
  }
  if (settings & 32) frame.projection[script.below(16)] = script.number();
  if (settings & 64)
    for (float* number :
         {&frame.radius, &frame.max_radius_px, &frame.min_radius_px, &frame.fade_begin, &frame.fade_end,
          &frame.intensity, &frame.power, &frame.normal_scale, &frame.normal_matrix[4]})
      *number = script.number();
  if (settings & 128)
    for (std::int32_t& number : frame.viewport) number = std::int32_t(script.below(20)) - 4;
  return frame;
}

void render(const std::vector<std::byte>& file, Script& script) {
  const nook_gl gl = gl_of_tier(script.below(2) ? 43 : 33);
  const PassDesc desc = pass_of(file, script);
  std::uint64_t bytes = 0;
  ok(nook_nnao_memory(&desc, &bytes));
  nook_nnao pass = nullptr;
  if (!ok(nook_nnao_create(gl, &desc, &pass))) {
    require(pass == nullptr);
    return;
  }
  int frames = 0;
  do {
    ScreenFrame frame = frame_of(script);
    ok(nook_nnao_render(pass, &frame, &frame));
    frame.textures_changed = script.below(4) == 3;
  } while (++frames < 4 && !script.at_end());
  if (script.below(2) == 1) {
    ScreenFrame frame = frame_of(script);
    nook_nnao_recording recording = nullptr;
    require(ok(nook_nnao_record(pass, &frame, &frame, nullptr, &recording)) == (recording != nullptr));
    nook_nnao_recording_destroy(&recording);
  }
  nook_nnao_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_nnao_describe(pass, &info)) && info.texture_bytes >= bytes);
  nook_nnao_timings timings{};
  timings.struct_size = sizeof timings;
  ok(nook_nnao_read_timings(pass, &timings));
  nook_nnao_destroy(&pass);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ContainerInput input = split_input(data, size);
  evaluate(input.file, input.script);
  render(input.file, input.script);
  return 0;
}
