#include "bakers/images/scene_file.h"

#include <algorithm>

#include "bakers/images/texture_file.h"
#include "bakers/import/static_scene.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::bake {

LitTriangles read_lit_triangles(const std::filesystem::path& path, bool textures, LinkedFiles linked) {
  StaticScene scene = import_static_scene(path, textures ? SceneTextures::read : SceneTextures::skip, linked);
  std::vector<Texture> decoded;
  for (const EncodedImage& image : scene.image) decoded.push_back(decode_texture(image));
  return lit_triangles(std::move(scene), std::move(decoded));
}

ProbeScene make_probe_scene(LitTriangles triangles, Environment light) {
  ProbeScene scene;
  scene.soup = triangles.soup;
  const std::vector<Vec3>& points = scene.soup.position;
  scene.low_ws = scene.high_ws = points.front();
  scene.origin_offset = ray_origin_offset(points);
  for (const Vec3 p : points) {
    scene.low_ws = {std::min(scene.low_ws.x, p.x), std::min(scene.low_ws.y, p.y),
                    std::min(scene.low_ws.z, p.z)};
    scene.high_ws = {std::max(scene.high_ws.x, p.x), std::max(scene.high_ws.y, p.y),
                     std::max(scene.high_ws.z, p.z)};
  }
  scene.lit = std::make_unique<LitScene>(std::move(triangles), std::move(light));
  return scene;
}

}  // namespace nook::bake
