// Loads bytes as a material, evaluates it and uploads it through the C ABI: nothing may crash, radiance is
// finite and visibility lies in [0, 1], whatever the bytes. Built for libFuzzer with clang; elsewhere
// material_fuzz_replay.cpp drives it.
#include <nook/nook_gl.h>

#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/reflectance.h"
#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"

namespace {

using namespace nook;
using namespace nook::test;

// Two kinds of inputs take long. A small file may expand to a large material; and one without view maps is
// resampled to 256 x 256 cells when it is loaded, 20 ms under the sanitizers.
enum class Work { refused, large, resampled, little };

Work work_of(std::span<const std::byte> file, material::Material& material) {
  const auto expanded = [](const material::TensorShape& s) {
    return std::uint64_t(s.clusters) * s.rank_light * s.rank_view * s.width * s.height;
  };
  try {
    material = material::read_material(file);
  } catch (const Failure&) {
    return Work::refused;
  }
  if (expanded(material.btf.shape) + expanded(material.votf.shape) + material.neural.blocks.size() >
          1 << 13 ||
      material.views.size() > 24)
    return Work::large;
  return material.btf.map.side == 0 ? Work::resampled : Work::little;
}

void fill(Script& script, float* numbers, int count) {
  for (int i = 0; i < count; ++i) numbers[i] = script.number();
}

// Numbers of the script, in the order of the corpus.
struct Numbers {
  float uv[2];
  float level;
  float view[3];
  float light[3];
};

bool is_reasonable(const Numbers& sample) {
  for (const float uv : sample.uv)
    if (!(std::abs(uv) < 1e6f)) return false;
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(sample.view[i]) < 1e3f && std::abs(sample.light[i]) < 1e3f)) return false;
  return true;
}

void evaluate(nook_material material, const Numbers& sample) {
  nook_material_value value{};
  const nook_material_pixel round{{sample.uv[0], sample.uv[1]},
                                  {sample.level, 0},
                                  {0, sample.level},
                                  {sample.view[0], sample.view[1], sample.view[2]},
                                  {sample.light[0], sample.light[1], sample.light[2]}};
  if (!ok(nook_material_evaluate(material, &round, 1, 1, &value))) return;
  require(value.visibility >= 0 && value.visibility <= 1);
  if (is_reasonable(sample))
    require(std::isfinite(value.radiance[0] + value.radiance[1] + value.radiance[2]));
  // The sample's numbers as the sides of a pixel too.
  const nook_material_pixel pixel{{sample.uv[0], sample.uv[1]},
                                  {sample.level, sample.light[0]},
                                  {sample.uv[1], sample.view[1]},
                                  {sample.view[0], sample.view[1], sample.view[2]},
                                  {sample.light[0], sample.light[1], sample.light[2]}};
  require(ok(nook_material_evaluate(material, &pixel, 1, 2, &value)));
  require(value.visibility >= 0 && value.visibility <= 1);
  if (is_reasonable(sample))
    require(std::isfinite(value.radiance[0] + value.radiance[1] + value.radiance[2]));
}

// Calls visit(sample) for some samples above the horizon and for the samples of the script.
template <class Visit>
void for_each_sample(Script& script, Visit&& visit) {
  for (const float level : {0.0f, 0.5f, 40.0f})
    for (int i = 0; i < 5; ++i) {
      const float angle = 1.3f * float(i), z = 0.2f * float(i + 1), r = std::sqrt(1 - z * z);
      visit(
          Numbers{{0.3f * float(i), -0.7f}, level, {r * std::cos(angle), r * std::sin(angle), z}, {0, r, z}});
    }
  for (int i = 0; i < 32 && !script.at_end(); ++i) {
    Numbers sample;
    fill(script, sample.uv, 2);
    sample.level = script.number();
    fill(script, sample.view, 3);
    fill(script, sample.light, 3);
    visit(sample);
  }
}

// The same resampling as on loading, to few cells.
void resample(const material::Material& material, Script& script) {
  constexpr std::uint32_t few_cells = 4;
  const material::MaterialTables tables =
      material::make_tables(material, Parallel(), default_memory(), few_cells);
  for_each_sample(script, [&](const Numbers& s) {
    if (!is_reasonable(s) || !std::isfinite(s.level)) return;  // the C interface refuses the others
    const material::Sample sample{
        s.uv[0], s.uv[1], s.level, {s.view[0], s.view[1], s.view[2]}, {s.light[0], s.light[1], s.light[2]}};
    const material::Radiance radiance = material::evaluate_btf(tables, sample);
    require(std::isfinite(radiance.red + radiance.green + radiance.blue));
  });
}

void upload(nook_gl gl, nook_material material) {
  nook_gl_upload uploaded = nullptr;
  if (!ok(nook_gl_upload_material(gl, material, &uploaded))) return;
  nook_gl_upload_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_gl_upload_describe(uploaded, &info)) && info.texture_count <= 16);
  for (std::uint32_t i = 0; i < info.texture_count; ++i) require(info.textures[i].uniform);
  nook_gl_upload_destroy(&uploaded);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ContainerInput input = split_input(data, size);
  material::Material read;
  const Work work = work_of(input.file, read);
  if (work == Work::large) return 0;
  const std::uint32_t settings = input.script.byte();
  if (work == Work::resampled && settings != 31) {
    resample(read, input.script);
    return 0;
  }
  nook_material_desc desc;
  require(ok(nook_material_desc_init(&desc)));
  desc.blocks = std::int32_t(settings >> 2 & 3) % 3;
  nook_material material = nullptr;
  if (!ok(nook_material_load(context_with_jobs(settings & 1), input.file.data(), input.file.size(), &desc,
                             &material))) {
    require(material == nullptr);
    return 0;
  }
  nook_material_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_material_describe(material, &info)) && info.width > 0 && info.view_count > 0);
  upload(gl_of_tier(settings & 2 ? 43 : 33), material);
  for_each_sample(input.script, [&](const Numbers& sample) { evaluate(material, sample); });
  nook_material_destroy(&material);
  return 0;
}
