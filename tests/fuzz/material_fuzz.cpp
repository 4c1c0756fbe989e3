// Loads bytes as a material and decodes what loads: nothing may crash, whatever the bytes. The checksum is
// repaired first, so that the fuzzer reaches what lies behind it. Built for libFuzzer with clang; elsewhere
// material_fuzz_replay.cpp drives it.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "sdk/src/core/failure.h"
#include "sdk/src/material/evaluate.h"
#include "sdk/src/material/material_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nook;
  using namespace nook::material;
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = std::byte(data[i]);
  repair_checksum(bytes);
  try {
    const Material material = read_material(bytes);
    // What a small file may expand to is bounded, but not worth a fuzzer's time.
    const TensorShape &btf = material.btf.shape, &votf = material.votf.shape;
    const auto expanded = [](const TensorShape& s) {
      return std::uint64_t(s.clusters) * s.rank_light * s.rank_view * s.width * s.height;
    };
    if (expanded(btf) + expanded(votf) > 1 << 20) return 0;
    const MaterialTables tables = make_tables(material, {}, std::pmr::new_delete_resource(), 8);
    for (const Vec3 d : material.views) {
      const Sample sample{d.x, d.y, 3 * d.z, d, material.lights[0]};
      const Radiance radiance = evaluate_btf(tables, sample);
      if (!std::isfinite(radiance.red + radiance.green + radiance.blue)) std::abort();
      const float visible = visibility_of(tables.visibility, tables.mapping, evaluate_votf(tables, sample));
      if (!(visible >= 0 && visible <= 1)) std::abort();
    }
  } catch (const Failure&) {
  }
  return 0;
}
