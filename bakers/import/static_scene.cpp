#include "import/static_scene.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/failure.h"
#include "import/accessor.h"
#include "import/gltf_document.h"
#include "import/primitive_triangles.h"
#include "import/validate.h"

namespace nook::bake {
namespace {

void append_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                      const std::string& what, const Affine& world_from_mesh, StaticScene& scene) {
  if (!has_triangles(primitive)) return;
  const int accessor = attribute(primitive, "POSITION");
  if (accessor < 0) throw Failure(NOOK_ERROR_BAD_FILE, "%s has no POSITION", what.c_str());
  const Floats position = read_floats(model, accessor, 3, what + ".POSITION");
  const auto first = std::uint32_t(scene.position.size());
  if (position.count > max_file_vertices - first)
    throw Failure(NOOK_ERROR_BAD_FILE, "too many vertices (need at most %zu)", max_file_vertices);
  for (std::size_t v = 0; v < position.count; ++v) {
    const float* p = &position.value[3 * v];
    const Vec3 world = transform(world_from_mesh, Vec3{p[0], p[1], p[2]});
    if (!std::isfinite(world.x) || !std::isfinite(world.y) || !std::isfinite(world.z))
      throw Failure(NOOK_ERROR_BAD_FILE, "%s: vertex %zu is not finite", what.c_str(), v);
    scene.position.push_back(world);
  }
  const std::size_t first_triangle = scene.triangle.size();
  append_triangles(model, primitive, position.count, what, scene.triangle);
  for (std::size_t t = first_triangle; t < scene.triangle.size(); ++t)
    for (std::uint32_t& i : scene.triangle[t]) i += first;
}

StaticScene import_document(std::span<const std::byte> bytes, const std::string& base_dir) {
  const tinygltf::Model model = parse_gltf(bytes, base_dir);
  const NodeTree nodes = read_nodes(model);
  const std::vector<bool> shown = shown_nodes(model, nodes);
  const std::vector<Affine> world = default_world_transforms(nodes);
  StaticScene scene;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const int mesh = model.nodes[n].mesh;
    if (!shown[n] || mesh < 0) continue;
    if (std::size_t(mesh) >= model.meshes.size())
      throw Failure(NOOK_ERROR_BAD_FILE, "node %zu names mesh %d (file has %zu)", n, mesh,
                    model.meshes.size());
    const auto& primitives = model.meshes[std::size_t(mesh)].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p)
      append_primitive(model, primitives[p],
                       "mesh " + std::to_string(mesh) + " primitive " + std::to_string(p), world[n], scene);
  }
  if (scene.triangle.empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "the default scene shows no triangle; export the meshes with it");
  return scene;
}

}  // namespace

StaticScene import_static_scene(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Failure(NOOK_ERROR_BAD_FILE, "cannot be opened");
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::filesystem::path folder = path.parent_path();
  return import_document(std::as_bytes(std::span(bytes)), folder.empty() ? "." : folder.string());
}

StaticScene import_static_scene(std::span<const std::byte> bytes) {
  return import_document(bytes, "");
}

}  // namespace nook::bake
