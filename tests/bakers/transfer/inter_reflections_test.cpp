// Reflected light and holes of the bake, against closed forms.
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bakers/import/surface_mesh.h"
#include "bakers/transfer/separated_bake.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/transfer_file.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"
#include "tests/material/open_weave.h"
#include "tests/transfer/shapes.h"

using namespace nook;
using namespace nook::bake;
using nook::transfer::Transfer;
namespace shapes = nook::transfer::test;

namespace {

constexpr double pi = std::numbers::pi;
// The first band of a sky of radiance 1.
constexpr double even_sky = 3.5449077;

SurfaceMesh mesh_of(const shapes::Shape& shape) {
  return import_surface(shapes::glb_of(shape)).mesh;
}

// The irradiance of a vertex after a number of reflections of an even sky.
double reflected(const Transfer& baked, std::size_t vertex, std::uint32_t bounce) {
  return even_sky * double(from_half(baked.indirect[(vertex * baked.bounces + bounce - 1) * 9]));
}

// The inside of the lower part of a ball of radius 1, down to a share of its area, with normals to its
// middle.
shapes::Shape bowl(float area_share) {
  shapes::Shape shape;
  constexpr std::uint32_t rings = 20, around = 64;
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t a = 0; a <= around; ++a) {
      const float y = -1 + 2 * area_share * float(r * r) / float(rings * rings),
                  radius = std::sqrt(std::max(1 - y * y, 0.0f)),
                  angle = 2 * std::numbers::pi_v<float> * float(a) / float(around);
      const Vec3 p{radius * std::cos(angle), y, radius * std::sin(angle)};
      shape.position.push_back(p);
      shape.normal.push_back(-normalised(p));
      shape.uv.push_back({float(a) / float(around), float(r) / float(rings)});
    }
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t a = 0; a < around; ++a) {
      const std::uint32_t at = r * (around + 1) + a;
      shape.triangle.push_back({at, at + around + 1, at + 1});
      shape.triangle.push_back({at + 1, at + around + 1, at + around + 2});
    }
  return shape;
}

// The part of a hemisphere that a parallel rectangle at the height h hides, weighted by the cosine: the
// rectangle has one corner above the point and the sides a and b (J. Howell, A Catalog of Radiation Heat
// Transfer Configuration Factors, B-3).
double corner_factor(double a, double b, double h) {
  const double x = a / h, y = b / h, u = std::sqrt(1 + x * x), v = std::sqrt(1 + y * y);
  return (x / u * std::atan(y / u) + y / v * std::atan(x / v)) / (2 * pi);
}
double square_factor(double x, double z, double half, double h) {
  double sum = 0;
  for (const double a : {half - x, half + x})
    for (const double b : {half - z, half + z}) sum += corner_factor(a, b, h);
  return sum;
}

}  // namespace

TEST_CASE("in a bowl reflected light is even: every part of a sphere sees every other alike") {
  for (const float share : {0.5f, 0.3f}) {
    const SurfaceMesh mesh = mesh_of(bowl(share));
    const Transfer baked = bake::transfer::bake_transfer(mesh, {12, 64, 2});
    // A patch of a sphere sees the share f of the whole sphere's patches as the share f of its light: the sky
    // leaves pi (1 - f), and the share f comes back with each reflection.
    const double f = double(share), first = pi * f * (1 - f), second = pi * f * f * (1 - f);
    for (std::size_t v = 0; v < mesh.position.size(); ++v) {
      // Triangles at the bottom are slivers, and at the rim a facet reaches less high than its vertices.
      const float depth = (mesh.position[v].y + 1) / (2 * share);
      if (depth < 0.05f || depth > 0.9f) continue;
      // Cells of 1.4 degrees sample the bowl's rim, and facets are 6 degrees wide.
      CHECK(reflected(baked, v, 1) == Approx(first).epsilon(0.03));
      CHECK(reflected(baked, v, 2) == Approx(second).epsilon(0.03));
    }
  }
}

TEST_CASE("a convex shape reflects no light onto itself") {
  const Transfer baked = bake::transfer::bake_transfer(mesh_of(shapes::ball({0, 0, 0}, 1, 32)), {12, 16, 2});
  for (const std::uint16_t half : baked.indirect) CHECK(from_half(half) == 0);
}

TEST_CASE("two parallel plates reflect light onto each other by their configuration factors") {
  constexpr std::uint32_t across = 17;
  constexpr double half = 0.5, height = 0.4;
  shapes::Shape shape = shapes::plane(1, across, 1), lid = shapes::plane(1, across, 1, float(height));
  for (Vec3& normal : lid.normal) normal = -normal;
  shapes::append(shape, lid);
  const Transfer baked = bake::transfer::bake_transfer(mesh_of(shape), {12, 64, 2});
  // Both plates receive the same direct light, and reflect it to and fro.
  constexpr int steps = 60;
  const auto at = [](int i) { return (i + 0.5) / steps - half; };
  const auto gathered = [&](double x, double z, auto&& irradiance) {
    double sum = 0;
    for (int i = 0; i < steps; ++i)
      for (int k = 0; k < steps; ++k) {
        const double dx = at(i) - x, dz = at(k) - z, square = dx * dx + dz * dz + height * height;
        sum += irradiance(i, k) * height * height / (pi * square * square) / (steps * steps);
      }
    return sum;
  };
  const auto direct = [&](int i, int k) { return pi * (1 - square_factor(at(i), at(k), half, height)); };
  std::vector<double> first(steps * steps);
  for (int i = 0; i < steps; ++i)
    for (int k = 0; k < steps; ++k) first[std::size_t(i * steps + k)] = gathered(at(i), at(k), direct);
  for (const std::uint32_t column : {2u, 5u, 8u})
    for (const std::uint32_t plate : {0u, 1u}) {
      const std::size_t v = plate * across * across + 8 * across + column;
      const double x = double(column) / (across - 1) - half;
      INFO("plate " << plate << ", column " << column);
      // Cells of 1.4 degrees sample the edges of the other plate, whose light is interpolated over 16 cells.
      CHECK(reflected(baked, v, 1) == Approx(gathered(x, 0, direct)).epsilon(0.03));
      CHECK(reflected(baked, v, 2) == Approx(gathered(x, 0, [&](int i, int k) {
                                        return first[std::size_t(i * steps + k)];
                                      })).epsilon(0.03));
    }
}

