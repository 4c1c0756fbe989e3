#include "bakers/material/shading.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bakers/material/pbr_maps.h"
#include "bakers/raytrace/hemisphere.h"

namespace nook::bake::material {
namespace {

// Number of copies on each side of the middle tile. A ray with a tilt of 80 degrees crosses a structure with
// a height of half a tile within three tiles. Only inter-reflection traces flatter rays. Such a ray meets
// nothing beyond these tiles.
constexpr int copies = 3;

// How far a ray starts from the surface, in tiles. It must be far smaller than a texel, and far larger than
// the rounding error of coordinates up to `copies`.
constexpr float origin_offset = 2e-5f;

std::vector<Vec3> copy_offsets() {
  std::vector<Vec3> offsets;
  for (int y = -copies; y <= copies; ++y)
    for (int x = -copies; x <= copies; ++x) offsets.push_back({float(x), float(y), 0});
  return offsets;
}

}  // namespace

TiledScene::TiledScene(const MesoSurface& surface)
    : surface_(surface),
      tile_(RayDevice(), surface.position, surface.triangle),
      plane_(tile_, copy_offsets()) {
  const auto [low, high] = std::minmax_element(surface.position.begin(), surface.position.end(),
                                               [](Vec3 a, Vec3 b) { return a.z < b.z; });
  bottom_ = low->z;
  top_ = high->z;
}

Vec3 TiledScene::outside(Vec3 position, Vec3 normal) const {
  const Vec3 p = position + origin_offset * normal;
  return {p.x - std::floor(p.x), p.y - std::floor(p.y), p.z};
}

SurfaceHit TiledScene::nearest(Vec3 origin, Vec3 direction) const {
  const RayHit ray = plane_.nearest(origin, direction);
  SurfaceHit hit;
  hit.triangle = ray.triangle;
  if (hit.triangle == SurfaceHit::nothing) return hit;
  hit.u = ray.u;
  hit.v = ray.v;
  hit.position = origin + ray.distance * direction;
  const auto& t = surface_.triangle[hit.triangle];
  const Vec3 a = surface_.position[t[0]];
  hit.normal = normalised(cross(surface_.position[t[1]] - a, surface_.position[t[2]] - a));
  return hit;
}

void TiledScene::open_directions(const SurfaceHit& from, std::span<const Vec3> directions,
                                 std::span<unsigned char> open) const {
  const Vec3 origin = outside(from.position, from.normal);
  for (std::size_t first = 0; first < directions.size(); first += RayScene::packet_size) {
    const auto packet = directions.subspan(first, std::min(RayScene::packet_size, directions.size() - first));
    const std::uint32_t is_open = plane_.open_rays(origin, packet, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < packet.size(); ++i) open[first + i] = is_open >> i & 1;
  }
}

namespace {

// Transforms d from a frame with the z axis n (Duff et al. 2017).
Vec3 to_frame(Vec3 n, Vec3 d) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z), b = n.x * n.y * a;
  const Vec3 u{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, v{b, sign + n.y * n.y * a, -n.y};
  return d.x * u + d.y * v + d.z * n;
}

Vec3 shading_normal(const MesoSurface& surface, const SurfaceHit& hit) {
  return normalised(at_hit<Vec3>(surface.normal, surface.triangle, hit));
}

// The reflection at a point of the surface: pi times its BRDF.
class Reflection {
 public:
  Reflection(const MesoSurface& surface, const SurfaceHit& hit, Vec3 normal, Vec3 albedo)
      : normal_(normal), specular_(surface.specular), shininess_(surface.shininess) {
    point_.diffuse = albedo;
    if (surface.ggx_width.empty()) return;
    microfacet_ = true;
    point_.width = at_hit<float>(surface.ggx_width, surface.triangle, hit);
    point_.reflectance = at_hit<Vec3>(surface.reflectance, surface.triangle, hit);
  }

  Vec3 towards(Vec3 view, Vec3 light) const {
    if (microfacet_) return microfacet_reflection(point_, normal_, view, light);
    if (!(specular_ > 0)) return point_.diffuse;
    // Blinn-Phong, with the factor (n + 8) / 8, so that the lobe's reflectance hardly depends on the
    // exponent.
    const float along = std::max(dot(normal_, normalised(light + view)), 0.0f);
    const float gloss = specular_ * (shininess_ + 8) / 8 * std::pow(along, shininess_);
    return point_.diffuse + Vec3{gloss, gloss, gloss};
  }

 private:
  Vec3 normal_;
  float specular_, shininess_;
  bool microfacet_ = false;
  Reflector point_;
};

// Traces the rays of each vertex. Returns their hits, from which the vertex gathers light.
std::vector<SurfaceHit> gather_hits(const MesoSurface& surface, const TiledScene& scene, std::uint32_t rays,
                                    std::uint64_t seed) {
  const HemispherePatterns patterns(rays, seed);
  std::vector<SurfaceHit> hits(surface.position.size() * rays);
  tbb::parallel_for(std::size_t{0}, surface.position.size(), [&](std::size_t v) {
    const FlushDenormals flush;
    const Vec3 n = surface.normal[v], origin = scene.outside(surface.position[v], n);
    const Vec3* local = patterns.pattern(std::uint32_t(mix_bits(seed + v)));
    for (std::uint32_t r = 0; r < rays; ++r)
      hits[v * rays + r] = scene.nearest(origin, to_frame(n, local[r]));
  });
  return hits;
}

}  // namespace

