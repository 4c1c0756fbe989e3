#include "bakers/material/raw_material.h"
#include "tests/bakers/material/small_material.h"
#include "tests/fuzz/seeds.h"

namespace nook::test {

std::vector<Seed> seeds() {
  namespace material = bake::material;
  const material::RawMaterial masked = material::test::small_material(4, 5, 4, 3);
  material::RawMaterial open = material::test::small_material(4, 4, 1, 2);
  open.mask.clear();
  open.name = "";
  return {{"raw_0.nook", material::write_raw_material(masked)},
          {"raw_1.nook", material::write_raw_material(open)}};
}

}  // namespace nook::test
