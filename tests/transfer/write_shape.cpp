// transfer_shape knot|cloth|mannequin|dense OUT.glb: a shape of the tests of radiance transfer as a file.
// dense is the knot with 36,025 vertices, for times.
#include <cstdio>
#include <string_view>

#include "tests/transfer/mannequin_shape.h"

int main(int argc, char** argv) {
  using namespace nook::transfer::test;
  const std::string_view name = argc == 3 ? argv[1] : "";
  if (name != "knot" && name != "cloth" && name != "mannequin" && name != "dense") {
    std::fputs("usage: transfer_shape knot|cloth|mannequin|dense OUT.glb\n", stderr);
    return 2;
  }
  const Shape shape = name == "knot"        ? knot_over_plane()
                      : name == "cloth"     ? draped_cloth()
                      : name == "mannequin" ? mannequin_over_plane()
                                            : knot_over_plane(900, 32, 85);
  const std::vector<std::byte> bytes = glb_of(shape);
  std::FILE* const file = std::fopen(argv[2], "wb");
  const bool written = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (!file || std::fclose(file) != 0 || !written) {
    std::fprintf(stderr, "transfer_shape: %s cannot be written\n", argv[2]);
    return 1;
  }
  return 0;
}
