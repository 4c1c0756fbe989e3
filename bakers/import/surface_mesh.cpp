#include "bakers/import/surface_mesh.h"

#include <algorithm>
#include <cmath>

#include "bakers/import/accessor.h"
#include "bakers/import/file_reader.h"
#include "bakers/import/gltf_document.h"
#include "bakers/import/primitive_triangles.h"
#include "bakers/import/shown_primitives.h"
#include "bakers/import/tangents.h"
#include "bakers/import/validate.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {
namespace {

// The arrays of the primitives so far, and what is still to be made.
struct Building {
  SurfaceMesh mesh;
  std::vector<bool> makes_normal, makes_tangent;  // of each vertex
  std::size_t opposite = 0;                       // tangents whose w contradicts the texture coordinates
};

// Reads an attribute of one number of components for each of `count` vertices; empty if there is none.
std::vector<float> read_attribute(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                  const char* name, int components, std::size_t count,
                                  const std::string& what) {
  const int accessor = attribute(primitive, name);
  if (accessor < 0) return {};
  const std::string place = std::string(what).append(".").append(name);
  const std::size_t got = element_count(model, accessor, place);
  if (got != count)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has %zu elements (need one for each of %zu vertices)",
                  place.c_str(), got, count);
  std::vector<float> values = read_floats(model, accessor, components, place).value;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw Failure(NOOK_ERROR_BAD_FILE, "%s of vertex %zu is not finite", place.c_str(),
                    i / std::size_t(components));
  return values;
}

// Turns a direction by the linear part of a transform.
Vec3 turn(const Affine& a, Vec3 v) {
  const auto row = [&](std::size_t r) {
    return float(a.m[r] * double(v.x) + a.m[r + 1] * double(v.y) + a.m[r + 2] * double(v.z));
  };
  return {row(0), row(4), row(8)};
}

// The matrix of normals, up to its scale: the cofactors of the linear part, which are the cross products of
// its columns and keep the side of a mirrored surface.
Vec3 turn_normal(const Affine& a, Vec3 n) {
  const auto& m = a.m;
  const auto cofactor = [&](std::size_t r, std::size_t c) {
    const std::size_t r1 = (r + 1) % 3 * 4, r2 = (r + 2) % 3 * 4, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1 + c1] * m[r2 + c2] - m[r1 + c2] * m[r2 + c1];
  };
  const auto row = [&](std::size_t r) {
    return cofactor(r, 0) * double(n.x) + cofactor(r, 1) * double(n.y) + cofactor(r, 2) * double(n.z);
  };
  const double x = row(0), y = row(1), z = row(2), size = std::sqrt(x * x + y * y + z * z);
  const double scale = size > 0 ? (determinant(a) < 0 ? -1 : 1) / size : 0;
  return {float(x * scale), float(y * scale), float(z * scale)};
}

bool is_identity(const Affine& a) {
  return a.m == Affine{}.m;
}

