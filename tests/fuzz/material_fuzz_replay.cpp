// Drives the fuzz target without libFuzzer: a sample material, changed at a few random bytes, as often as the
// first argument says. With --corpus FOLDER it writes the corpus anew, for a new format version.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "sdk/src/material/material_file.h"
#include "tests/fuzz/random_changes.h"
#include "tests/material/material_sample.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace nook::material;

int write_corpus(const std::string& folder) {
  int number = 0;
  for (const test::SampleSize& size : test::sample_forms) {
    const std::vector<std::byte> file = write_material(test::sample_material(1, size));
    std::ofstream out(folder + "/material_" + std::to_string(number++) + ".nook", std::ios::binary);
    out.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
    if (!out.flush()) return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--corpus") return write_corpus(argv[2]);
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  test::Numbers numbers(1);
  for (int run = 0; run < runs; ++run) {
    std::vector<std::byte> file = write_material(
        test::sample_material(1, test::sample_forms[std::size_t(run) % std::size(test::sample_forms)]));
    nook::test::change_bytes(file, [&](std::uint32_t count) { return numbers.below(count); });
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  }
  return 0;
}
