// Loads bytes as a material, evaluates it and uploads it through the C ABI: nothing may crash, radiance is
// finite and visibility lies in [0, 1], whatever the bytes. Built for libFuzzer with clang; elsewhere
// material_fuzz_replay.cpp drives it.
#include <nook/nook_gl_material.h>

#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_file.h"
#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"

namespace {

using namespace nook::test;

// The size that a small file may expand to is bounded, but not worth a fuzzer's time beyond this.
bool is_small(std::span<const std::byte> file) {
  const auto expanded = [](const nook::material::TensorShape& s) {
    return std::uint64_t(s.clusters) * s.rank_light * s.rank_view * s.width * s.height;
  };
  try {
    const nook::material::Material material = nook::material::read_material(file);
    return expanded(material.btf.shape) + expanded(material.votf.shape) <= 1 << 16 &&
           material.views.size() <= 64;
  } catch (const nook::Failure&) {
    return true;  // the library refuses it as fast
  }
}

void fill(Script& script, float* numbers, int count) {
  for (int i = 0; i < count; ++i) numbers[i] = script.number();
}

bool is_reasonable(const nook_material_sample& sample) {
  for (const float uv : sample.uv)
    if (!(std::abs(uv) < 1e6f)) return false;
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(sample.view[i]) < 1e3f && std::abs(sample.light[i]) < 1e3f)) return false;
  return true;
}

void evaluate(nook_material material, const nook_material_sample& sample) {
  nook_material_value value{};
  if (!ok(nook_material_evaluate(material, &sample, 1, &value))) return;
  require(value.visibility >= 0 && value.visibility <= 1);
  if (is_reasonable(sample))
    require(std::isfinite(value.radiance[0] + value.radiance[1] + value.radiance[2]));
}

void evaluate_directions(nook_material material, Script& script) {
  for (const float level : {0.0f, 0.5f, 40.0f})
    for (int i = 0; i < 5; ++i) {
      const float angle = 1.3f * float(i), z = 0.2f * float(i + 1), r = std::sqrt(1 - z * z);
      evaluate(material,
               {{0.3f * float(i), -0.7f}, level, {r * std::cos(angle), r * std::sin(angle), z}, {0, r, z}});
    }
  for (int i = 0; i < 32 && !script.at_end(); ++i) {
    nook_material_sample sample;
    fill(script, sample.uv, 2);
    sample.level = script.number();
    fill(script, sample.view, 3);
    fill(script, sample.light, 3);
    evaluate(material, sample);
  }
}

void upload(nook_gl gl, nook_material material, Script& script) {
  nook_gl_material_desc desc;
  ok(nook_gl_material_desc_init(&desc, sizeof desc, NOOK_VERSION));
  desc.max_layers = std::int32_t(script.byte());
  nook_gl_material uploaded = nullptr;
  if (!ok(nook_gl_material_create(gl, material, script.below(2) ? &desc : nullptr, &uploaded))) return;
  nook_gl_material_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_gl_material_describe(uploaded, &info)) && info.texture_count <= 16);
  for (std::uint32_t i = 0; i < info.texture_count; ++i) {
    nook_gl_material_texture texture{};
    texture.struct_size = sizeof texture;
    require(ok(nook_gl_material_describe_texture(uploaded, i, &texture)) && texture.uniform);
  }
  nook_gl_material_destroy(&uploaded);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ContainerInput input = split_input(data, size);
  if (!is_small(input.file)) return 0;
  const std::uint32_t settings = input.script.byte();
  nook_material material = nullptr;
  if (!ok(nook_material_load(context_with_jobs(settings & 1), input.file.data(), input.file.size(),
                             &material))) {
    require(material == nullptr);
    return 0;
  }
  nook_material_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_material_describe(material, &info)) && info.width > 0 && info.view_count > 0);
  upload(gl_of_tier(settings & 2 ? 43 : 33), material, input.script);
  evaluate_directions(material, input.script);
  nook_material_destroy(&material);
  return 0;
}
