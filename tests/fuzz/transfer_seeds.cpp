#include "sdk/src/material/material_file.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/transfer/transfer_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/material/material_sample.h"
#include "tests/transfer/transfer_sample.h"

namespace nook::test {

std::vector<Seed> seeds() {
  std::vector<Seed> made;
  for (const std::uint32_t lobes : {12u, 19u, 42u})
    made.push_back({"transfer_" + std::to_string(lobes) + ".nook",
                    transfer::write_transfer(transfer::test::sample_transfer(lobes / 4, lobes, lobes % 3))});
  // The paper's form for the material of the fuzz target.
  const material::MaterialTables tables = material::make_tables(
      material::read_material(material::write_material(material::test::sample_material(2))), {},
      default_memory(), 8);
  for (const std::uint32_t lobes : {12u, 19u})
    made.push_back({"transfer_paper_" + std::to_string(lobes) + ".nook",
                    transfer::write_transfer(transfer::test::sample_paper(7, lobes, tables.btf.light_modes,
                                                                          tables.light_hash, lobes % 2))});
  return made;
}

}  // namespace nook::test