void direct_cosines(const TiledScene& scene, const SurfaceHit& hit, Vec3 normal, std::span<const Vec3> lights,
                    std::span<float> cosine, LightScratch& scratch) {
  std::vector<Vec3>& towards = scratch.towards;
  std::vector<std::uint32_t>& index = scratch.index;
  std::vector<unsigned char>& open = scratch.open;
  towards.clear();
  index.clear();
  for (std::uint32_t l = 0; l < lights.size(); ++l) {
    cosine[l] = 0;
    if (dot(normal, lights[l]) <= 0 || dot(hit.normal, lights[l]) <= 0) continue;
    towards.push_back(lights[l]);
    index.push_back(l);
  }
  open.resize(towards.size());
  scene.open_directions(hit, towards, open);
  for (std::size_t i = 0; i < index.size(); ++i)
    if (open[i]) cosine[index[i]] = dot(normal, towards[i]);
}

InterReflection::InterReflection(const MesoSurface& surface, const TiledScene& scene,
                                 std::span<const Vec3> lights, std::uint32_t rays, std::uint32_t bounces,
                                 std::uint64_t seed)
    : surface_(surface), lights_(lights.size()) {
  if (bounces == 0) return;
  const std::size_t vertices = surface.position.size(), width = 3 * lights_;
  std::vector<float> direct(vertices * lights_);
  tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
    const FlushDenormals flush;
    SurfaceHit here;
    here.position = surface.position[v];
    here.normal = surface.normal[v];
    LightScratch scratch;
    direct_cosines(scene, here, here.normal, lights, {&direct[v * lights_], lights_}, scratch);
  });
  const std::vector<SurfaceHit> hits = gather_hits(surface, scene, rays, seed);
  irradiance_.assign(vertices * width, 0);
  std::vector<float> radiosity(vertices * width);
  for (std::uint32_t bounce = 0; bounce < bounces; ++bounce) {
    tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
      const float albedo[3] = {surface.albedo[v].x, surface.albedo[v].y, surface.albedo[v].z};
      for (std::size_t i = 0; i < width; ++i)
        radiosity[v * width + i] = albedo[i % 3] * (direct[v * lights_ + i / 3] + irradiance_[v * width + i]);
    });
    tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
      float* sum = &irradiance_[v * width];
      std::fill_n(sum, width, 0.0f);
      for (std::uint32_t r = 0; r < rays; ++r) {
        const SurfaceHit& hit = hits[v * rays + r];
        if (hit.triangle == SurfaceHit::nothing) continue;
        const auto& t = surface.triangle[hit.triangle];
        const float weight[3] = {(1 - hit.u - hit.v) / float(rays), hit.u / float(rays), hit.v / float(rays)};
        for (int k = 0; k < 3; ++k) {
          const float* from = &radiosity[t[std::size_t(k)] * width];
          for (std::size_t i = 0; i < width; ++i) sum[i] += weight[k] * from[i];
        }
      }
    });
  }
}

void InterReflection::add(const SurfaceHit& hit, Vec3 albedo, std::span<float> value) const {
  if (irradiance_.empty()) return;
  const auto& t = surface_.triangle[hit.triangle];
  const float weight[3] = {1 - hit.u - hit.v, hit.u, hit.v};
  const float colour[3] = {albedo.x, albedo.y, albedo.z};
  for (int k = 0; k < 3; ++k) {
    const float* from = &irradiance_[t[std::size_t(k)] * 3 * lights_];
    for (std::size_t i = 0; i < 3 * lights_; ++i) value[i] += colour[i % 3] * weight[k] * from[i];
  }
}

void shade(const MesoSurface& surface, const TiledScene& scene, const InterReflection& indirect,
           const SurfaceHit& hit, Vec3 view, std::span<const Vec3> lights, std::span<float> value,
           LightScratch& scratch) {
  std::vector<float>& cosine = scratch.cosine;
  cosine.resize(lights.size());
  const Vec3 normal = shading_normal(surface, hit);
  const Vec3 albedo = at_hit<Vec3>(surface.albedo, surface.triangle, hit);
  const Reflection reflection(surface, hit, normal, albedo);
  direct_cosines(scene, hit, normal, lights, cosine, scratch);
  for (std::size_t l = 0; l < lights.size(); ++l) {
    const Vec3 reflected = cosine[l] > 0 ? reflection.towards(view, lights[l]) * cosine[l] : Vec3{};
    value[3 * l] = reflected.x;
    value[3 * l + 1] = reflected.y;
    value[3 * l + 2] = reflected.z;
  }
  indirect.add(hit, albedo, value);
  for (float& v : value) v *= std::numbers::inv_pi_v<float>;
}

}  // namespace nook::bake::material
