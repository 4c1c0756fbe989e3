// Drives a fuzz target without libFuzzer: every file of its corpus, then sound inputs changed at a few random
// bytes.
//   replay RUNS CORPUS          as a test
//   replay --seeds FOLDER       writes the sound inputs, for a corpus of a new format version
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string_view>

#include "sdk/src/core/container.h"
#include "tests/fuzz/random_changes.h"
#include "tests/fuzz/seeds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace nook;

void run(const std::vector<std::byte>& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

int write_seeds(const std::filesystem::path& folder) {
  for (const test::Seed& seed : test::seeds()) {
    std::ofstream out(folder / seed.name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(seed.bytes.data()), std::streamsize(seed.bytes.size()));
    if (!out.flush()) return 1;
  }
  return 0;
}

int run_corpus(const std::filesystem::path& folder) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const auto input = std::as_bytes(std::span(bytes));
    run({input.begin(), input.end()});
    ++count;
  }
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  if (std::string_view(argv[1]) == "--seeds") return write_seeds(argv[2]);
  const int runs = std::atoi(argv[1]), files = run_corpus(argv[2]);
  const std::vector<test::Seed> seeds = test::seeds();
  std::mt19937 random(1);
  const auto below = [&](std::uint32_t count) { return std::uint32_t(random()) % count; };
  for (int i = 0; i < runs; ++i) {
    std::vector<std::byte> input = seeds[std::size_t(i) % seeds.size()].bytes;
    const bool has_script = container_kind(input) != 0;
    test::change_bytes(input, has_script, below);
    for (std::uint32_t b = has_script ? below(64) : 0; b > 0; --b) input.push_back(std::byte(below(256)));
    run(input);
  }
  std::printf("%d files of the corpus and %d changed inputs\n", files, runs);
  return files > 0 ? 0 : 1;
}
