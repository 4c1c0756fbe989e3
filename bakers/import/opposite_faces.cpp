#include "bakers/import/opposite_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nook::bake {
namespace {

// The cosine of 135 degrees: nearer to opposite than to a right angle.
constexpr double opposite_cosine = -0.70710678;
constexpr std::size_t max_corners = 256;

using Direction = std::array<double, 3>;

double dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Zero where the length is no more than the rounding left by terms of this size that cancel out.
Direction normalised(const Direction& a, double size) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 1e-6 * size)) return {};
  return {a[0] / length, a[1] / length, a[2] / length};
}

// Twice the area long.
Direction face_normal(std::span<const Vec3> position, const std::array<std::uint32_t, 3>& t) {
  const auto edge = [&](int end) {
    const Vec3 a = position[t[0]], b = position[t[end]];
    return Direction{double(b.x) - double(a.x), double(b.y) - double(a.y), double(b.z) - double(a.z)};
  };
  const Direction u = edge(1), v = edge(2);
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

// A triangle where it touches a place.
struct Corner {
  std::uint32_t vertex = 0;
  std::uint32_t next = 0, previous = 0;  // places
  Direction normal{};                    // twice the area long
  Direction direction{};                 // unit length
};

// Vertices joined into sheets: each names another of its sheet, or itself.
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
  double size = 0;  // the lengths of what was summed
  Direction direction{};
  std::uint32_t side = 0;
};

// The two sheets of a side that are furthest apart, if they are opposite; equal pairs are ordered by their
// directions, never by their place in the list.
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

// The smallest bend of a surface where it goes on over the two edges of a corner, as a cosine, less the
// rounding of equal bends.
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

// The sides of the vertices at one place; `vertices` ascend.
void divide_place(std::span<const std::uint32_t> vertices, std::span<const Corner> corners,
                  std::vector<std::uint32_t>& side) {
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

// Items grouped by a number: those of group g are item[first[g]] to item[first[g + 1] - 1], in ascending
// order.
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

}  // namespace

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
    divide_place(vertices.of(p), at_place, side);
  }
  return side;
}

}  // namespace nook::bake
