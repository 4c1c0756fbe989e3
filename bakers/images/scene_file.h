// A scene from its file, with textures, and the light round it, as probes are baked and measured in.
#pragma once

#include <filesystem>
#include <memory>

#include "bakers/import/linked_files.h"
#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

struct ProbeScene {
  TriangleSoup soup;
  Vec3 low_ws, high_ws;     // what all triangles fill, metres
  float origin_offset = 0;  // metres along the normal, of rays that leave a surface
  std::unique_ptr<LitScene> lit;
};

// Throws Failure (BAD_FILE) that names the texture, where it is one's fault. Without textures their colour
// factors stand for them.
LitTriangles read_lit_triangles(const std::filesystem::path& path, bool textures, LinkedFiles linked);

ProbeScene make_probe_scene(LitTriangles triangles, Environment light);

}  // namespace nook::bake
