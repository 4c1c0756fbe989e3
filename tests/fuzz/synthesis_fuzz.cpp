// Loads bytes as a coordinate texture and looks points up through the C ABI: nothing may crash, and
// coordinates are finite, whatever the bytes.
#include <nook/experimental/nook_synthesis.h>

#include <cmath>

#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nook::test;
  ContainerInput input = split_input(data, size);
  nook_synthesis synthesis = nullptr;
  if (!ok(nook_synthesis_load(context_with_jobs(input.script.byte() & 1), input.file.data(),
                              input.file.size(), &synthesis))) {
    require(synthesis == nullptr);
    return 0;
  }
  nook_synthesis_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_synthesis_describe(synthesis, &info)) && info.side > 0 && info.material_width > 0);
  for (int i = 0; i < 8; ++i) {
    const float plane[2] = {input.script.number(), input.script.number()};
    float at[2] = {0, 0};
    const bool is_finite = std::isfinite(plane[0]) && std::isfinite(plane[1]);
    require(ok(nook_synthesis_material_uvs(synthesis, plane, 1, at)) == is_finite);
    require(at[0] >= 0 && at[0] <= 1 && at[1] >= 0 && at[1] <= 1);
  }
  nook_synthesis_destroy(&synthesis);
  return 0;
}
