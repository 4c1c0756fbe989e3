// Loads bytes as radiance transfer and lights it through the C ABI: nothing may crash, and vectors are
// finite, whatever the bytes.
#include <nook/experimental/nook_transfer.h>

#include <cmath>
#include <vector>

#include "sdk/src/material/material_file.h"
#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"
#include "tests/material/material_sample.h"

namespace {

using namespace nook::test;

constexpr std::uint32_t most_lobes = 64, most_vertices = 256;

// The response of a small material, made once for each number of lobes.
nook_transfer_response response_of(std::uint32_t lobes) {
  static nook_transfer_response made[most_lobes + 1] = {};
  if (made[lobes]) return made[lobes];
  const std::vector<std::byte> bytes =
      nook::material::write_material(nook::material::test::sample_material(2));
  nook_material material = nullptr;
  require(ok(nook_material_load(context_with_jobs(false), bytes.data(), bytes.size(), nullptr, &material)));
  nook_transfer_response_desc desc;
  require(ok(nook_transfer_response_desc_init(&desc)));
  desc.material = material;
  desc.lobe_count = lobes;
  require(ok(nook_transfer_response_create(context_with_jobs(false), &desc, &made[lobes])));
  nook_material_destroy(&material);
  return made[lobes];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ContainerInput input = split_input(data, size);
  nook_transfer transfer = nullptr;
  if (!ok(nook_transfer_load(context_with_jobs(input.script.byte() & 1), input.file.data(), input.file.size(),
                             &transfer))) {
    require(transfer == nullptr);
    return 0;
  }
  nook_transfer_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_transfer_describe(transfer, &info)) && info.vertex_count > 0 && info.lobe_count >= 12);
  if (info.lobe_count <= most_lobes && info.vertex_count <= most_vertices) {
    std::vector<float> frames(std::size_t(7) * info.vertex_count);
    const nook_result read = nook_transfer_read_frames(
        transfer, frames.data(), frames.data() + 3 * info.vertex_count, info.vertex_count);
    require(info.form == NOOK_FORM_PAPER ? read == NOOK_ERROR_UNSUPPORTED : ok(read));
    for (const float number : frames) require(std::isfinite(number));
    std::vector<float> amplitudes(3 * info.lobe_count);
    for (float& amplitude : amplitudes) amplitude = std::fmod(input.script.number(), 1e3f);
    const nook_transfer_response response = response_of(info.lobe_count);
    nook_transfer_response_info described{};
    described.struct_size = sizeof described;
    require(ok(nook_transfer_response_describe(response, &described)));
    std::vector<float> vectors(std::size_t(described.vector_floats) * info.vertex_count);
    nook_transfer_vectors_desc desc;
    require(ok(nook_transfer_vectors_desc_init(&desc)));
    desc.transfer = transfer;
    desc.amplitudes = amplitudes.data();
    desc.lobe_count = info.lobe_count;
    if (ok(nook_transfer_read_vectors(response, &desc, vectors.data(), info.vertex_count, 0)))
      for (const float number : vectors) require(std::isfinite(number));
  }
  nook_transfer_destroy(&transfer);
  return 0;
}
