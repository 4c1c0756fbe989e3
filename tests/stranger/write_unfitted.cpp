// write_unfitted CHARACTER.gltf MODEL.nook: a model of a character without a bake, for the checks of poses.
#include <cstdio>
#include <exception>
#include <fstream>

#include "sdk/src/character/model_file.h"
#include "tests/bakers/character/unfitted_model.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: write_unfitted CHARACTER MODEL\n", stderr);
    return 2;
  }
  try {
    const auto bytes =
        nook::write_character_model(nook::test::unfitted_model(nook::bake::import_gltf(argv[1])));
    std::ofstream file(argv[2], std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return file.flush() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_unfitted: %s: %s\n", argv[1], error.what());
    return 1;
  }
}
