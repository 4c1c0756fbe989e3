#include "sdk/src/probe/probe_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/probe/probe_sample.h"

namespace nook::test {

std::vector<Seed> seeds() {
  std::vector<Seed> made;
  for (const probe::Probes& probes : all_sample_probes())
    made.push_back({"probe_" + std::to_string(made.size()) + ".nook",
                    write_probes(probes, probe::Packing(made.size() % 3))});
  return made;
}

}  // namespace nook::test
