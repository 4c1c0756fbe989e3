#include "sdk/src/transfer/transfer_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/transfer/transfer_sample.h"

namespace nook::test {

std::vector<Seed> seeds() {
  std::vector<Seed> made;
  for (const std::uint32_t lobes : {12u, 19u, 42u})
    made.push_back({"transfer_" + std::to_string(lobes) + ".nook",
                    transfer::write_transfer(transfer::test::sample_transfer(lobes / 4, lobes, lobes % 3))});
  for (const std::uint32_t lobes : {12u, 19u})
    made.push_back({"transfer_paper_" + std::to_string(lobes) + ".nook",
                    transfer::write_transfer(transfer::test::sample_paper(7, lobes, 4, 5, lobes % 2))});
  return made;
}

}  // namespace nook::test
