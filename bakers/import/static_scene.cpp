#include "import/static_scene.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/failure.h"
#include "import/accessor.h"
#include "import/gltf_document.h"
#include "import/primitive_triangles.h"
#include "import/validate.h"

namespace nook::bake {
namespace {

Vec3 read_colour(const std::vector<double>& rgb, double most, std::size_t material, const char* what) {
  if (rgb.size() < 3)
    throw Failure(NOOK_ERROR_BAD_FILE, "material %zu has a %s of %zu numbers (need 3 or more)", material,
                  what, rgb.size());
  for (std::size_t i = 0; i < 3; ++i)
    if (!(rgb[i] >= 0) || !std::isfinite(float(rgb[i])))
      throw Failure(NOOK_ERROR_BAD_FILE, "material %zu has a %s that is negative or not finite", material,
                    what);
  const auto channel = [&](std::size_t i) { return float(std::min(rgb[i], most)); };
  return {channel(0), channel(1), channel(2)};
}

double emissive_strength(const tinygltf::Material& material) {
  const auto extension = material.extensions.find("KHR_materials_emissive_strength");
  if (extension == material.extensions.end() || !extension->second.Has("emissiveStrength")) return 1;
  const tinygltf::Value& strength = extension->second.Get("emissiveStrength");
  return strength.IsNumber() ? strength.GetNumberAsDouble() : 1;
}

void read_surfaces(const tinygltf::Model& model, StaticScene& scene) {
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    const tinygltf::Material& material = model.materials[m];
    Surface surface;
    surface.base_colour = read_colour(material.pbrMetallicRoughness.baseColorFactor, 1, m, "baseColorFactor");
    std::vector<double> emission = material.emissiveFactor;
    for (double& channel : emission) channel *= emissive_strength(material);
    surface.emission = read_colour(emission, std::numeric_limits<float>::max(), m, "emission");
    scene.surface.push_back(surface);
    if (material.pbrMetallicRoughness.baseColorTexture.index >= 0 || material.emissiveTexture.index >= 0)
      ++scene.textured;
  }
  scene.surface.emplace_back();
}

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
  const auto none = std::uint32_t(scene.surface.size() - 1);
  if (primitive.material >= int(none))
    throw Failure(NOOK_ERROR_BAD_FILE, "%s names material %d (file has %u)", what.c_str(), primitive.material,
                  none);
  scene.triangle_surface.resize(scene.triangle.size(),
                                primitive.material < 0 ? none : std::uint32_t(primitive.material));
}

StaticScene import_document(std::span<const std::byte> bytes, const std::string& base_dir) {
  const tinygltf::Model model = parse_gltf(bytes, base_dir);
  const NodeTree nodes = read_nodes(model);
  const std::vector<bool> shown = shown_nodes(model, nodes);
  const std::vector<Affine> world = default_world_transforms(nodes);
  StaticScene scene;
  read_surfaces(model, scene);
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
