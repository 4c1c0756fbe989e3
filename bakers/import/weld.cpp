#include "bakers/import/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <unordered_map>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/hash.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {
namespace {

// Finds vertices that share a position although their faces look in opposite directions, as on the two sides
// of a card. A place is a position together with skin weights.

// Vertices that share a place, and the triangles between them.
struct PlacedVertices {
  std::span<const Vec3> position;        // one per vertex
  std::span<const std::uint32_t> place;  // per vertex, the index of its place
  std::size_t place_count = 0;
  std::span<const std::array<std::uint32_t, 3>> triangle;
};

// The cosine of 135 degrees, which is halfway between opposite and a right angle.
constexpr double opposite_cosine = -0.70710678;
constexpr std::size_t max_corners = 256;

using Direction = std::array<double, 3>;

double dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Returns zero if `a` is only a rounding error, that is, a sum of terms of length `size` that cancel out.
Direction normalised(const Direction& a, double size) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 1e-6 * size)) return {};
  return {a[0] / length, a[1] / length, a[2] / length};
}

// Returns the normal of a triangle. Its length is twice the triangle's area.
Direction face_normal(std::span<const Vec3> position, const std::array<std::uint32_t, 3>& t) {
  const auto edge = [&](int end) {
    const Vec3 a = position[t[0]], b = position[t[end]];
    return Direction{double(b.x) - double(a.x), double(b.y) - double(a.y), double(b.z) - double(a.z)};
  };
  const Direction u = edge(1), v = edge(2);
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

// A corner of a triangle.
struct Corner {
  std::uint32_t vertex = 0;
  std::uint32_t next = 0, previous = 0;  // places
  Direction normal{};                    // its length is twice the triangle's area
  Direction direction{};                 // unit length
};

// The sheets of connected vertices, as a union-find structure. Each vertex points to another vertex of its
// sheet, or to itself.
class Sheets {
 public:
  explicit Sheets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

struct Sheet {
  Direction sum{};
  double size = 0;  // sum of the lengths of the terms in `sum`
  Direction direction{};
  std::uint32_t side = 0;
};

// The two sheets of a side with the largest angle between them, if they are opposite. Ties are resolved by
// the sheets' directions, and never by their order in the list.
struct Pair {
  Direction first{}, second{};
  double cosine = 0;
};
bool find_opposite(std::span<const Sheet> sheets, std::uint32_t side, Pair& worst) {
  worst.cosine = opposite_cosine;
  bool found = false;
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (std::size_t j = i + 1; j < sheets.size(); ++j) {
      if (sheets[i].side != side || sheets[j].side != side) continue;
      const auto [a, b] = std::minmax(sheets[i].direction, sheets[j].direction);
      const Pair pair{b, a, dot(a, b)};
      const bool is_worse = pair.cosine < worst.cosine ||
                            (found && pair.cosine == worst.cosine &&
                             std::pair(pair.first, pair.second) > std::pair(worst.first, worst.second));
      if (!is_worse) continue;
      worst = pair;
      found = true;
    }
  return found;
}

void divide(std::span<Sheet> sheets) {
  std::uint32_t sides = 1;
  for (std::uint32_t side = 0; side < sides; ++side)
    for (Pair pair; find_opposite(sheets, side, pair); ++sides)
      for (Sheet& sheet : sheets)
        if (sheet.side == side && dot(sheet.direction, pair.second) > dot(sheet.direction, pair.first))
          sheet.side = sides;
}

// For each edge of a corner, this has the largest cosine of the angle between the faces on both sides of the
// edge, minus a margin for rounding.
struct Neighbour {
  double over_next = -1, over_previous = -1;
};
std::vector<Neighbour> straightest_neighbours(std::span<const Corner> corners) {
  constexpr double rounding = 1e-9;
  std::vector<Neighbour> best(corners.size());
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = 0; b < corners.size(); ++b) {
      if (corners[a].next != corners[b].previous) continue;
      const double cosine = dot(corners[a].direction, corners[b].direction) - rounding;
      best[a].over_next = std::max(best[a].over_next, cosine);
      best[b].over_previous = std::max(best[b].over_previous, cosine);
    }
  return best;
}

// Returns the vertices that are corners of triangles, in ascending order. All other vertices have no face,
// and stay on side 0.
std::vector<std::uint32_t> touched_vertices(std::span<const Corner> corners) {
  std::vector<std::uint32_t> vertices;
  for (const Corner& corner : corners) vertices.push_back(corner.vertex);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

// Finds the sides of the vertices at one place.
void divide_place(std::span<const Corner> corners, std::vector<std::uint32_t>& side) {
  const std::vector<std::uint32_t> vertices = touched_vertices(corners);
  const auto local = [&](std::uint32_t vertex) {
    return std::uint32_t(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
  };
  Sheets joined(vertices.size());
  const std::vector<Neighbour> after = straightest_neighbours(corners);
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = 0; b < corners.size(); ++b) {
      if (corners[a].next != corners[b].previous) continue;
      const double cosine = dot(corners[a].direction, corners[b].direction);
      if (cosine >= opposite_cosine && cosine >= after[a].over_next && cosine >= after[b].over_previous)
        joined.join(local(corners[a].vertex), local(corners[b].vertex));
    }
  std::vector<Sheet> sheet(vertices.size());
  for (const Corner& corner : corners) {
    Sheet& s = sheet[joined.find(local(corner.vertex))];
    for (int axis = 0; axis < 3; ++axis) s.sum[axis] += corner.normal[axis];
    s.size += std::sqrt(dot(corner.normal, corner.normal));
  }
  for (Sheet& s : sheet) s.direction = normalised(s.sum, s.size);
  divide(sheet);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) side[vertices[i]] = sheet[joined.find(i)].side;
}

// Items in groups. Group g contains item[first[g]] to item[first[g + 1] - 1], in ascending order.
struct Groups {
  std::vector<std::uint32_t> first, item;
  std::span<const std::uint32_t> of(std::size_t group) const {
    return std::span(item).subspan(first[group], first[group + 1] - first[group]);
  }
};
template <typename GroupOf>
Groups group(std::size_t items, std::size_t groups, GroupOf group_of) {
  Groups out;
  out.first.assign(groups + 1, 0);
  out.item.resize(items);
  for (std::size_t i = 0; i < items; ++i) ++out.first[group_of(i) + 1];
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  std::vector<std::uint32_t> next(out.first.begin(), out.first.end() - 1);
  for (std::size_t i = 0; i < items; ++i) out.item[next[group_of(i)]++] = std::uint32_t(i);
  return out;
}

// Returns, for each vertex, the side of its place. Nearly all vertices are on side 0. If faces at one place
// look in opposite directions, some vertices are on side 1 or more.
//
// The vertices at one place whose faces share an edge form a sheet. So the tip of a cone is one sheet, even
// if the file has a separate vertex for each of its faces. At an edge with more than two faces, each face is
// connected to the face at the smallest angle, and sheets never fold back on themselves. Two sheets are
// opposite if their area-weighted normals are more than 135 degrees apart.
//
// A place with opposite sheets is split into two sides. The two sheets with the largest angle between them
// start the sides, and each other sheet joins the nearer one. This repeats until no side contains opposite
// sheets. The order of vertices and triangles affects only which side is 0. A place with more than 256
// triangle corners is not split, which limits the time for malicious files.
std::vector<std::uint32_t> sides_of_vertices(const PlacedVertices& mesh) {
  std::vector<std::uint32_t> side(mesh.place.size(), 0);
  const Groups vertices =
      group(mesh.place.size(), mesh.place_count, [&](std::size_t v) { return mesh.place[v]; });
  const Groups corners = group(3 * mesh.triangle.size(), mesh.place_count,
                               [&](std::size_t c) { return mesh.place[mesh.triangle[c / 3][c % 3]]; });
  std::vector<Corner> at_place;
  for (std::size_t p = 0; p < mesh.place_count; ++p) {
    if (vertices.of(p).size() < 2 || corners.of(p).size() > max_corners) continue;
    at_place.clear();
    for (const std::uint32_t c : corners.of(p)) {
      const auto& t = mesh.triangle[c / 3];
      const Direction normal = face_normal(mesh.position, t);
      const Direction direction = normalised(normal, 0);
      at_place.push_back(
          {t[c % 3], mesh.place[t[(c + 1) % 3]], mesh.place[t[(c + 2) % 3]], normal, direction});
    }
    divide_place(at_place, side);
  }
  return side;
}

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

// Vertices with equal positions and equal weights have the same place. Places are numbered from 0, in the
// order of their first vertices.
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

// Returns true if the corners lie on one line, up to the rounding of float positions: the triangle's height
// is less than 1e-7 of its longest edge.
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

// Welds the file's vertices. Welded vertices are numbered in the order in which they first occur.
void weld_vertices(const FileMesh& file, SkinnedMesh& mesh) {
  const Places places = find_places(file);
  const std::vector<std::uint32_t> side =
      sides_of_vertices({file.position, places.of_vertex, places.count, file.triangle});
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> first(places.count, none);  // per place, the first of its welded vertices
  std::vector<std::uint32_t> next,
      side_of_welded;  // a linked list per place, with one welded vertex per side
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
  // A weight that is tiny relative to the others may be rounded to 0. Its bone index must then be removed
  // too.
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (!(out.weight[i] > 0)) out.bone[i] = 0;
  return out;
}

FileMesh to_file_mesh(const MeshArrays& arrays, nook_result code) {
  const std::size_t vertices = arrays.position.size();
  if (arrays.influences == 0 || arrays.joint.size() != vertices * arrays.influences ||
      arrays.weight.size() != arrays.joint.size())
    throw Failure(code,
                  "got %zu joints and %zu weights for %zu vertices with %zu influences each; need one joint "
                  "and one weight for each influence",
                  arrays.joint.size(), arrays.weight.size(), vertices, arrays.influences);
  if (arrays.index.size() % 3 != 0)
    throw Failure(code, "got %zu indices (need three per triangle)", arrays.index.size());
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