TEST_CASE("reflections leave direct light alone, and their bytes do not depend on the number of threads") {
  const SurfaceMesh mesh = mesh_of(shapes::knot_over_plane(60, 8, 12));
  const auto bake = [&](int threads, std::uint32_t bounces) {
    Transfer out;
    tbb::task_arena arena(threads);
    arena.execute([&] { out = bake::transfer::bake_transfer(mesh, {42, 16, bounces}); });
    return out;
  };
  const Transfer one = bake(1, 2), three = bake(3, 2), none = bake(2, 0);
  CHECK(nook::transfer::write_transfer(one) == nook::transfer::write_transfer(three));
  CHECK(none.shares == one.shares);
  CHECK(none.frames == one.frames);
  CHECK(none.indirect.empty());
  // The first reflection does not depend on the number of reflections.
  const Transfer single = bake(2, 1);
  for (std::size_t v = 0; v < mesh.position.size(); ++v)
    for (std::size_t k = 0; k < 9; ++k) CHECK(single.indirect[9 * v + k] == one.indirect[18 * v + k]);
}

TEST_CASE("under a half-open weave light comes through by its measured openness") {
  material::test::WeaveSize size;
  size.visibility = material::VisibilityForm::binary;
  size.radius = 0.03f;
  const material::MaterialTables tables =
      material::make_tables(material::test::open_weave(size), {}, default_memory());
  constexpr float height = 0.4f, sheet = 6, tiles = 77;
  shapes::Shape shape = shapes::plane(0.2f, 3, 1);
  shapes::append(shape, shapes::plane(sheet, 2, 1, height));
  constexpr std::uint32_t lobes = 162, middle = 4;
  bake::transfer::BakeSettings settings{lobes, 48};
  settings.holes = std::make_shared<const bake::transfer::HoleTable>(bake::transfer::make_hole_table(tables));
  settings.tiles = tiles;
  const SurfaceMesh mesh = mesh_of(shape);
  const Transfer baked = bake::transfer::bake_transfer(mesh, settings);
  CHECK(baked.votf_hash == tables.votf_hash);
  const Transfer closed = bake::transfer::bake_transfer(mesh, {lobes, 48});

  // Lines through the sheet, straight from the VOTF.
  const nook::transfer::CubeCells cells(192);
  std::vector<Vec3> axes(lobes);
  nook::transfer::lobe_axes(axes);
  std::vector<double> seen(lobes), whole(lobes);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 d = cells.direction[i];
    if (!(d.y > 0)) continue;
    const Vec3 p = d * (height / d.y);
    float open = 1;
    if (std::abs(p.x) < sheet / 2 && std::abs(p.z) < sheet / 2) {
      material::Sample sample;
      sample.u = tiles * (p.x / sheet + 0.5f);
      sample.v = tiles * (0.5f - p.z / sheet);
      sample.view = {d.x, -d.z, d.y};
      open = 1 - material::visibility_of(tables.visibility, tables.mapping,
                                         material::evaluate_votf(tables, sample));
    }
    for (std::size_t j = 0; j < lobes; ++j) {
      const double weight = double(gaussian_value(axes[j], nook::transfer::sharpness_of(lobes), d) * d.y *
                                   cells.solid_angle[i]);
      whole[j] += weight;
      seen[j] += weight * double(open);
    }
  }
  double measured = 0, got = 0, count = 0;
  for (std::size_t j = 0; j < lobes; ++j) {
    if (axes[j].y < 0.3f) continue;
    INFO("lobe " << j << " with y = " << axes[j].y);
    const double share = double(baked.shares_of(middle)[j]) / 255, open = seen[j] / whole[j];
    // Rays have the table's views of 5 degrees instead of their own, and footprints of 2 degrees.
    CHECK(std::abs(share - open) < 0.08);
    // The sheet ends 4 degrees above the horizon.
    CHECK(closed.shares_of(middle)[j] < 8);
    measured += open;
    got += share;
    count += 1;
  }
  CHECK(measured / count > 0.2);
  CHECK(measured / count < 0.8);
  // The mean of many lobes has less of both.
  CHECK(std::abs(got - measured) / count < 0.02);
}

TEST_CASE("a material without a VOTF has no holes to bake") {
  material::test::SampleSize size;
  size.visibility = material::VisibilityForm::none;
  CHECK_THROWS_AS(bake::transfer::make_hole_table(
                      material::make_tables(material::test::sample_material(1, size), {}, default_memory())),
                  Failure);
}
