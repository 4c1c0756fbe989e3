// Drives the fuzz target without libFuzzer: sample probes of every kind, changed at a few random bytes, as
// often as the first argument says. With --corpus FOLDER it writes the corpus anew, for a new format version.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "sdk/src/probe/probe_file.h"
#include "tests/fuzz/random_changes.h"
#include "tests/probe/probe_sample.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace nook;

std::vector<std::vector<std::byte>> sound_files() {
  std::vector<std::vector<std::byte>> files;
  for (const probe::Probes& probes : test::all_sample_probes())
    files.push_back(write_probes(probes, probe::Packing(files.size() % 3)));
  return files;
}

int write_corpus(const std::string& folder) {
  int i = 0;
  for (const std::vector<std::byte>& file : sound_files()) {
    std::ofstream out(folder + "/probe_" + std::to_string(i++) + ".nook", std::ios::binary);
    out.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
    if (!out.flush()) return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--corpus") return write_corpus(argv[2]);
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  const std::vector<std::vector<std::byte>> files = sound_files();
  std::mt19937 random(1);
  for (int run = 0; run < runs; ++run) {
    std::vector<std::byte> file = files[static_cast<std::size_t>(run) % files.size()];
    test::change_bytes(file, [&](std::uint32_t count) { return std::uint32_t(random()) % count; });
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  }
  return 0;
}
