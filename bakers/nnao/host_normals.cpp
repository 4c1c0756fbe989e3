#include "bakers/nnao/host_normals.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "bakers/nnao/level_set.h"

namespace nook::bake::nnao {

Places weld(std::span<const Vec3> positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::tuple(positions[i].x, positions[i].y, positions[i].z);
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  Places places;
  places.of.resize(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    places.count += i == 0 || key(order[i - 1]) != key(order[i]);
    places.of[order[i]] = places.count - 1;
  }
  return places;
}

namespace {

// Triangles whose normals differ by a larger angle do not share vertex normals. Exporters do the same.
constexpr float cos_crease = 0.5f;  // 60 degrees

// Returns the normal. If its angle to the face's normal exceeds max_normal_tilt, it is turned towards the
// face's normal.
Vec3 within_tilt(Vec3 normal, Vec3 face) {
  const float cosine = dot(normal, face);
  if (cosine >= std::cos(max_normal_tilt)) return normal;
  const Vec3 aside = normalised(normal - cosine * face);
  return std::cos(max_normal_tilt) * face + std::sin(max_normal_tilt) * aside;
}

}  // namespace

HostNormals::HostNormals(const TriangleSoup& soup, float size, std::uint64_t seed)
    : soup_(soup), seed_(seed) {
  Random random(seed);
  const int kind = random.whole(0, 2);
  smooth_ = kind != 0;
  if (kind != 1) {
    map_depth_ = std::tan(random.between(0.2f, 1) * max_normal_tilt);
    map_scale_ = random.log_between(4, 80) / size;
  }
  if (!smooth_) return;
  const Places places = weld(soup.position);
  place_ = places.of;
  first_.assign(places.count + 1, 0);
  for (const auto& t : soup.triangle)
    for (const std::uint32_t corner : t) ++first_[place_[corner] + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  around_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < soup.triangle.size(); ++i) {
    const auto& t = soup.triangle[i];
    const Vec3 a = soup.position[t[0]];
    area_.push_back(cross(soup.position[t[1]] - a, soup.position[t[2]] - a));
    for (const std::uint32_t corner : t) around_[next[place_[corner]]++] = i;
  }
}

Vec3 HostNormals::corner_normal(std::uint32_t place, Vec3 face) const {
  Vec3 sum;
  for (std::uint32_t i = first_[place]; i < first_[place + 1]; ++i) {
    // The winding of the triangles in a soup is arbitrary.
    const Vec3 area = area_[around_[i]];
    const float along = dot(area, face);
    if (std::abs(along) > cos_crease * length(area)) sum += along > 0 ? area : -area;
  }
  return normalised(sum);
}

Vec3 HostNormals::smooth(const RayHit& hit) const {
  const auto& t = soup_.triangle[hit.triangle];
  const Vec3 n = (1 - hit.u - hit.v) * corner_normal(place_[t[0]], hit.normal) +
                 hit.u * corner_normal(place_[t[1]], hit.normal) +
                 hit.v * corner_normal(place_[t[2]], hit.normal);
  return length(n) > 0.1f ? normalised(n) : hit.normal;
}

Vec3 HostNormals::at(const RayHit& hit, Vec3 origin, Vec3 direction) const {
  Vec3 normal = smooth_ ? smooth(hit) : hit.normal;
  if (map_depth_ > 0) {
    const Vec3 p = map_scale_ * (origin + hit.distance * direction);
    const Vec3 slope{fractal_noise(seed_, p, 2), fractal_noise(seed_ + 16, p, 2),
                     fractal_noise(seed_ + 32, p, 2)};
    normal = normalised(normal + map_depth_ * (slope - dot(slope, normal) * normal));
  }
  normal = within_tilt(normal, hit.normal);
  // Hosts clamp or flip normals that face away from the viewer.
  const float facing = -dot(normal, normalised(direction));
  constexpr float smallest = 0.02f;
  if (facing >= smallest) return normal;
  const float face = -dot(hit.normal, normalised(direction));
  if (face <= smallest) return hit.normal;
  return normalised(normal + (smallest - facing) / (face - facing) * (hit.normal - normal));
}

}  // namespace nook::bake::nnao
