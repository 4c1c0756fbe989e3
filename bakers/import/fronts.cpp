#include "bakers/import/fronts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "bakers/import/accessor.h"
#include "bakers/import/gltf_types.h"
#include "bakers/import/shown_nodes.h"
#include "bakers/import/shown_primitives.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/hash.h"

namespace nook::bake {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector& a) {
  return std::sqrt(dot(a, a));
}
Vector vector_of(Vec3 v) {
  return {double(v.x), double(v.y), double(v.z)};
}

// Returns the normal of a triangle. Its length is twice the area. corner(v) returns the position of vertex v.
template <class Corner>
Vector face_of(const Triangle& t, Corner corner) {
  return cross(minus(corner(t[1]), corner(t[0])), minus(corner(t[2]), corner(t[0])));
}

Vector corner_of(std::span<const float> three, std::uint32_t v) {
  return {double(three[3 * v]), double(three[3 * v + 1]), double(three[3 * v + 2])};
}

// Six times the volume that triangles enclose, and twice their area. An open surface is closed by triangles
// from its border to its first corner.
struct Enclosed {
  double volume = 0, area = 0;
  template <class Corner>
  void add(const Triangle& t, const Vector& origin, Corner corner) {
    const Vector face = face_of(t, corner);
    volume += dot(face, minus(corner(t[0]), origin));
    area += length(face);
  }
  // The limit is above rounding errors, and below the volume of a sheet 1,000 times as wide as thick.
  bool is_inside_out() const { return volume < -1e-4 * area * std::sqrt(area); }
  bool is_outside_out() const { return volume > 1e-4 * area * std::sqrt(area); }
};

// Returns true if the enclosed volume is negative, so that the order of the corners puts the front on the
// inside. Returns nothing if the surface encloses no volume.
std::optional<bool> encloses_backwards(const PrimitiveSurface& surface) {
  const auto corner = [&](std::uint32_t v) { return corner_of(surface.position, v); };
  Enclosed sum;
  for (const Triangle& t : surface.triangle) sum.add(t, corner(surface.triangle[0][0]), corner);
  if (sum.is_inside_out()) return true;
  if (sum.is_outside_out()) return false;
  return std::nullopt;
}

}  // namespace

std::vector<float> read_normals(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                std::size_t vertices, const std::string& what) {
  const int accessor = attribute(primitive, "NORMAL");
  if (accessor < 0) return {};
  const std::string name = what + ".NORMAL";
  if (const std::size_t count = element_count(model, accessor, name); count != vertices)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has %zu elements (need one for each of %zu vertices)",
                  name.c_str(), count, vertices);
  // document_warnings reports the wrong type.
  if (!has_allowed_type(model, model.accessors[std::size_t(accessor)], AccessorUse::normal)) return {};
  std::vector<float> normal = read_floats(model, accessor, 3, name).value;
  for (float& value : normal)
    if (!std::isfinite(value)) value = 0;
  return normal;
}

std::optional<bool> faces_against_normals(const PrimitiveSurface& surface) {
  if (surface.normal.empty()) return std::nullopt;
  double along = 0, against = 0, all = 0;
  for (const Triangle& t : surface.triangle) {
    const Vector face = face_of(t, [&](std::uint32_t v) { return corner_of(surface.position, v); });
    const double area = length(face);
    double side = 0;
    for (const std::uint32_t v : t) side += dot(face, corner_of(surface.normal, v));
    all += area;
    if (side > 0) along += area;
    if (side < 0) against += area;
  }
  if (!(std::abs(along - against) > 0.01 * all)) return std::nullopt;
  return against > along;
}

bool turns_round(const PrimitiveSurface& surface, const Affine& space_from_mesh, bool node_mirrors) {
  const bool space_mirrors = determinant(space_from_mesh) < 0;
  if (const auto against = faces_against_normals(surface)) return *against != space_mirrors;
  if (space_mirrors == node_mirrors || surface.triangle.empty()) return node_mirrors;
  const auto backwards = encloses_backwards(surface);
  return backwards ? *backwards != space_mirrors : node_mirrors;
}

