#include "bakers/import/static_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/import/accessor.h"
#include "bakers/import/coincident_surfaces.h"
#include "bakers/import/file_reader.h"
#include "bakers/import/fronts.h"
#include "bakers/import/gltf_document.h"
#include "bakers/import/gltf_textures.h"
#include "bakers/import/gltf_types.h"
#include "bakers/import/shown_primitives.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {
namespace {

Vec3 read_colour(const std::vector<double>& rgb, double most, std::size_t material, const char* what) {
  if (rgb.size() < 3)
    throw Failure(NOOK_ERROR_BAD_FILE, "material %zu has a %s with %zu numbers (need 3 or more)", material,
                  what, rgb.size());
  for (std::size_t i = 0; i < 3; ++i)
    if (!(rgb[i] >= 0 && rgb[i] <= max_emission))
      throw Failure(NOOK_ERROR_BAD_FILE, "material %zu has a %s out of range (got %g, need 0 to %g)",
                    material, what, rgb[i], max_emission);
  const auto channel = [&](std::size_t i) { return float(std::min(rgb[i], most)); };
  return {channel(0), channel(1), channel(2)};
}

double emissive_strength(const tinygltf::Material& material) {
  const auto extension = material.extensions.find("KHR_materials_emissive_strength");
  if (extension == material.extensions.end() || !extension->second.Has("emissiveStrength")) return 1;
  const tinygltf::Value& strength = extension->second.Get("emissiveStrength");
  return strength.IsNumber() ? strength.GetNumberAsDouble() : 1;
}

void read_alpha(const tinygltf::Material& material, std::size_t index, Surface& surface) {
  if (material.alphaMode != "MASK") return;
  const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
  surface.alpha = factor.size() > 3 ? float(factor[3]) : 1.0f;
  surface.alpha_cutoff = float(material.alphaCutoff);
  if (!std::isfinite(surface.alpha) || !std::isfinite(surface.alpha_cutoff))
    throw Failure(NOOK_ERROR_BAD_FILE, "material %zu has an alpha that is not finite", index);
}

void read_surfaces(const tinygltf::Model& model, SceneTextures textures, StaticScene& scene) {
  GltfTextures used(model);
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    const tinygltf::Material& material = model.materials[m];
    Surface surface;
    surface.base_colour = read_colour(material.pbrMetallicRoughness.baseColorFactor, 1, m, "baseColorFactor");
    std::vector<double> emission = material.emissiveFactor;
    for (double& channel : emission) channel *= emissive_strength(material);
    surface.emission = read_colour(emission, max_emission, m, "emission");
    if (textures == SceneTextures::read) {
      const std::string what = "material " + std::to_string(m);
      surface.base_colour_texture =
          used.use(material.pbrMetallicRoughness.baseColorTexture, what + ", baseColorTexture");
      surface.emission_texture = used.use(material.emissiveTexture, what + ", emissiveTexture");
      read_alpha(material, m, surface);
    }
    scene.surface.push_back(surface);
  }
  scene.surface.emplace_back();
  scene.image = used.take_images();
}

// Reads one set of texture coordinates for the vertices from `first` on.
void read_uv(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const TextureUse& use,
             std::size_t first, const std::string& what, StaticScene& scene) {
  if (!use.is_used()) return;
  const std::string name = "TEXCOORD_" + std::to_string(use.uv_set);
  const int accessor = attribute(primitive, name);
  if (accessor < 0)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has no %s, but the texture of material %d needs it", what.c_str(),
                  name.c_str(), primitive.material);
  require_allowed_type(model, accessor, AccessorUse::texture_coordinates, what + "." + name);
  const std::size_t count = element_count(model, accessor, what + "." + name);
  if (count != scene.position.size() - first)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has %zu %s (need one for each of %zu vertices)", what.c_str(),
                  count, name.c_str(), scene.position.size() - first);
  const Floats uv = read_floats(model, accessor, 2, what + "." + name);
  for (std::size_t v = 0; v < uv.count; ++v) {
    const TexturePoint point{uv.value[2 * v], uv.value[2 * v + 1]};
    if (!std::isfinite(point.u) || !std::isfinite(point.v))
      throw Failure(NOOK_ERROR_BAD_FILE, "%s: %s of vertex %zu is not finite", what.c_str(), name.c_str(), v);
    scene.uv[first + v][use.uv_set] = point;
  }
}

