// A scene for light transport: diffuse triangles under an environment.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/import/static_scene.h"
#include "bakers/raytrace/environment.h"
#include "bakers/raytrace/ray_scene.h"
#include "bakers/raytrace/texture.h"

namespace nook::bake {

struct LitTriangles {
  TriangleSoup soup;  // world space, metres; may be empty
  std::vector<Surface> surface;
  std::vector<std::uint32_t> triangle_surface = {};  // for each triangle, an index into `surface`
  std::vector<Texture> texture = {};                 // textures that surfaces refer to by index
  std::vector<std::array<TexturePoint, 2>> uv = {};  // per vertex; empty if no surface has a texture
};

// The colours of a surface at one point.
struct SurfaceColours {
  Vec3 base_colour, emission;
};

// You can trace from any thread. You cannot move the scene, because its sampler refers to its environment.
class LitScene {
 public:
  LitScene(LitTriangles triangles, Environment environment);
  LitScene(const LitScene&) = delete;
  LitScene& operator=(const LitScene&) = delete;

  // Returns the nearest hit. Rays pass through the transparent parts of alpha masks.
  RayHit nearest(Vec3 origin, Vec3 direction) const;
  bool occluded(Vec3 origin, Vec3 direction) const;
  SurfaceColours colours(const RayHit& hit) const;

  const Environment& environment() const { return environment_; }
  const LightSampler& light() const { return light_; }
  double sun_limit() const { return sun_limit_; }  // see environment.h

 private:
  const Surface& surface(const RayHit& hit) const { return surface_[triangle_surface_[hit.triangle]]; }
  TextureColour texture_colour(const TextureUse& use, const RayHit& hit) const;
  bool is_hole(const RayHit& hit) const;

  RayScene rays_;
  std::vector<Surface> surface_;
  std::vector<std::uint32_t> triangle_surface_;
  std::vector<Texture> texture_;
  std::vector<std::array<TexturePoint, 2>> uv_;
  std::vector<std::array<std::uint32_t, 3>> triangle_;  // only if there are textures
  bool masked_ = false;
  Environment environment_;
  LightSampler light_;
  double sun_limit_;
};

// `textures` are the decoded images of scene.image.
LitTriangles lit_triangles(StaticScene scene, std::vector<Texture> textures);

}  // namespace nook::bake
