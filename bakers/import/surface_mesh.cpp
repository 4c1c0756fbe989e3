#include "bakers/import/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "bakers/import/accessor.h"
#include "bakers/import/coincident_surfaces.h"
#include "bakers/import/file_reader.h"
#include "bakers/import/fronts.h"
#include "bakers/import/gltf_document.h"
#include "bakers/import/gltf_types.h"
#include "bakers/import/shown_primitives.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {
namespace {

// The arrays of the primitives that were read so far, and what must still be generated for them.
struct Building {
  SurfaceMesh mesh;
  std::vector<bool> makes_normal, makes_tangent;  // per vertex
  std::size_t opposite = 0;                       // tangents whose w contradicts the texture coordinates
  std::size_t not_unit = 0;                       // normals that were normalised
};

// Reads an attribute with this number of components for each of `count` vertices. Returns nothing if there is
// none.
std::vector<float> read_attribute(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                  const char* name, AccessorUse use, int components, std::size_t count,
                                  const std::string& what) {
  const int accessor = attribute(primitive, name);
  if (accessor < 0) return {};
  const std::string place = std::string(what).append(".").append(name);
  require_allowed_type(model, accessor, use, place);
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

// Turns a normal by the cofactor matrix of the linear part, and normalises it. Mirrored surfaces keep their
// front side.
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
  const std::vector<float> uv =
      read_attribute(model, primitive, "TEXCOORD_0", AccessorUse::texture_coordinates, 2, count, what);
  if (uv.empty() && count > 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has no TEXCOORD_0, which a material needs; unwrap the mesh and export it again",
                  what.c_str());
  std::vector<float> normal, tangent;
  if (shown.morph_weights.empty()) {
    normal = read_attribute(model, primitive, "NORMAL", AccessorUse::normal, 3, count, what);
    if (!normal.empty())
      tangent = read_attribute(model, primitive, "TANGENT", AccessorUse::tangent, 4, count, what);
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
      // Normals in bytes are up to 1.5 % off.
      building.not_unit += std::abs(length(n) - 1) > 0.03f && length(n) > 0.1f;
      if (!stays) n = turn_normal(world_from_mesh, n);
    }
    const bool has_normal = length(n) > 0.1f;
    building.makes_normal.push_back(!has_normal);
    mesh.normal.push_back(has_normal && std::abs(length(n) - 1) > 1e-3f ? normalised(n) : n);
    Tangent t;
    if (!tangent.empty()) {
      // In glTF normal maps, y points towards decreasing v, so our handedness has the opposite sign of w.
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
  const std::vector<float> file_normal = read_normals(model, primitive, count, what);
  const bool turns =
      turns_round({position.value, file_normal, std::span(mesh.triangle).subspan(first_triangle)},
                  world_from_mesh, is_mirrored);
  for (std::size_t t = first_triangle; t < mesh.triangle.size(); ++t) {
    for (std::uint32_t& i : mesh.triangle[t]) i += first;
    if (turns) std::swap(mesh.triangle[t][1], mesh.triangle[t][2]);
  }
}

void make_missing(Building& building, std::vector<std::string>& warnings) {
  SurfaceMesh& mesh = building.mesh;
  if (building.not_unit > 0)
    warnings.push_back(
        std::to_string(building.not_unit)
            .append(" vertices have normals that are not of unit length; they were normalised"));
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
        " vertices have a TANGENT whose w contradicts their texture coordinates; the TANGENT was kept"));
}

ImportedSurface import_document(std::span<const std::byte> bytes, const FileAccess& files,
                                const MeshSelection& meshes) {
  const tinygltf::Model model = parse_gltf(bytes, files);
  Building building;
  ImportedSurface imported;
  SurfaceParts parts;
  imported.warnings = for_each_shown_primitive(model, meshes, [&](const ShownPrimitive& shown) {
    append_primitive(model, shown, building);
    parts.all.push_back({shown.node, shown.index, building.mesh.triangle.size()});
  });
  if (building.mesh.triangle.empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "the default scene shows no triangle; export the meshes with it");
  make_missing(building, imported.warnings);
  const std::vector<OutlineHull> hulls =
      warn_of_close_surfaces(model, parts, building.mesh.position, building.mesh.triangle, imported.warnings);
  warn_of_inside_out_parts(model, parts, building.mesh.position, building.mesh.triangle, hulls,
                           imported.warnings);
  imported.mesh = std::move(building.mesh);
  return imported;
}

}  // namespace

ImportedSurface import_surface(const std::filesystem::path& path, const ImportOptions& options) {
  return import_document(read_file_bytes(path),
                         {std::filesystem::absolute(path).parent_path().string(), options.linked},
                         options.meshes);
}

ImportedSurface import_surface(std::span<const std::byte> bytes, const MeshSelection& meshes) {
  return import_document(bytes, {}, meshes);
}