namespace {

constexpr std::size_t most_inside_out = 64;

struct PlaceHash {
  std::size_t operator()(const std::array<float, 3>& place) const {
    return std::size_t(hash64(std::as_bytes(std::span(place))));
  }
};

// Numbers the distinct positions, starting at 0. Returns the number of each position.
std::vector<std::uint32_t> places_of(std::span<const Vec3> position) {
  std::vector<std::uint32_t> out;
  std::unordered_map<std::array<float, 3>, std::uint32_t, PlaceHash> known;
  known.reserve(position.size());
  for (const Vec3 p : position) {
    // -0 equals 0.
    const std::array<float, 3> key{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
    out.push_back(known.emplace(key, std::uint32_t(known.size())).first->second);
  }
  return out;
}

// An edge of a triangle. It is stored in the list of the smaller of its two places.
struct EdgeUse {
  std::uint32_t other = 0;  // the larger place
  std::uint32_t triangle = 0;
  bool rises = false;  // true if the triangle's edge runs from the smaller place to the larger one
};

// Which triangles use which edges. The edges whose smaller place is p are at first[p] to first[p + 1], sorted
// by their larger place.
struct Edges {
  std::vector<std::size_t> first;
  std::vector<EdgeUse> use;
};

Edges edges_of(std::span<const Triangle> triangle, const std::vector<std::uint32_t>& place) {
  const auto for_each_edge = [&](auto visit) {
    for (std::size_t t = 0; t < triangle.size(); ++t) {
      const Triangle p{place[triangle[t][0]], place[triangle[t][1]], place[triangle[t][2]]};
      if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t a = p[c], b = p[(c + 1) % 3];
        visit(std::min(a, b), EdgeUse{std::max(a, b), std::uint32_t(t), a < b});
      }
    }
  };
  Edges edges;
  edges.first.assign(place.size() + 2, 0);
  for_each_edge([&](std::uint32_t low, const EdgeUse&) { ++edges.first[low + 2]; });
  std::partial_sum(edges.first.begin(), edges.first.end(), edges.first.begin());
  edges.use.resize(edges.first.back());
  for_each_edge([&](std::uint32_t low, const EdgeUse& use) { edges.use[edges.first[low + 1]++] = use; });
  for (std::size_t p = 0; p < place.size(); ++p)
    std::sort(edges.use.begin() + std::ptrdiff_t(edges.first[p]),
              edges.use.begin() + std::ptrdiff_t(edges.first[p + 1]), [](const EdgeUse& a, const EdgeUse& b) {
                return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
              });
  return edges;
}

// Calls visit(uses of one edge) for each edge.
template <class Visit>
void for_each_edge(const Edges& edges, Visit visit) {
  for (std::size_t p = 0; p + 1 < edges.first.size(); ++p)
    for (std::size_t i = edges.first[p]; i < edges.first[p + 1];) {
      std::size_t end = i;
      while (end < edges.first[p + 1] && edges.use[end].other == edges.use[i].other) ++end;
      visit(std::span(edges.use).subspan(i, end - i));
      i = end;
    }
}

bool is_plain(std::span<const EdgeUse> uses) {
  return uses.size() == 2 && uses[0].rises != uses[1].rises;
}

// Joins triangles into parts. Two triangles are joined if only they use an edge, one in each direction.
class Parts {
 public:
  Parts(std::size_t triangles, const Edges& edges) : parent_(triangles), is_open_(triangles, false) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    for_each_edge(edges, [&](std::span<const EdgeUse> uses) {
      if (is_plain(uses)) join(uses[0].triangle, uses[1].triangle);
    });
    std::map<std::uint32_t, int> balance;
    for_each_edge(edges, [&](std::span<const EdgeUse> uses) {
      if (is_plain(uses)) return;
      // Surfaces may meet at an edge. If a part uses the edge as often in one direction as in the other, the
      // part is closed there.
      balance.clear();
      for (const EdgeUse& use : uses) balance[find(use.triangle)] += use.rises ? 1 : -1;
      for (const auto& [part, sum] : balance)
        if (sum != 0) is_open_[part] = true;
    });
  }
  std::uint32_t find(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  bool is_open(std::uint32_t part) const { return is_open_[part]; }

 private:
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> parent_;
  std::vector<bool> is_open_;
};

// The solid angle of a triangle (Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle").
double solid_angle(const Vector& a, const Vector& b, const Vector& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

std::size_t part_of(const SurfaceParts& parts, std::size_t triangle) {
  return std::size_t(
      std::upper_bound(parts.all.begin(), parts.all.end(), triangle,
                       [](std::size_t t, const SurfaceParts::Part& part) { return t < part.end_triangle; }) -
      parts.all.begin());
}

}  // namespace

std::vector<InsideOutPart> inside_out_parts(const SurfaceParts& parts, std::span<const Vec3> position,
                                            std::span<const Triangle> triangle) {
  const auto corner = [&](std::uint32_t v) { return vector_of(position[v]); };
  Parts joined(triangle.size(), edges_of(triangle, places_of(position)));
  std::vector<Enclosed> enclosed(triangle.size());
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const std::uint32_t part = joined.find(std::uint32_t(t));
    if (!joined.is_open(part)) enclosed[part].add(triangle[t], corner(triangle[part][0]), corner);
  }
  std::vector<InsideOutPart> out;
  std::size_t looked_at = 0;
  for (std::size_t part = 0; part < triangle.size(); ++part) {
    if (!enclosed[part].is_inside_out() || ++looked_at > most_inside_out) continue;
    const Vector at = corner(triangle[part][0]);
    double around = 0;
    std::map<std::size_t, std::size_t> from;  // triangles of each SurfaceParts::Part
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangle.size(); ++t) {
      const std::uint32_t of = joined.find(std::uint32_t(t));
      if (of == part) ++from[part_of(parts, t)], ++count;
      if (of != part && enclosed[of].is_outside_out())
        around += solid_angle(minus(corner(triangle[t][0]), at), minus(corner(triangle[t][1]), at),
                              minus(corner(triangle[t][2]), at));
    }
    if (around > 2 * std::numbers::pi) continue;
    const auto most = std::max_element(from.begin(), from.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    const SurfaceParts::Part& name = parts.all[most->first];
    out.push_back({name.node, name.primitive, count});
  }
  return out;
}

