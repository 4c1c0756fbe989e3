// Loads bytes as a recorded frame through the C ABI, writes what loads, makes another one with numbers of the
// input's choice, and replays it as the tool does: nothing may crash, and a file that was written loads again
// with the same bytes, whatever the bytes. Built for libFuzzer with clang; elsewhere replay.cpp drives it.
#include <nook/experimental/nook_recording.h>

#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/recording_file.h"
#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"
#include "tests/gl/chained_descs.h"

namespace {

using namespace nook::test;

constexpr std::int32_t max_pixels = 4096;  // of what is evaluated
// The host's textures: names that this OpenGL never hands out.
constexpr std::uint32_t first_texture = 1u << 30;

std::vector<std::byte> saved(nook_nnao_recording recording) {
  std::size_t size = 0;
  require(ok(nook_nnao_recording_save(recording, nullptr, &size)));
  std::vector<std::byte> file(size);
  require(ok(nook_nnao_recording_save(recording, file.data(), &size)));
  return file;
}

nook_nnao_recording_desc held(nook_nnao_recording recording) {
  nook_nnao_recording_desc desc{};
  desc.struct_size = sizeof desc;
  require(ok(nook_nnao_recording_describe(recording, &desc)));
  return desc;
}

void save(nook_context context, nook_nnao_recording recording) {
  const std::vector<std::byte> file = saved(recording);
  nook_nnao_recording again = nullptr;
  require(ok(nook_nnao_recording_load(context, file.data(), file.size(), &again)));
  require(saved(again) == file);
  nook_nnao_recording_destroy(&again);
}

// Depths and normals as the evaluation shows them.
void evaluate(const std::vector<std::byte>& file) {
  const nook::nnao::Recording recording = nook::nnao::read_recording(file);
  const std::vector<float> depths = nook::nnao::view_depths(recording);
  require(depths.size() == recording.pixels());
  for (const float depth : depths) require(!std::isnan(depth));
  require(nook::nnao::view_normals(recording, depths).size() == recording.pixels());
  nook::nnao::recorded_network(recording);
}

void replay(nook_gl gl, const nook_nnao_recording_desc& recorded) {
  silent_gl().width = recorded.width;
  silent_gl().height = recorded.height;
  silent_gl().depth_bits = recorded.depth_kind == NOOK_DEPTH_LINEAR ? 0 : 24;
  nook_nnao_desc desc;
  ok(nook_nnao_desc_init(&desc));
  desc.max_width = recorded.width;
  desc.max_height = recorded.height;
  desc.taps = recorded.taps;
  desc.half_resolution = recorded.half_resolution;
  desc.blur = recorded.blur;
  desc.blur_sharpness = recorded.blur_sharpness;
  desc.network = recorded.network;
  desc.network_size = recorded.network_size;
  nook_nnao pass = nullptr;
  if (!ok(nook_nnao_create(gl, &desc, &pass))) {
    // The network alone may be one that this library does not evaluate.
    desc.network = nullptr;
    desc.network_size = 0;
    require(ok(nook_nnao_create(gl, &desc, &pass)));
  }
  ScreenFrame frame;
  frame.width = recorded.width;
  frame.height = recorded.height;
  frame.depth_texture = first_texture;
  frame.depth_kind = recorded.depth_kind;
  frame.sky_depth = recorded.sky_depth;
  frame.normal_texture = recorded.normals ? first_texture + 1 : 0;
  frame.normal_scale = recorded.normal_scale;
  frame.normal_bias = recorded.normal_bias;
  std::copy_n(recorded.normal_matrix, 9, frame.normal_matrix);
  std::copy_n(recorded.projection, 16, frame.projection);
  frame.clip_space = recorded.clip;
  frame.radius = recorded.radius;
  frame.radius_kind = recorded.radius_kind;
  frame.max_radius_px = recorded.max_radius_px;
  frame.min_radius_px = recorded.min_radius_px;
  frame.fade_begin = recorded.fade_begin;
  frame.fade_end = recorded.fade_end;
  frame.intensity = recorded.intensity;
  frame.power = recorded.power;
  frame.gbuffer_ao = recorded.layer;
  frame.gbuffer_ao_texture = recorded.layer ? first_texture + 2 : 0;
  frame.debug.show = recorded.view;
  // A recording is a frame that the pass takes.
  require(ok(nook_nnao_render(pass, &frame, &frame)));
  nook_nnao_destroy(&pass);
  silent_gl() = {};
}

// A recording with a few numbers of the script.
void change(nook_context context, nook_nnao_recording recording, Script& script) {
  nook_nnao_recording_desc desc = held(recording);
  const std::uint32_t choice = script.byte();
  if (choice & 1) desc.projection[script.below(16)] = script.number();
  if (choice & 2) desc.normal_matrix[script.below(9)] = script.number();
  if (choice & 4)
    for (float* number : {&desc.radius, &desc.max_radius_px, &desc.min_radius_px, &desc.fade_begin,
                          &desc.fade_end, &desc.intensity, &desc.power, &desc.sky_depth})
      *number = script.number();
  if (choice & 8) desc.taps = 1 << script.below(10);
  if (choice & 16) desc.blur_sharpness = script.number();
  if (choice & 32) desc.depth_kind = std::int32_t(script.below(3));
  if (choice & 64) desc.layer = std::int32_t(script.below(5));
  if (choice & 128) {
    desc.normals = nullptr;
    desc.radius_kind = std::int32_t(script.below(3));
  }
  nook_nnao_recording other = nullptr;
  if (!ok(nook_nnao_recording_create(context, &desc, &other))) {
    require(other == nullptr);
    return;
  }
  save(context, other);
  evaluate(saved(other));
  replay(gl_of_tier(33), held(other));
  nook_nnao_recording_destroy(&other);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ContainerInput input = split_input(data, size);
  const nook_context context = context_with_jobs(false);
  nook_nnao_recording recording = nullptr;
  if (!ok(nook_nnao_recording_load(context, input.file.data(), input.file.size(), &recording))) {
    require(recording == nullptr);
    return 0;
  }
  save(context, recording);
  const nook_nnao_recording_desc desc = held(recording);
  if (desc.width * desc.height <= max_pixels) {
    evaluate(input.file);
    replay(gl_of_tier(input.script.below(2) ? 43 : 33), desc);
    change(context, recording, input.script);
  }
  nook_nnao_recording_destroy(&recording);
  return 0;
}