void append_primitive(const tinygltf::Model& model, const ShownPrimitive& shown, Building& building) {
  const tinygltf::Primitive& primitive = *shown.primitive;
  const std::string& what = shown.what;
  const Affine& world_from_mesh = shown.world_from_mesh;
  if (!has_triangles(primitive)) return;
  SurfaceMesh& mesh = building.mesh;
  const auto first = std::uint32_t(mesh.position.size());
  const Floats position = read_positions(model, shown, first);
  const std::size_t count = position.count;
  const std::vector<float> uv = read_attribute(model, primitive, "TEXCOORD_0", 2, count, what);
  if (uv.empty() && count > 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has no TEXCOORD_0, which a material needs; unwrap the mesh and export it again",
                  what.c_str());
  std::vector<float> normal, tangent;
  if (shown.morph_weights.empty()) {
    normal = read_attribute(model, primitive, "NORMAL", 3, count, what);
    if (!normal.empty()) tangent = read_attribute(model, primitive, "TANGENT", 4, count, what);
  }
  const bool stays = is_identity(world_from_mesh), is_mirrored = determinant(world_from_mesh) < 0;
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 p{position.value[3 * v], position.value[3 * v + 1], position.value[3 * v + 2]};
    const Vec3 world = stays ? p : transform(world_from_mesh, p);
    if (!is_place(world))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s: vertex %zu is out of range (got %g %g %g, need finite metres up to 1e6)",
                    what.c_str(), v, double(world.x), double(world.y), double(world.z));
    mesh.position.push_back(world);
    mesh.uv.push_back({uv[2 * v], uv[2 * v + 1]});
    Vec3 n;
    if (!normal.empty()) {
      n = {normal[3 * v], normal[3 * v + 1], normal[3 * v + 2]};
      if (!stays) n = turn_normal(world_from_mesh, n);
    }
    const bool has_normal = length(n) > 0.1f;
    building.makes_normal.push_back(!has_normal);
    mesh.normal.push_back(has_normal && std::abs(length(n) - 1) > 1e-3f ? normalised(n) : n);
    Tangent t;
    if (!tangent.empty()) {
      // The normal maps of glTF have y up, against growing v, and so their w has the other sign.
      t.direction = {tangent[4 * v], tangent[4 * v + 1], tangent[4 * v + 2]};
      if (!stays) t.direction = turn(world_from_mesh, t.direction);
      t.handedness = (tangent[4 * v + 3] < 0) == is_mirrored ? -1.0f : 1.0f;
    }
    const bool has_tangent = has_normal && length(t.direction) > 0.1f;
    building.makes_tangent.push_back(!has_tangent);
    mesh.tangent.push_back(t);
  }
  const std::size_t first_triangle = mesh.triangle.size();
  append_triangles(model, primitive, count, what, mesh.triangle);
  for (std::size_t t = first_triangle; t < mesh.triangle.size(); ++t) {
    for (std::uint32_t& i : mesh.triangle[t]) i += first;
    if (is_mirrored) std::swap(mesh.triangle[t][1], mesh.triangle[t][2]);
  }
}

void make_missing(Building& building, std::vector<std::string>& warnings) {
  SurfaceMesh& mesh = building.mesh;
  const auto count = [](const std::vector<bool>& made) {
    return std::size_t(std::count(made.begin(), made.end(), true));
  };
  if (const std::size_t made = count(building.makes_normal); made > 0) {
    const std::vector<Vec3> normal = smooth_normals(mesh.position, mesh.triangle);
    for (std::size_t v = 0; v < normal.size(); ++v)
      if (building.makes_normal[v]) mesh.normal[v] = normal[v];
    warnings.push_back(std::to_string(made).append(" vertices got normals from their triangles"));
  }
  std::vector<std::string> repairs;
  const std::vector<Tangent> tangent = surface_tangents(mesh, repairs);
  std::size_t opposite = 0;
  for (std::size_t v = 0; v < tangent.size(); ++v) {
    if (building.makes_tangent[v]) {
      mesh.tangent[v] = tangent[v];
      continue;
    }
    mesh.tangent[v].direction = across_normal(mesh.normal[v], mesh.tangent[v].direction);
    opposite += mesh.tangent[v].handedness != tangent[v].handedness;
  }
  if (count(building.makes_tangent) > 0) {
    warnings.push_back(std::to_string(count(building.makes_tangent))
                           .append(" vertices got tangents from their texture coordinates"));
    warnings.insert(warnings.end(), repairs.begin(), repairs.end());
  }
  if (opposite > 0)
    warnings.push_back(std::to_string(opposite).append(
        " vertices have a TANGENT whose w contradicts their texture coordinates; it was kept"));
}

ImportedSurface import_document(std::span<const std::byte> bytes, const FileAccess& files) {
  const tinygltf::Model model = parse_gltf(bytes, files);
  Building building;
  for_each_shown_primitive(model,
                           [&](const ShownPrimitive& shown) { append_primitive(model, shown, building); });
  if (building.mesh.triangle.empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "the default scene shows no triangle; export the meshes with it");
  ImportedSurface imported;
  make_missing(building, imported.warnings);
  imported.mesh = std::move(building.mesh);
  return imported;
}

}  // namespace

ImportedSurface import_surface(const std::filesystem::path& path, LinkedFiles linked) {
  return import_document(read_file_bytes(path),
                         {std::filesystem::absolute(path).parent_path().string(), linked});
}

ImportedSurface import_surface(std::span<const std::byte> bytes) {
  return import_document(bytes, {});
}

}  // namespace nook::bake