namespace {

// Groups equal vertices: group[v] is the smallest vertex with the same numbers as v; -0 equals 0.
std::vector<std::uint32_t> equal_vertices(const std::vector<std::array<float, 8>>& key) {
  std::vector<std::uint32_t> order(key.size()), group(key.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    group[order[i]] = i > 0 && key[order[i]] == key[order[i - 1]] ? group[order[i - 1]] : order[i];
  return group;
}

double corner_angle(Vec3 normal, Vec3 to_next, Vec3 to_previous) {
  const Vec3 a = normalised(to_next - normal * dot(normal, to_next));
  const Vec3 b = normalised(to_previous - normal * dot(normal, to_previous));
  return std::acos(std::clamp(double(dot(a, b)), -1.0, 1.0));
}

// along_u is the direction in a triangle's plane in which u grows. sign is the sign of the triangle's
// area in texture coordinates. Both are 0 if the triangle has no area there or in space.
struct Slope {
  Vec3 along_u;
  int sign = 0;
};
Slope slope_of(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3 a = mesh.position[t[1]] - mesh.position[t[0]], b = mesh.position[t[2]] - mesh.position[t[0]];
  const TexturePoint& at = mesh.uv[t[0]];
  const double u1 = double(mesh.uv[t[1]].u) - double(at.u), v1 = double(mesh.uv[t[1]].v) - double(at.v);
  const double u2 = double(mesh.uv[t[2]].u) - double(at.u), v2 = double(mesh.uv[t[2]].v) - double(at.v);
  const double area = u1 * v2 - u2 * v1;
  Slope slope;
  if (!(length(cross(a, b)) > 0) || !(std::abs(area) > 0)) return slope;
  const float sign = area > 0 ? 1.0f : -1.0f;
  // The scale does not matter, so the larger of the two factors becomes 1.
  const double most = std::max(std::abs(v1), std::abs(v2));
  slope.along_u = normalised((a * float(v2 / most) - b * float(v1 / most)) * sign);
  if (dot(slope.along_u, slope.along_u) > 0) slope.sign = int(sign);
  return slope;
}

struct Sums {
  Vec3 direction[2];  // mirrored triangles, and others
};

void warn(std::vector<std::string>& warnings, std::size_t count, const char* text) {
  if (count > 0) warnings.push_back(std::to_string(count).append(text));
}

}  // namespace

Vec3 across_normal(Vec3 normal, Vec3 direction) {
  const Vec3 flat = direction - normal * dot(normal, direction);
  if (length(flat) > 1e-6f * std::max(length(direction), 1e-20f)) return normalised(flat);
  const Vec3 away = std::abs(normal.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalised(away - normal * dot(normal, away));
}

std::vector<Vec3> smooth_normals(std::span<const Vec3> position,
                                 std::span<const std::array<std::uint32_t, 3>> triangle) {
  std::vector<std::array<float, 8>> key(position.size());
  for (std::size_t v = 0; v < key.size(); ++v)
    key[v] = {position[v].x + 0.0f, position[v].y + 0.0f, position[v].z + 0.0f};
  const std::vector<std::uint32_t> group = equal_vertices(key);
  std::vector<Vec3> normal(position.size());
  for (const auto& t : triangle) {
    const Vec3 area = cross(position[t[1]] - position[t[0]], position[t[2]] - position[t[0]]);
    for (const std::uint32_t v : t) normal[group[v]] += area;
  }
  for (std::size_t v = 0; v < normal.size(); ++v)
    if (group[v] == v) {
      normal[v] = normalised(normal[v]);
      if (dot(normal[v], normal[v]) == 0) normal[v] = {0, 0, 1};
    }
  for (std::size_t v = 0; v < normal.size(); ++v) normal[v] = normal[group[v]];
  return normal;
}

std::vector<Tangent> surface_tangents(const SurfaceMesh& mesh, std::vector<std::string>& warnings) {
  const std::size_t count = mesh.position.size();
  std::vector<std::array<float, 8>> key(count);
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 p = mesh.position[v], n = mesh.normal[v];
    key[v] = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f,          n.x + 0.0f,
              n.y + 0.0f, n.z + 0.0f, mesh.uv[v].u + 0.0f, mesh.uv[v].v + 0.0f};
  }
  const std::vector<std::uint32_t> group = equal_vertices(key);
  std::vector<Sums> sums(count);                     // per group
  std::vector<std::array<double, 2>> angles(count);  // per vertex: mirrored, others
  std::size_t degenerate = 0;
  for (const auto& t : mesh.triangle) {
    const Slope slope = slope_of(mesh, t);
    if (slope.sign == 0) {
      ++degenerate;
      continue;
    }
    const std::size_t side = slope.sign > 0 ? 1 : 0;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = t[std::size_t(c)];
      const Vec3 n = mesh.normal[v], p = mesh.position[v];
      const double angle = corner_angle(n, mesh.position[t[std::size_t(c + 1) % 3]] - p,
                                        mesh.position[t[std::size_t(c + 2) % 3]] - p);
      const Vec3 flat = slope.along_u - n * dot(n, slope.along_u);
      sums[group[v]].direction[side] += normalised(flat) * float(angle);
      angles[v][side] += angle;
    }
  }
  std::vector<Tangent> tangent(count);
  std::size_t shared = 0, without = 0;
  for (std::size_t v = 0; v < count; ++v) {
    const bool is_mirrored = angles[v][0] > angles[v][1];
    shared += angles[v][0] > 0 && angles[v][1] > 0;
    without += angles[v][0] + angles[v][1] == 0;
    tangent[v] = {across_normal(mesh.normal[v], sums[group[v]].direction[is_mirrored ? 0 : 1]),
                  is_mirrored ? -1.0f : 1.0f};
  }
  warn(warnings, degenerate,
       " triangles have no area in space or in texture coordinates, and were not used for tangents");
  warn(
      warnings, shared,
      " vertices are shared by mirrored and unmirrored texture coordinates; split them for correct tangents");
  warn(warnings, without, " vertices have no triangle with an area, and got arbitrary tangents");
  return tangent;
}

}  // namespace nook::bake
