#include "bakers/nnao/solids.h"

#include <algorithm>
#include <numbers>

namespace nook::bake::nnao {
namespace {

constexpr float turn = 2 * std::numbers::pi_v<float>;

// Adds a grid of `rings` x `sides` quads. point(ring, side) returns their corners. The last side connects to
// the first.
template <class Point>
void add_net(TriangleSoup& soup, int rings, int sides, const Point& point) {
  const auto first = std::uint32_t(soup.position.size());
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < sides; ++s) soup.position.push_back(point(r, s));
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sides; ++s) {
      const auto at = [&](int ring, int side) { return first + std::uint32_t(ring * sides + side % sides); };
      soup.triangle.push_back({at(r, s), at(r, s + 1), at(r + 1, s + 1)});
      soup.triangle.push_back({at(r, s), at(r + 1, s + 1), at(r + 1, s)});
    }
}

}  // namespace

void add_triangle(TriangleSoup& soup, Vec3 a, Vec3 b, Vec3 c) {
  const auto first = std::uint32_t(soup.position.size());
  soup.position.insert(soup.position.end(), {a, b, c});
  soup.triangle.push_back({first, first + 1, first + 2});
}

void add_quad(TriangleSoup& soup, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const auto first = std::uint32_t(soup.position.size());
  soup.position.insert(soup.position.end(), {a, b, c, d});
  soup.triangle.push_back({first, first + 1, first + 2});
  soup.triangle.push_back({first, first + 2, first + 3});
}

void add_box(TriangleSoup& soup, const Mat3x4& frame, Vec3 half) {
  const auto corner = [&](int x, int y, int z) {
    return transform_point(frame, {float(x) * half.x, float(y) * half.y, float(z) * half.z});
  };
  for (const int side : {-1, 1}) {
    add_quad(soup, corner(side, -1, -1), corner(side, 1, -1), corner(side, 1, 1), corner(side, -1, 1));
    add_quad(soup, corner(-1, side, -1), corner(1, side, -1), corner(1, side, 1), corner(-1, side, 1));
    add_quad(soup, corner(-1, -1, side), corner(1, -1, side), corner(1, 1, side), corner(-1, 1, side));
  }
}

void add_block(TriangleSoup& soup, Vec3 low, Vec3 high) {
  Mat3x4 frame;
  const Vec3 middle = 0.5f * (low + high);
  frame.m[3] = middle.x;
  frame.m[7] = middle.y;
  frame.m[11] = middle.z;
  add_box(soup, frame, high - middle);
}

void add_block(TriangleSoup& soup, const Mat3x4& frame, Vec3 low, Vec3 high) {
  const Vec3 middle = 0.5f * (low + high);
  add_box(soup, moved(frame, middle), high - middle);
}

void add_bevelled_box(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, float bevel) {
  const float size[3] = {half.x, half.y, half.z};
  bevel = std::min({bevel, 0.9f * half.x, 0.9f * half.y, 0.9f * half.z});
  // Returns the corner with these signs, on the face of one axis.
  const auto corner = [&](std::array<float, 3> sign, std::size_t face) {
    float p[3];
    for (std::size_t i = 0; i < 3; ++i) p[i] = sign[i] * (i == face ? size[i] : size[i] - bevel);
    return transform_point(frame, {p[0], p[1], p[2]});
  };
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    const auto signs = [&](float sa, float sb, float sc) {
      std::array<float, 3> sign{};
      sign[a] = sa;
      sign[b] = sb;
      sign[c] = sc;
      return sign;
    };
    for (const float s : {-1.0f, 1.0f}) {
      add_quad(soup, corner(signs(s, -1, -1), a), corner(signs(s, 1, -1), a), corner(signs(s, 1, 1), a),
               corner(signs(s, -1, 1), a));
      for (const float t : {-1.0f, 1.0f})
        add_quad(soup, corner(signs(s, t, -1), a), corner(signs(s, t, -1), b), corner(signs(s, t, 1), b),
                 corner(signs(s, t, 1), a));
    }
  }
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f})
      for (const float z : {-1.0f, 1.0f})
        add_triangle(soup, corner({x, y, z}, 0), corner({x, y, z}, 1), corner({x, y, z}, 2));
}

void add_cushion(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, float softness, int sides) {
  const int rings = sides / 2;
  const auto power = [&](float x) { return std::copysign(std::pow(std::abs(x), softness), x); };
  add_net(soup, rings, sides, [&](int ring, int side) {
    const float latitude = 0.5f * turn * (float(ring) / float(rings) - 0.5f);
    const float angle = turn * float(side) / float(sides);
    const float out = power(std::cos(latitude));
    return transform_point(frame, {half.x * out * power(std::cos(angle)), half.y * power(std::sin(latitude)),
                                   half.z * out * power(std::sin(angle))});
  });
}

