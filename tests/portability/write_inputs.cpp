// write_inputs CHARACTER.nook MATERIAL.nook: the files that cpu_results evaluates, made from numbers without
// a bake.
#include <cstdio>
#include <vector>

#include "sdk/src/character/model_file.h"
#include "sdk/src/material/material_file.h"
#include "tests/character/model_sample.h"
#include "tests/material/open_weave.h"

namespace {

bool write(const char* path, const std::vector<std::byte>& bytes) {
  std::FILE* const file = std::fopen(path, "wb");
  const bool written = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (file && std::fclose(file) == 0 && written) return true;
  std::fprintf(stderr, "write_inputs: %s cannot be written\n", path);
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: write_inputs CHARACTER.nook MATERIAL.nook\n", stderr);
    return 2;
  }
  // So few spheres that most vertices are neither open nor black.
  nook::test::SampleSize size;
  size.bones = 24;
  size.spheres = 37;
  size.key_points = 301;
  size.vertices = 2000;
  size.repeats = 300;
  size.influences = 8;
  const bool done = write(argv[1], nook::write_character_model(nook::test::sample_model(7, size))) &&
                    write(argv[2], nook::material::write_material(nook::material::test::open_weave()));
  return done ? 0 : 1;
}
