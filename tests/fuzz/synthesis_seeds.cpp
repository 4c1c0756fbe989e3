#include "sdk/src/synthesis/coordinates.h"
#include "tests/fuzz/seeds.h"
#include "tests/synthesis/coordinates_sample.h"

namespace nook::test {

std::vector<Seed> seeds() {
  std::vector<Seed> made;
  for (const std::uint32_t side : {1u, 8u, 16u})
    made.push_back({"synthesis_" + std::to_string(side) + ".nook",
                    synthesis::write_coordinates(synthesis::test::sample_coordinates(side, side + 2, 4))});
  return made;
}

}  // namespace nook::test
