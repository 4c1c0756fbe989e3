#include "cli/probe/scene.h"

#include <algorithm>

#include "cli/input_file.h"
#include "import/static_scene.h"
#include "probe/environment_file.h"
#include "raytrace/ambient_occlusion.h"
#include "raytrace/texture_file.h"

namespace nook::cli {
namespace {

bake::LitTriangles read_triangles(const std::filesystem::path& path, bool textures) {
  return naming_file(path, [&] {
    bake::StaticScene scene =
        bake::import_static_scene(path, textures ? bake::SceneTextures::read : bake::SceneTextures::skip);
    std::vector<bake::Texture> decoded;
    for (const bake::EncodedImage& image : scene.image) decoded.push_back(bake::decode_texture(image));
    return bake::lit_triangles(std::move(scene), std::move(decoded));
  });
}

}  // namespace

bake::Environment read_map(const std::filesystem::path& path) {
  return naming_file(path, [&] { return bake::probe::read_environment(path); });
}

ProbeScene read_probe_scene(const std::filesystem::path& path, const std::filesystem::path& light,
                            bool textures) {
  bake::LitTriangles triangles = read_triangles(path, textures);
  ProbeScene scene;
  scene.soup = triangles.soup;
  const std::vector<Vec3>& points = scene.soup.position;
  scene.low_ws = scene.high_ws = points.front();
  scene.origin_offset = bake::ray_origin_offset(points);
  for (const Vec3 p : points) {
    scene.low_ws = {std::min(scene.low_ws.x, p.x), std::min(scene.low_ws.y, p.y),
                    std::min(scene.low_ws.z, p.z)};
    scene.high_ws = {std::max(scene.high_ws.x, p.x), std::max(scene.high_ws.y, p.y),
                     std::max(scene.high_ws.z, p.z)};
  }
  scene.lit = std::make_unique<bake::LitScene>(std::move(triangles), read_map(light));
  return scene;
}

bake::DirectLight direct_of(const std::string& name) {
  return bake::DirectLight(std::find(direct_names.begin(), direct_names.end(), name) - direct_names.begin());
}

nlohmann::ordered_json describe_suns(const bake::Environment& map) {
  constexpr std::size_t max_suns = 4;
  auto suns = nlohmann::ordered_json::array();
  for (const bake::Sun& sun : bake::find_suns(map, max_suns))
    suns.push_back({{"direction", {sun.direction.x, sun.direction.y, sun.direction.z}},
                    {"irradiance", {sun.irradiance.x, sun.irradiance.y, sun.irradiance.z}},
                    {"solid_angle", sun.solid_angle}});
  return suns;
}

}  // namespace nook::cli
