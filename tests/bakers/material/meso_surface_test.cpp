#include "bakers/material/meso_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "bakers/material/periodic_tile.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;

namespace {

MesoParameters coarse(std::string_view name) {
  MesoParameters p = meso_parameters(name);
  p.detail = 0.3f;
  return p;
}

// A position up to whole tiles. Vertices of neighbouring tiles are computed apart: equal up to rounding.
std::array<long, 3> on_torus(Vec3 p) {
  constexpr float grid = 1 << 14;
  const auto wrap = [](float v) {
    const long steps = std::lround(v * grid) % long(grid);
    return steps < 0 ? steps + long(grid) : steps;
  };
  return {wrap(p.x), wrap(p.y), std::lround(p.z * grid)};
}

}  // namespace

TEST_CASE("meso-structures are closed surfaces on the torus: they tile without a seam") {
  for (const std::string_view name : meso_names()) {
    INFO(name);
    const MesoSurface s = make_meso_surface(coarse(name));
    REQUIRE(s.position.size() == s.normal.size());
    REQUIRE(s.position.size() == s.albedo.size());
    REQUIRE(s.triangle.size() > 100);
    // Each edge is walked once in each direction, if vertices are identified across tiles. Slivers of an
    // isosurface may fall together on the rounding grid; they are left out on both sides.
    std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> walked;
    for (const auto& t : s.triangle)
      for (int i = 0; i < 3; ++i) {
        const auto a = on_torus(s.position[t[std::size_t(i)]]),
                   b = on_torus(s.position[t[std::size_t((i + 1) % 3)]]);
        if (a == b) continue;
        ++walked[{a, b}];
        --walked[{b, a}];
      }
    std::size_t open = 0;
    for (const auto& [edge, balance] : walked) open += balance != 0;
    // Vertices whose coordinates lie on a boundary of the rounding grid may round apart.
    CHECK(open <= walked.size() / 100);
  }
}

TEST_CASE("normals are unit, point out of the solid, and colours are reflectances") {
  for (const std::string_view name : meso_names()) {
    INFO(name);
    const MesoSurface s = make_meso_surface(coarse(name));
    for (const Vec3 n : s.normal) REQUIRE(length(n) == Approx(1).margin(1e-4));
    for (const Vec3 a : s.albedo)
      for (const float c : {a.x, a.y, a.z}) REQUIRE((c > 0 && c < 1));
    // The signed volume under outward triangles is positive; the parts of the tiles add up to the volume of a
    // closed solid.
    double volume = 0, agree = 0;
    for (const auto& t : s.triangle) {
      const Vec3 a = s.position[t[0]], b = s.position[t[1]], c = s.position[t[2]];
      const Vec3 area = cross(b - a, c - a);
      volume += double(area.z) * double(a.z + b.z + c.z) / 6;
      agree += dot(area, s.normal[t[0]]) > 0;
    }
    CHECK(volume > 0);
    // Coarse triangles at a crease may face away from one of their vertices' normals.
    CHECK(agree > 0.97 * double(s.triangle.size()));
  }
}

TEST_CASE("the same seed gives the same structure, another one another") {
  for (const std::string_view name : meso_names()) {
    INFO(name);
    MesoParameters p = coarse(name);
    const MesoSurface a = make_meso_surface(p), b = make_meso_surface(p);
    CHECK(std::equal(a.position.begin(), a.position.end(), b.position.begin(), b.position.end()));
    p.seed = 2;
    const MesoSurface other = make_meso_surface(p);
    const auto sum = [](const MesoSurface& s) {
      double total = 0;
      for (std::size_t i = 0; i < s.position.size(); ++i)
        total += double(s.position[i].x) * double(i % 7) + double(s.albedo[i].x);
      return total;
    };
    CHECK(sum(a) != sum(other));
  }
}

TEST_CASE("noise repeats across tiles and is smooth") {
  for (int i = 0; i < 200; ++i) {
    const Vec3 p{0.37f * float(i % 13), 0.21f * float(i % 7), 0.05f * float(i)};
    const float here = tile_fractal_noise(p, 5, 3, 9);
    CHECK(tile_fractal_noise({p.x + 1, p.y - 2, p.z}, 5, 3, 9) == Approx(here).margin(1e-4));
    CHECK(std::abs(tile_fractal_noise({p.x + 1e-4f, p.y, p.z}, 5, 3, 9) - here) < 0.02f);
    CHECK(std::abs(here) <= 1.75f);
  }
}

TEST_CASE("unknown names and parameters out of range are refused") {
  const auto message = [](MesoParameters p) {
    try {
      make_meso_surface(p);
    } catch (const Failure& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  MesoParameters p;
  p.name = "felt";
  CHECK(message(p).find("fiber, roughhole, weave") != std::string::npos);
  p = meso_parameters("fiber");
  p.radius = 0;
  CHECK(message(p).find("radius") != std::string::npos);
  p = meso_parameters("weave");
  p.count = 3;
  CHECK(message(p).find("even") != std::string::npos);
  p = meso_parameters("roughhole");
  p.thickness = std::nanf("");
  CHECK(message(p).find("thickness") != std::string::npos);
}
