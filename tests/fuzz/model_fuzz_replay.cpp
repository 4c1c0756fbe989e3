// Drives the fuzz target without libFuzzer: a sample model, changed at a few random bytes, as often as the
// first argument says. With --corpus FOLDER it writes the corpus anew, for a new format version.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "sdk/src/character/model_file.h"
#include "tests/character/model_sample.h"
#include "tests/fuzz/random_changes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace nook;

int write_corpus(const std::string& folder) {
  const CharacterModel models[] = {test::sample_model(1), test::sample_model(2, {2, 2, 3, 5, 2, 3}),
                                   test::single_model({0, 1, 0}, 0.5f)};
  for (int i = 0; i < 3; ++i) {
    const std::vector<std::byte> file = write_character_model(models[i]);
    std::ofstream out(folder + "/model_" + std::to_string(i) + ".nook", std::ios::binary);
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
    std::vector<std::byte> file =
        write_character_model(test::sample_model(1 + static_cast<std::uint32_t>(run % 5)));
    test::change_bytes(file, [&](std::uint32_t count) { return numbers.below(count); });
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  }
  return 0;
}
