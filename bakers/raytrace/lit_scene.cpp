#include "bakers/raytrace/lit_scene.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/spherical_gaussian.h"

namespace nook::bake {

static_assert(max_emission == max_radiance, "one bound for all light of a scene");

LitScene::LitScene(LitTriangles triangles, Environment environment)
    : rays_(triangles.soup),
      surface_(std::move(triangles.surface)),
      triangle_surface_(std::move(triangles.triangle_surface)),
      texture_(std::move(triangles.texture)),
      uv_(std::move(triangles.uv)),
      masked_(
          std::any_of(surface_.begin(), surface_.end(), [](const Surface& s) { return s.alpha_cutoff > 0; })),
      environment_(std::move(environment)),
      light_(environment_),
      sun_limit_(nook::bake::sun_limit(environment_)) {
  if (!uv_.empty()) triangle_ = std::move(triangles.soup.triangle);
}

TextureColour LitScene::texture_colour(const TextureUse& use, const RayHit& hit) const {
  if (!use.is_used()) return {};
  const auto& corner = triangle_[hit.triangle];
  const TexturePoint a = uv_[corner[0]][use.uv_set], b = uv_[corner[1]][use.uv_set],
                     c = uv_[corner[2]][use.uv_set];
  const float first = 1 - hit.u - hit.v;
  return texture_[use.image].at(
      use, {first * a.u + hit.u * b.u + hit.v * c.u, first * a.v + hit.u * b.v + hit.v * c.v});
}

SurfaceColours LitScene::colours(const RayHit& hit) const {
  const Surface& s = surface(hit);
  return {by_channel(s.base_colour, texture_colour(s.base_colour_texture, hit).rgb),
          by_channel(s.emission, texture_colour(s.emission_texture, hit).rgb)};
}

bool LitScene::is_hole(const RayHit& hit) const {
  const Surface& s = surface(hit);
  return s.alpha_cutoff > 0 && s.alpha * texture_colour(s.base_colour_texture, hit).alpha < s.alpha_cutoff;
}

RayHit LitScene::nearest(Vec3 origin, Vec3 direction) const {
  RayHit hit = rays_.nearest(origin, direction);
  while (masked_ && std::isfinite(hit.distance) && is_hole(hit))
    hit = rays_.nearest(origin, direction, hit.distance);
  return hit;
}

bool LitScene::occluded(Vec3 origin, Vec3 direction) const {
  return masked_ ? std::isfinite(nearest(origin, direction).distance) : rays_.occluded(origin, direction);
}

LitTriangles lit_triangles(StaticScene scene, std::vector<Texture> textures) {
  return {{std::move(scene.position), std::move(scene.triangle)},
          std::move(scene.surface),
          std::move(scene.triangle_surface),
          std::move(textures),
          std::move(scene.uv)};
}

}  // namespace nook::bake
