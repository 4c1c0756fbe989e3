// A scene that light can be traced through: diffuse triangles under an environment.
#pragma once

#include <cstdint>
#include <vector>

#include "import/static_scene.h"
#include "raytrace/environment.h"
#include "raytrace/ray_scene.h"

namespace nook::bake {

struct LitTriangles {
  TriangleSoup soup;  // world space, metres; may be empty
  std::vector<Surface> surface;
  std::vector<std::uint32_t> triangle_surface;  // an index of surface for each triangle
};

// Any thread may trace; it must not be moved, since its sampler looks at its environment.
class LitScene {
 public:
  LitScene(LitTriangles triangles, Environment environment);
  LitScene(const LitScene&) = delete;
  LitScene& operator=(const LitScene&) = delete;

  const RayScene& rays() const { return rays_; }
  const Environment& environment() const { return environment_; }
  const LightSampler& light() const { return light_; }
  const Surface& surface(std::uint32_t triangle) const { return surface_[triangle_surface_[triangle]]; }

 private:
  RayScene rays_;
  std::vector<Surface> surface_;
  std::vector<std::uint32_t> triangle_surface_;
  Environment environment_;
  LightSampler light_;
};

LitTriangles lit_triangles(StaticScene scene);

}  // namespace nook::bake
