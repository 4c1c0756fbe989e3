#include "sdk/src/material/material_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/material/material_sample.h"

namespace nook::test {

std::vector<Seed> seeds() {
  std::vector<Seed> made;
  for (const material::test::SampleSize& size : material::test::sample_forms)
    made.push_back({"material_" + std::to_string(made.size()) + ".nook",
                    material::write_material(material::test::sample_material(1, size))});
  return made;
}

}  // namespace nook::test
