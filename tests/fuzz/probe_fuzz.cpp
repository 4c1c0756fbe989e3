// Loads bytes as light probes, evaluates what loads and writes it again: nothing may crash, and nothing may
// be NaN, whatever the bytes. The checksum is repaired first, so that the fuzzer reaches what lies behind it.
// Built for libFuzzer with clang; elsewhere probe_fuzz_replay.cpp drives it.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/evaluate.h"
#include "sdk/src/probe/probe_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nook;
  using namespace nook::probe;
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = std::byte(data[i]);
  repair_checksum(bytes);
  try {
    const Probes probes = read_probes(bytes);
    std::array<Vec3, max_functions> storage;
    const std::span<Vec3> coefficients = std::span(storage).first(probes.basis.count);
    interpolate(probes, {0.4f, -1, 1e6f}, coefficients);
    for (const Vec3 d : {Vec3{0, 0, 1}, Vec3{0.6f, -0.8f, 0}}) {
      const Vec3 light = radiance(probes.basis, coefficients, d);
      const Vec3 lit = irradiance(probes.basis, coefficients, IrradianceForm::bands, d);
      for (const float value : {light.x, light.y, light.z, lit.x, lit.y, lit.z})
        if (!std::isfinite(value)) std::abort();
    }
    write_probes(probes, Packing::float32);
  } catch (const Failure&) {
  }
  return 0;
}
