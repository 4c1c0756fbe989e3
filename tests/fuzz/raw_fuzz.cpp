// Loads bytes as a raw material, and what loads is written and loaded again: nothing may crash, every texel
// is finite, and the second reading equals the first, whatever the bytes. Built for libFuzzer with clang;
// elsewhere raw_fuzz_replay.cpp drives it.
#include <cmath>

#include "bakers/material/raw_material.h"
#include "sdk/src/core/failure.h"
#include "tests/fuzz/container_input.h"

namespace {

using namespace nook::bake::material;
using nook::test::require;

void check(const RawMaterial& raw) {
  const std::size_t visible = raw.views.size() * raw.texels();
  require(!raw.lights.empty() && visible > 0 && raw.btf.size() == raw.light_rows() * visible);
  require(raw.mask.empty() || raw.mask.size() == visible);
  for (const float value : raw.btf) require(std::isfinite(value));
  for (const float value : raw.mask) require(value == 0 || value == 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const nook::test::ContainerInput input = nook::test::split_input(data, size);
  try {
    const RawMaterial raw = read_raw_material(input.file);
    check(raw);
    const RawMaterial again = read_raw_material(write_raw_material(raw));
    require(again.name == raw.name && again.lights == raw.lights && again.views == raw.views);
    require(again.width == raw.width && again.btf == raw.btf && again.mask == raw.mask);
  } catch (const nook::Failure&) {
  }
  return 0;
}
