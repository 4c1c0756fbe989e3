// Drives the fuzz target without libFuzzer: a network of each form, changed at a few random bytes, as often
// as the first argument says. With --corpus FOLDER it writes the corpus anew, for a new format version.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "sdk/src/nnao/network_file.h"
#include "tests/fuzz/random_changes.h"
#include "tests/nnao/network_sample.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace nook;

const nnao::NetworkForm forms[] = {nnao::NetworkForm::horizon, nnao::NetworkForm::paper};

int write_corpus(const std::string& folder) {
  for (const nnao::NetworkForm form : forms) {
    const std::vector<std::byte> file = nnao::write_network(test::sample_network(form));
    std::ofstream out(folder + "/network_" + std::to_string(int(form)) + ".nook", std::ios::binary);
    out.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
    if (!out.flush()) return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--corpus") return write_corpus(argv[2]);
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  const std::vector<std::byte> files[] = {nnao::write_network(test::sample_network(forms[0])),
                                          nnao::write_network(test::sample_network(forms[1]))};
  std::mt19937 random(1);
  for (int run = 0; run < runs; ++run) {
    std::vector<std::byte> file = files[run % 2];
    test::change_bytes(file, [&](std::uint32_t count) { return std::uint32_t(random() % count); });
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  }
  return 0;
}
