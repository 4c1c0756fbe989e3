// Writes a rigged tube as a .gltf file with its buffer and a texture that no bake reads:
// write_tube FOLDER/NAME.gltf CLIP...
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/gltf_parts.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: write_tube FOLDER/NAME.gltf CLIP...\n";
    return 2;
  }
  const std::filesystem::path gltf = argv[1];
  const std::string name = gltf.stem().string();
  write_gltf_parts(glb_tube({argv + 2, argv + argc}), gltf.string(),
                   std::filesystem::path(gltf).replace_extension(".bin").string(), name + ".bin",
                   {{"images", {{{"uri", name + ".png"}}}},
                    {"textures", {{{"source", 0}}}},
                    {"materials", {{{"name", "skin"}}}}});
  std::ofstream(std::filesystem::path(gltf).replace_extension(".png")) << "not read";
}