void axes_across(Vec3 direction, Vec3& u, Vec3& v) {
  const Vec3 d = normalised(direction);
  u = normalised(cross(d, std::abs(d.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
  v = cross(d, u);
}

void add_cylinder(TriangleSoup& soup, Vec3 from, Vec3 to, float radius_from, float radius_to, int sides) {
  Vec3 u, v;
  axes_across(to - from, u, v);
  add_net(soup, 3, sides, [&](int ring, int side) {
    const float angle = turn * float(side) / float(sides);
    const float radius = ring == 1 ? radius_from : ring == 2 ? radius_to : 0;
    return (ring < 2 ? from : to) + radius * (std::cos(angle) * u + std::sin(angle) * v);
  });
}

void add_capsule(TriangleSoup& soup, Vec3 from, Vec3 to, float radius, int sides) {
  constexpr int rings = 9;
  Vec3 u, v;
  axes_across(to - from, u, v);
  const Vec3 axis = normalised(to - from);
  add_net(soup, rings, sides, [&](int ring, int side) {
    // Rings 0 to 4 are around the first end, rings 5 to 9 around the other end.
    const float latitude = 0.25f * turn * (ring < 5 ? float(ring - 4) / 4 : float(ring - 5) / 4);
    const float angle = turn * float(side) / float(sides);
    return (ring < 5 ? from : to) +
           radius *
               (std::sin(latitude) * axis + std::cos(latitude) * (std::cos(angle) * u + std::sin(angle) * v));
  });
}

void add_ellipsoid(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, int sides) {
  const int rings = sides / 2;
  add_net(soup, rings, sides, [&](int ring, int side) {
    const float latitude = 0.5f * turn * (float(ring) / float(rings) - 0.5f);
    const float angle = turn * float(side) / float(sides);
    return transform_point(frame, {half.x * std::cos(latitude) * std::cos(angle), half.y * std::sin(latitude),
                                   half.z * std::cos(latitude) * std::sin(angle)});
  });
}

void add_lathe(TriangleSoup& soup, const Mat3x4& frame, const std::vector<std::array<float, 2>>& profile,
               int sides) {
  add_net(soup, int(profile.size()) - 1, sides, [&](int ring, int side) {
    const float angle = turn * float(side) / float(sides);
    const auto [radius, height] = profile[std::size_t(ring)];
    return transform_point(frame, {radius * std::cos(angle), height, radius * std::sin(angle)});
  });
}

void add_torus(TriangleSoup& soup, const Mat3x4& frame, float radius, float tube_radius, int sides) {
  add_net(soup, sides, 10, [&](int ring, int side) {
    const float angle = turn * float(ring) / float(sides), round = turn * float(side) / 10;
    const float out = radius + tube_radius * std::cos(round);
    return transform_point(frame,
                           {out * std::cos(angle), tube_radius * std::sin(round), out * std::sin(angle)});
  });
}

void add_tube(TriangleSoup& soup, const std::vector<Vec3>& path, const std::vector<float>& radius,
              int sides) {
  const std::size_t last = path.size() - 1;
  Vec3 u, v;
  axes_across(path[1] - path[0], u, v);
  std::vector<std::array<Vec3, 2>> axes;
  for (std::size_t i = 0; i <= last; ++i) {
    // The two axes follow the path without twisting.
    const Vec3 along = normalised(path[std::min(i + 1, last)] - path[i == 0 ? 0 : i - 1]);
    u = normalised(u - dot(u, along) * along);
    axes.push_back({u, cross(along, u)});
  }
  add_net(soup, int(last), sides, [&](int ring, int side) {
    const float angle = turn * float(side) / float(sides);
    const auto i = std::size_t(ring);
    return path[i] + radius[i] * (std::cos(angle) * axes[i][0] + std::sin(angle) * axes[i][1]);
  });
}

void add_tube(TriangleSoup& soup, const std::vector<Vec3>& path, float radius, int sides) {
  add_tube(soup, path, std::vector<float>(path.size(), radius), sides);
}

void add_moulding(TriangleSoup& soup, const Mat3x4& frame, float length,
                  const std::vector<std::array<float, 2>>& profile) {
  const auto at = [&](std::size_t i, float x) {
    return transform_point(frame, {x, profile[i][1], profile[i][0]});
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    add_quad(soup, at(i, 0), at(i, length), at(i + 1, length), at(i + 1, 0));
  for (const float x : {0.0f, length})
    for (std::size_t i = 1; i + 1 < profile.size(); ++i) add_triangle(soup, at(0, x), at(i, x), at(i + 1, x));
}

Mat3x4 standing_frame(Vec3 origin, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{c, 0, s, origin.x, 0, 1, 0, origin.y, -s, 0, c, origin.z}};
}

Mat3x4 moved(const Mat3x4& frame, Vec3 by) {
  return frame * Mat3x4{{1, 0, 0, by.x, 0, 1, 0, by.y, 0, 0, 1, by.z}};
}

Mat3x4 tilted(const Mat3x4& frame, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return frame * Mat3x4{{1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0}};
}

Mat3x4 rolled(const Mat3x4& frame, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return frame * Mat3x4{{c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0}};
}

Vec3 any_direction(Random& random) {
  const float z = random.between(-1, 1), angle = random.between(0, turn), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), z, r * std::sin(angle)};
}

Mat3x4 tumbled_frame(Vec3 origin, Random& random) {
  // A uniform unit quaternion (Shoemake 1992).
  const float u = random.unit(), a = turn * random.unit(), b = turn * random.unit();
  const float x = std::sqrt(1 - u) * std::sin(a), y = std::sqrt(1 - u) * std::cos(a);
  const float z = std::sqrt(u) * std::sin(b), w = std::sqrt(u) * std::cos(b);
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), origin.x, 2 * (x * y + z * w),
           1 - 2 * (x * x + z * z), 2 * (y * z - x * w), origin.y, 2 * (x * z - y * w), 2 * (y * z + x * w),
           1 - 2 * (x * x + y * y), origin.z}};
}

}  // namespace nook::bake::nnao
