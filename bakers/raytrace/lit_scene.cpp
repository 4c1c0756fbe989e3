#include "raytrace/lit_scene.h"

namespace nook::bake {

LitScene::LitScene(LitTriangles triangles, Environment environment)
    : rays_(triangles.soup),
      surface_(std::move(triangles.surface)),
      triangle_surface_(std::move(triangles.triangle_surface)),
      environment_(std::move(environment)),
      light_(environment_) {}

LitTriangles lit_triangles(StaticScene scene) {
  return {{std::move(scene.position), std::move(scene.triangle)},
          std::move(scene.surface),
          std::move(scene.triangle_surface)};
}

}  // namespace nook::bake