void warn_of_inside_out_parts(const tinygltf::Model& model, const SurfaceParts& parts,
                              std::span<const Vec3> position, std::span<const Triangle> triangle,
                              std::span<const OutlineHull> hulls, std::vector<std::string>& warnings) {
  constexpr std::size_t most = 4;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>>
      of;  // parts, triangles
  const auto is_hull = [&](const InsideOutPart& part) {
    return std::any_of(hulls.begin(), hulls.end(), [&](const OutlineHull& hull) {
      return part.node == hull.node && (hull.is_whole_node || part.primitive == hull.primitive);
    });
  };
  for (const InsideOutPart& part : inside_out_parts(parts, position, triangle)) {
    if (is_hull(part)) continue;
    auto& sum = of[{part.node, part.primitive}];
    ++sum.first;
    sum.second += part.triangles;
  }
  std::size_t written = 0;
  for (const auto& [name, sum] : of) {
    if (++written > most) break;
    const std::string closed = sum.first == 1 ? "a closed part" : std::to_string(sum.first) + " closed parts";
    warnings.push_back(closed + " of node \"" + node_label(model, name.first) + "\" (mesh \"" +
                       mesh_label(model, model.nodes[name.first].mesh) + "\" primitive " +
                       std::to_string(name.second) + ", " + std::to_string(sum.second) +
                       (sum.first == 1 ? " triangles) is inside out" : " triangles) are inside out") +
                       ", so its outer side gets the AO of the inside; turn the faces and normals outwards, "
                       "for example with Mesh > Normals > Recalculate Outside in Blender, and export again");
  }
  if (of.size() > most)
    warnings.push_back(std::to_string(of.size() - most) + " more primitives have parts that are inside out");
}

}  // namespace nook::bake
