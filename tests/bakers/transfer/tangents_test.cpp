// Tangents by the rule that bake and shader share, and the import of textured surfaces.
#include <cmath>
#include <string>

#include "bakers/import/surface_mesh.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/transfer/shapes.h"

using namespace nook;
using namespace nook::bake;
namespace shapes = nook::transfer::test;

namespace {

// Two triangles of a square in the plane z = 0, whose u runs along +x or, mirrored, along -x.
SurfaceMesh square(bool is_mirrored) {
  SurfaceMesh mesh;
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normal.assign(4, {0, 0, 1});
  const float s = is_mirrored ? -1.0f : 1.0f;
  mesh.uv = {{0, 0}, {s, 0}, {s, 1}, {0, 1}};
  mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("tangents run along growing u, and their handedness along growing v") {
  std::vector<std::string> warnings;
  for (const Tangent& t : surface_tangents(square(false), warnings)) {
    CHECK(length(t.direction - Vec3{1, 0, 0}) < 1e-6f);
    CHECK(t.handedness == 1);
  }
  for (const Tangent& t : surface_tangents(square(true), warnings)) {
    CHECK(length(t.direction - Vec3{-1, 0, 0}) < 1e-6f);
    CHECK(t.handedness == -1);
  }
  CHECK(warnings.empty());
}

TEST_CASE("a seam of mirrored coordinates keeps both sides apart") {
  // Both squares meet at x = 0 with equal positions, normals and coordinates, each with its own vertices.
  SurfaceMesh mesh = square(false);
  for (int i = 0; i < 4; ++i) {
    mesh.position.push_back({-mesh.position[std::size_t(i)].x, mesh.position[std::size_t(i)].y, 0});
    mesh.normal.push_back({0, 0, 1});
    mesh.uv.push_back(mesh.uv[std::size_t(i)]);
  }
  mesh.triangle.push_back({4, 6, 5});
  mesh.triangle.push_back({4, 7, 6});
  std::vector<std::string> warnings;
  const std::vector<Tangent> tangents = surface_tangents(mesh, warnings);
  for (std::size_t v = 0; v < 8; ++v) {
    CHECK(tangents[v].handedness == (v < 4 ? 1 : -1));
    CHECK(length(tangents[v].direction - Vec3{v < 4 ? 1.0f : -1.0f, 0, 0}) < 1e-6f);
  }
  CHECK(warnings.empty());
  // Shared vertices cannot have both.
  mesh.triangle[2] = {0, 6, 5};
  surface_tangents(mesh, warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("split them") != std::string::npos);
}

TEST_CASE("triangles without an area do not count") {
  SurfaceMesh mesh = square(false);
  mesh.triangle.push_back({0, 0, 1});
  mesh.position.push_back({5, 5, 5});
  mesh.normal.push_back({0, 1, 0});
  mesh.uv.push_back({0, 0});
  std::vector<std::string> warnings;
  const std::vector<Tangent> tangents = surface_tangents(mesh, warnings);
  CHECK(length(tangents[0].direction - Vec3{1, 0, 0}) < 1e-6f);
  CHECK(std::abs(length(tangents[4].direction) - 1) < 1e-6f);
  CHECK(std::abs(tangents[4].direction.y) < 1e-6f);
  CHECK(warnings.size() == 2);
}

TEST_CASE("the tangents of a ball follow its circles of latitude across its seam") {
  const ImportedSurface imported = import_surface(shapes::glb_of(shapes::ball({0, 0, 0}, 1, 64)));
  const SurfaceMesh& mesh = imported.mesh;
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const Vec3 p = mesh.position[v];
    if (std::abs(p.y) > 0.9f) continue;
    const Vec3 along = normalised({p.z, 0, -p.x});
    // At the seam only the triangles of one side count, which are half a step of 5.6 degrees away.
    CHECK(dot(mesh.tangent[v].direction, along) > 0.998f);
    CHECK(mesh.tangent[v].handedness == 1);
  }
}

TEST_CASE("a mesh without texture coordinates is refused by name") {
  std::vector<std::byte> bytes = shapes::glb_of(shapes::plane(1, 2, 1));
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t at = text.find("TEXCOORD_0");
  bytes[at + 9] = std::byte('1');
  try {
    import_surface(bytes);
    FAIL("it was accepted");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    CHECK(std::string(failure.what()).find("no TEXCOORD_0") != std::string::npos);
  }
}

TEST_CASE("a mesh without normals gets the normals of its triangles") {
  std::vector<std::byte> bytes = shapes::glb_of(shapes::ball({0, 0, 0}, 1, 32));
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  bytes[text.find("NORMAL")] = std::byte('_');
  const ImportedSurface imported = import_surface(bytes);
  for (std::size_t v = 0; v < imported.mesh.position.size(); ++v) {
    const Vec3 p = imported.mesh.position[v];
    // The triangles at the poles are slivers.
    if (std::abs(p.y) < 0.99f) CHECK(dot(imported.mesh.normal[v], normalised(p)) > 0.98f);
  }
  CHECK_FALSE(imported.warnings.empty());
}
