// Drives the fuzz target without libFuzzer: a sample material, changed at a few random bytes, as often as the
// first argument says. With --corpus FOLDER it writes the corpus anew, for a new format version.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "material/material_file.h"
#include "material_sample.h"

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
    for (std::uint32_t change = numbers.below(6) + 1; change > 0; --change) {
      // Half of the changes meet the section table and the heads.
      const auto reach = static_cast<std::uint32_t>(numbers.below(2) ? file.size() : file.size() / 8 + 1);
      const std::uint32_t at = numbers.below(reach);
      if (numbers.below(10) == 0)
        file.resize(at);  // cut
      else
        file[at] = std::byte(numbers.below(3) ? numbers.below(256) : numbers.below(2) * 255);
      if (file.empty()) break;
      // The size in the head follows, or nearly every change would end there.
      if (file.size() >= 24)
        for (std::size_t i = 0; i < 8; ++i) file[16 + i] = std::byte(file.size() >> (8 * i) & 255);
    }
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  }
  return 0;
}
