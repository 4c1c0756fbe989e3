#include "bakers/tool/probe_scene.h"

#include "bakers/tool/command_files.h"

namespace nook::tool {

bake::Environment read_map(const std::filesystem::path& path) {
  return naming_file(path, [&] { return bake::probe::read_environment(path); });
}

bake::ProbeScene read_probe_scene(const std::filesystem::path& path, const std::filesystem::path& light,
                                  bool textures, bake::LinkedFiles linked) {
  bake::LitTriangles triangles =
      naming_file(path, [&] { return bake::read_lit_triangles(path, textures, linked); });
  return bake::make_probe_scene(std::move(triangles), read_map(light));
}

}  // namespace nook::tool
