#include <algorithm>
#include <limits>
#include <numeric>

#include "bakers/nnao/host_normals.h"
#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// A connected component of a triangle soup: the indices of triangles that share corners, and their bounding
// box.
struct Piece {
  Vec3 low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
  std::vector<std::uint32_t> triangles;

  Vec3 middle() const { return 0.5f * (low + high); }
};

std::vector<Piece> pieces_of(const TriangleSoup& soup) {
  const Places places = weld(soup.position);
  std::vector<std::uint32_t> parent(places.count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& t : soup.triangle) {
    const std::uint32_t a = root(places.of[t[0]]);
    parent[root(places.of[t[1]])] = a;
    parent[root(places.of[t[2]])] = a;
  }
  std::vector<std::uint32_t> index(places.count, ~0u);
  std::vector<Piece> pieces;
  for (std::uint32_t i = 0; i < soup.triangle.size(); ++i) {
    std::uint32_t& piece = index[root(places.of[soup.triangle[i][0]])];
    if (piece == ~0u) {
      piece = std::uint32_t(pieces.size());
      pieces.emplace_back();
    }
    Piece& p = pieces[piece];
    p.triangles.push_back(i);
    for (const std::uint32_t corner : soup.triangle[i]) {
      const Vec3 v = soup.position[corner];
      p.low = {std::min(p.low.x, v.x), std::min(p.low.y, v.y), std::min(p.low.z, v.z)};
      p.high = {std::max(p.high.x, v.x), std::max(p.high.y, v.y), std::max(p.high.z, v.z)};
    }
  }
  return pieces;
}

// Returns the height of the highest surface at (x, z) that is not above `limit`, or -infinity if there is
// none.
float surface_below(const TriangleSoup& soup, float x, float z, float limit) {
  float best = -std::numeric_limits<float>::infinity();
  for (const auto& t : soup.triangle) {
    const Vec3 a = soup.position[t[0]], b = soup.position[t[1]] - a, c = soup.position[t[2]] - a;
    const float det = b.x * c.z - b.z * c.x;
    if (std::abs(det) < 1e-12f) continue;
    const float u = ((x - a.x) * c.z - (z - a.z) * c.x) / det, v = (b.x * (z - a.z) - b.z * (x - a.x)) / det;
    if (u < 0 || v < 0 || u + v > 1) continue;
    const float y = a.y + u * b.y + v * c.y;
    if (y <= limit) best = std::max(best, y);
  }
  return best;
}

float across(const Piece& piece) {
  return std::max({piece.high.x - piece.low.x, piece.high.y - piece.low.y, piece.high.z - piece.low.z});
}

}  // namespace

void add_guests(TrainingScene& host, const TrainingScene& guest, Random& random) {
  std::vector<Piece> pieces = pieces_of(guest.soup);
  // Large pieces, such as floors and walls, are not copied.
  const float largest = 2.2f * guest.size;
  std::erase_if(pieces, [&](const Piece& p) { return across(p) > largest; });
  if (pieces.empty()) return;
  const Vec3 middle = pieces[random.below(std::uint32_t(pieces.size()))].middle();
  const float reach = guest.size * random.log_between(0.35f, 1.2f);
  std::erase_if(pieces, [&](const Piece& p) {
    const Vec3 away = p.middle() - middle;
    return away.x * away.x + away.z * away.z > reach * reach;
  });
  constexpr std::size_t most_triangles = 60000;
  float foot = std::numeric_limits<float>::infinity();
  for (const Piece& p : pieces) foot = std::min(foot, p.low.y);
  const auto somewhere = [&](float low, float high) { return random.between(low, high); };
  const Vec3 target{somewhere(host.subject.low.x, host.subject.high.x),
                    somewhere(host.subject.low.y, host.subject.high.y),
                    somewhere(host.subject.low.z, host.subject.high.z)};
  const float ground = surface_below(host.soup, target.x, target.z, target.y + 0.05f * host.size);
  if (!std::isfinite(ground)) return;
  const float scale = host.size * random.log_between(0.25f, 1.1f) / reach;
  const Mat3x4 turned = standing_frame({target.x, ground, target.z}, random.between(0, 6.2831853f));
  std::size_t added = 0;
  for (const Piece& p : pieces) {
    if (added + p.triangles.size() > most_triangles) break;
    added += p.triangles.size();
    for (const std::uint32_t triangle : p.triangles) {
      std::array<Vec3, 3> corner;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 v = guest.soup.position[guest.soup.triangle[triangle][i]];
        corner[i] = transform_point(turned, scale * Vec3{v.x - middle.x, v.y - foot, v.z - middle.z});
      }
      add_triangle(host.soup, corner[0], corner[1], corner[2]);
    }
  }
}

void scale_scene(TrainingScene& scene, float factor) {
  for (Vec3& p : scene.soup.position) p = factor * p;
  for (Box* box : {&scene.cameras, &scene.subject}) {
    box->low = factor * box->low;
    box->high = factor * box->high;
  }
  scene.size *= factor;
}

}  // namespace nook::bake::nnao
