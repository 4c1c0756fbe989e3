// A scene and the light round it, as nook bake probe and nook evaluate probe trace them.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/vec.h"
#include "raytrace/lit_scene.h"
#include "raytrace/path_tracer.h"

namespace nook::cli {

struct ProbeScene {
  bake::TriangleSoup soup;
  Vec3 low_ws, high_ws;     // what all triangles fill, metres
  float origin_offset = 0;  // metres along the normal, of rays that leave a surface
  std::unique_ptr<bake::LitScene> lit;
};

// Throws ToolError (bad input) that names the file and, where it is one's fault, the texture. Without
// textures their colour factors stand for them.
ProbeScene read_probe_scene(const std::filesystem::path& scene, const std::filesystem::path& light,
                            bool textures);

// Of a latitude-longitude map, the same.
bake::Environment read_map(const std::filesystem::path& path);

// In the order of bake::DirectLight.
inline const std::vector<std::string> direct_names{"none", "sky", "all"};
bake::DirectLight direct_of(const std::string& name);

// Direction, irradiance and solid angle of the map's suns, the brightest four.
nlohmann::ordered_json describe_suns(const bake::Environment& map);

}  // namespace nook::cli
