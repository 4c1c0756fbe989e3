#include "sdk/src/nnao/network_file.h"
#include "tests/fuzz/seeds.h"
#include "tests/nnao/network_sample.h"

namespace nook::test {

std::vector<Seed> seeds() {
  return {{"network_0.nook", nnao::write_network(sample_network(nnao::NetworkForm::paper))},
          {"network_1.nook", nnao::write_network(sample_network(nnao::NetworkForm::horizon))}};
}

}  // namespace nook::test
