// open_weave OUT.nook [none|binary|distance]: the tests' material as a file, for samples that need one.
#include <cstdio>
#include <string_view>

#include "sdk/src/material/material_file.h"
#include "tests/material/open_weave.h"

int main(int argc, char** argv) {
  using namespace nook::material;
  const std::string_view form = argc > 2 ? argv[2] : "distance";
  if (argc < 2 || argc > 3 || (form != "none" && form != "binary" && form != "distance")) {
    std::fputs("usage: open_weave OUT.nook [none|binary|distance]\n", stderr);
    return 2;
  }
  test::WeaveSize size;
  size.visibility = form == "none"     ? VisibilityForm::none
                    : form == "binary" ? VisibilityForm::binary
                                       : VisibilityForm::distance;
  const std::vector<std::byte> bytes = write_material(test::open_weave(size));
  std::FILE* const file = std::fopen(argv[1], "wb");
  const bool written = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (!file || std::fclose(file) != 0 || !written) {
    std::fprintf(stderr, "open_weave: %s cannot be written\n", argv[1]);
    return 1;
  }
  return 0;
}