void append_primitive(const tinygltf::Model& model, const ShownPrimitive& shown, StaticScene& scene) {
  const tinygltf::Primitive& primitive = *shown.primitive;
  const std::string& what = shown.what;
  if (!has_triangles(primitive)) return;
  const auto first = std::uint32_t(scene.position.size());
  const Floats position = read_positions(model, shown, first);
  for (std::size_t v = 0; v < position.count; ++v) {
    const float* p = &position.value[3 * v];
    const Vec3 world = transform(shown.world_from_mesh, Vec3{p[0], p[1], p[2]});
    if (!is_place(world))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s: vertex %zu is out of range (got %g %g %g, need finite metres up to 1e6)",
                    what.c_str(), v, double(world.x), double(world.y), double(world.z));
    scene.position.push_back(world);
  }
  const std::size_t first_triangle = scene.triangle.size();
  append_triangles(model, primitive, position.count, what, scene.triangle);
  const std::vector<float> normal = read_normals(model, primitive, position.count, what);
  const bool turns = turns_round({position.value, normal, std::span(scene.triangle).subspan(first_triangle)},
                                 shown.world_from_mesh, determinant(shown.world_from_mesh) < 0);
  for (std::size_t t = first_triangle; t < scene.triangle.size(); ++t) {
    for (std::uint32_t& i : scene.triangle[t]) i += first;
    if (turns) std::swap(scene.triangle[t][1], scene.triangle[t][2]);
  }
  const auto none = std::uint32_t(scene.surface.size() - 1);
  if (primitive.material >= int(none))
    throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to material %d, but the file has only %u", what.c_str(),
                  primitive.material, none);
  const std::uint32_t index = primitive.material < 0 ? none : std::uint32_t(primitive.material);
  scene.triangle_surface.resize(scene.triangle.size(), index);
  if (scene.image.empty()) return;
  scene.uv.resize(scene.position.size());
  for (const TextureUse* use :
       {&scene.surface[index].base_colour_texture, &scene.surface[index].emission_texture})
    read_uv(model, primitive, *use, first, what, scene);
}

StaticScene import_document(std::span<const std::byte> bytes, const FileAccess& files, SceneTextures textures,
                            const MeshSelection& meshes) {
  const tinygltf::Model model =
      parse_gltf(bytes, files, textures == SceneTextures::read ? Images::keep : Images::skip);
  StaticScene scene;
  read_surfaces(model, textures, scene);
  SurfaceParts parts;
  scene.warnings = for_each_shown_primitive(model, meshes, [&](const ShownPrimitive& shown) {
    append_primitive(model, shown, scene);
    parts.all.push_back({shown.node, shown.index, scene.triangle.size()});
  });
  if (scene.triangle.empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "the default scene shows no triangle; export the meshes with it");
  warn_of_close_surfaces(model, parts, scene.position, scene.triangle, scene.warnings);
  return scene;
}

}  // namespace

StaticScene import_static_scene(const std::filesystem::path& path, SceneTextures textures,
                                const ImportOptions& options) {
  return import_document(read_file_bytes(path),
                         {std::filesystem::absolute(path).parent_path().string(), options.linked}, textures,
                         options.meshes);
}

StaticScene import_static_scene(std::span<const std::byte> bytes, SceneTextures textures,
                                const MeshSelection& meshes) {
  return import_document(bytes, {}, textures, meshes);
}

}  // namespace nook::bake
