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

}  // namespace nook::cli
