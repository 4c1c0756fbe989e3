#include "bakers/import/weld.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <unordered_map>

#include "bakers/import/opposite_faces.h"
#include "bakers/import/validate.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/hash.h"

namespace nook::bake {
namespace {

struct WeldKey {
  Vec3 position;
  SkinWeights weights;
  bool operator==(const WeldKey&) const = default;
};

struct WeldHash {
  std::size_t operator()(const WeldKey& key) const {
    static_assert(sizeof(WeldKey) == sizeof(Vec3) + sizeof(SkinWeights), "padding would be hashed");
    return hash64(std::as_bytes(std::span(&key, 1)));
  }
};

// Equal floats must have equal bits, because the bits are hashed: adding +0 turns -0 into +0.
Vec3 without_negative_zero(Vec3 p) {
  return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
}

// Equal numbers for equal positions with equal weights, counted from 0 in the order of their first vertex.
struct Places {
  std::vector<std::uint32_t> of_vertex;
  std::size_t count = 0;
};
Places find_places(const FileMesh& file) {
  Places places;
  places.of_vertex.reserve(file.position.size());
  std::unordered_map<WeldKey, std::uint32_t, WeldHash> known;
  known.reserve(file.position.size());
  for (std::size_t v = 0; v < file.position.size(); ++v) {
    const WeldKey key{without_negative_zero(file.position[v]), file.weights[v]};
    const auto [found, is_new] = known.emplace(key, std::uint32_t(places.count));
    if (is_new) ++places.count;
    places.of_vertex.push_back(found->second);
  }
  return places;
}

// Corners on one line within the rounding of float positions: height below 1e-7 of the longest edge.
bool is_degenerate(const std::vector<Vec3>& position, const std::array<std::uint32_t, 3>& t) {
  const auto edge = [&](int a, int b) {
    const Vec3 p = position[t[a]];
    const Vec3 q = position[t[b]];
    return std::array<double, 3>{double(q.x) - p.x, double(q.y) - p.y, double(q.z) - p.z};
  };
  const auto square = [](const std::array<double, 3>& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
  const auto a = edge(0, 1);
  const auto b = edge(0, 2);
  const double longest = std::max({square(a), square(b), square(edge(1, 2))});
  const double normal =
      square({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
  return std::sqrt(normal) <= 1e-7 * longest;
}

// The file's vertices as welded ones, numbered in the order in which the file first has them.
void weld_vertices(const FileMesh& file, SkinnedMesh& mesh) {
  const Places places = find_places(file);
  const std::vector<std::uint32_t> side =
      sides_of_vertices({file.position, places.of_vertex, places.count, file.triangle});
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> first(places.count, none);  // of the welded vertices of a place, one a side
  std::vector<std::uint32_t> next, side_of_welded;
  mesh.file_to_welded.reserve(file.position.size());
  for (std::size_t v = 0; v < file.position.size(); ++v) {
    std::uint32_t* at = &first[places.of_vertex[v]];
    while (*at != none && side_of_welded[*at] != side[v]) at = &next[*at];
    if (*at == none) {
      *at = static_cast<std::uint32_t>(mesh.position.size());
      mesh.position.push_back(without_negative_zero(file.position[v]));
      mesh.weights.push_back(file.weights[v]);
      side_of_welded.push_back(side[v]);
    }
    mesh.file_to_welded.push_back(*at);
    next.resize(mesh.position.size(), none);
  }
}

}  // namespace

SkinWeights make_weights(std::span<const std::pair<std::uint16_t, float>> influences) {
  std::vector<std::pair<std::uint16_t, float>> kept(influences.begin(), influences.end());
  std::erase_if(kept, [](const auto& i) { return !(i.second > 0); });
  std::sort(kept.begin(), kept.end());
  std::size_t bones = 0;
  for (const auto& influence : kept) {
    if (bones > 0 && kept[bones - 1].first == influence.first)
      kept[bones - 1].second += influence.second;
    else
      kept[bones++] = influence;
  }
  kept.resize(bones);
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second > b.second : a.first < b.first;
  });
  if (kept.size() > SkinWeights::max_bones) kept.resize(SkinWeights::max_bones);

  double sum = 0;
  for (const auto& influence : kept) sum += influence.second;
  SkinWeights out;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    out.bone[i] = kept[i].first;
    out.weight[i] = static_cast<float>(kept[i].second / sum);
  }
  // A weight that rounds to nothing beside the others would leave a bone index behind an unused entry.
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (!(out.weight[i] > 0)) out.bone[i] = 0;
  return out;
}

FileMesh to_file_mesh(const MeshArrays& arrays, nook_result code) {
  const std::size_t vertices = arrays.position.size();
  if (arrays.influences == 0 || arrays.joint.size() != vertices * arrays.influences ||
      arrays.weight.size() != arrays.joint.size())
    throw Failure(code, "%zu joints and %zu weights for %zu vertices with %zu influences each",
                  arrays.joint.size(), arrays.weight.size(), vertices, arrays.influences);
  if (arrays.index.size() % 3 != 0)
    throw Failure(code, "%zu indices (need three a triangle)", arrays.index.size());
  FileMesh mesh;
  mesh.bones = arrays.bones;
  mesh.position.assign(arrays.position.begin(), arrays.position.end());
  mesh.primitives = arrays.primitives;
  mesh.triangle.reserve(arrays.index.size() / 3);
  for (std::size_t i = 0; i < arrays.index.size(); i += 3)
    mesh.triangle.push_back({arrays.index[i], arrays.index[i + 1], arrays.index[i + 2]});

  std::vector<std::pair<std::uint16_t, float>> influences(arrays.influences);
  mesh.weights.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    for (std::size_t k = 0; k < arrays.influences; ++k) {
      const std::size_t at = v * arrays.influences + k;
      if (!std::isfinite(arrays.weight[at]))
        throw Failure(code, "vertex %zu has a weight that is not finite", v);
      influences[k] = {arrays.joint[at], arrays.weight[at]};
    }
    mesh.weights.push_back(make_weights(influences));
  }
  return mesh;
}

SkinnedMesh weld(FileMesh file, std::vector<std::string>& warnings, nook_result code) {
  if (file.primitives.empty())
    file.primitives.push_back({"", 0, static_cast<std::uint32_t>(file.position.size())});
  validate(file, code);

  SkinnedMesh mesh;
  const std::size_t all = file.triangle.size();
  std::erase_if(file.triangle, [&](const auto& t) { return is_degenerate(file.position, t); });
  const std::size_t dropped = all - file.triangle.size();
  if (file.triangle.empty())
    throw Failure(code, "no triangles: all %zu have no area; export the mesh again", dropped);
  if (dropped > 0)
    warnings.push_back(std::to_string(dropped) + " of " + std::to_string(all) +
                       " triangles have no area and were left out");

  weld_vertices(file, mesh);
  mesh.triangle.reserve(file.triangle.size());
  for (const auto& t : file.triangle)
    mesh.triangle.push_back(
        {mesh.file_to_welded[t[0]], mesh.file_to_welded[t[1]], mesh.file_to_welded[t[2]]});
  mesh.bones = std::move(file.bones);
  mesh.primitives = std::move(file.primitives);
  return mesh;
}

}  // namespace nook::bake
