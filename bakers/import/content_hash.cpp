#include "bakers/import/content_hash.h"

namespace nook::bake {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(float));
static_assert(sizeof(SkinWeights) == SkinWeights::max_bones * (sizeof(std::uint16_t) + sizeof(float)));
static_assert(sizeof(Tangent) == 4 * sizeof(float) && sizeof(TexturePoint) == 2 * sizeof(float));
static_assert(sizeof(Mat3x4) == 12 * sizeof(float));
// Affine and Trs consist of doubles alone.
static_assert(sizeof(Affine) % sizeof(double) == 0 && sizeof(Trs) == 10 * sizeof(double));

template <class Numbers>
void add_numbers(ContentHash& hash, const Numbers& numbers) {
  hash.add_list(std::span<const Numbers>(&numbers, 1));
}

void add_skeleton(ContentHash& hash, const ImportedCharacter& character) {
  for (const Bone& bone : character.mesh.bones) {
    hash.add(bone.name);
    hash.add(bone.parent);
    add_numbers(hash, bone.frame_rest);
  }
  // Node names do not affect a bake. Bones have their own names.
  hash.add(std::uint64_t(character.nodes.size()));
  for (const Node& node : character.nodes.nodes) {
    hash.add(node.parent);
    add_numbers(hash, node.local);
    hash.add(node.matrix.has_value());
    if (node.matrix) add_numbers(hash, *node.matrix);
  }
  hash.add(std::uint64_t(character.bindings.size()));
  for (const BoneBinding& binding : character.bindings) {
    hash.add(binding.node);
    add_numbers(hash, binding.node_from_rest);
    add_numbers(hash, binding.origin_rest);
  }
  hash.add(std::uint64_t(character.skins.size()));
  for (const BoundSkin& skin : character.skins) {
    hash.add(skin.file_index);
    add_numbers(hash, skin.rest_from_mesh);
    hash.add_list(skin.bone);
  }
}

void add_clips(ContentHash& hash, const std::vector<Clip>& clips) {
  hash.add(std::uint64_t(clips.size()));
  for (const Clip& clip : clips) {
    hash.add(clip.name);
    hash.add(clip.duration_s);
    hash.add(std::uint64_t(clip.channels.size()));
    for (const Channel& channel : clip.channels) {
      hash.add(channel.node);
      hash.add(std::int32_t(channel.path));
      hash.add(std::int32_t(channel.interpolation));
      hash.add_list(channel.time_s);
      hash.add_list(channel.value);
    }
  }
}

void add(ContentHash& hash, const TextureUse& use) {
  hash.add(use.image);
  hash.add(use.uv_set);
  hash.add(use.wrap_u);
  hash.add(use.wrap_v);
  hash.add(use.nearest);
  hash.add_list(std::span<const float>(use.transform));
}

void add(ContentHash& hash, const Surface& surface) {
  add_numbers(hash, surface.base_colour);
  add_numbers(hash, surface.emission);
  add(hash, surface.base_colour_texture);
  add(hash, surface.emission_texture);
  hash.add(surface.alpha);
  hash.add(surface.alpha_cutoff);
}

}  // namespace

std::string content_hash(const ImportedCharacter& character) {
  const SkinnedMesh& mesh = character.mesh;
  ContentHash hash;
  hash.add(std::string_view("nook character 1"));
  hash.add_list(mesh.position);
  hash.add_list(mesh.weights);
  hash.add_list(mesh.triangle);
  hash.add_list(mesh.file_to_welded);
  hash.add(std::uint64_t(mesh.primitives.size()));
  for (const Primitive& primitive : mesh.primitives) {
    hash.add(primitive.mesh_name);
    hash.add(primitive.first_vertex);
    hash.add(primitive.vertex_count);
  }
  hash.add(std::uint64_t(mesh.bones.size()));
  add_skeleton(hash, character);
  hash.add_list(character.rest_from_primitive);
  hash.add_list(character.node_of_primitive);
  hash.add_list(character.mesh_position);
  add_clips(hash, character.clips);
  return hash.hex();
}

std::string content_hash(const SurfaceMesh& mesh) {
  ContentHash hash;
  hash.add(std::string_view("nook surface 1"));
  hash.add_list(mesh.position);
  hash.add_list(mesh.normal);
  hash.add_list(mesh.tangent);
  hash.add_list(mesh.uv);
  hash.add_list(mesh.triangle);
  return hash.hex();
}

std::string content_hash(const StaticScene& scene) {
  ContentHash hash;
  hash.add(std::string_view("nook scene 1"));
  hash.add_list(scene.position);
  hash.add_list(scene.triangle);
  hash.add(std::uint64_t(scene.surface.size()));
  for (const Surface& surface : scene.surface) add(hash, surface);
  hash.add_list(scene.triangle_surface);
  hash.add(std::uint64_t(scene.image.size()));
  for (const EncodedImage& image : scene.image) hash.add_list(image.bytes);
  hash.add_list(scene.uv);
  return hash.hex();
}

std::uint64_t short_hash(const std::string& hex) {
  return std::stoull(hex.substr(0, 16), nullptr, 16);
}

}  // namespace nook::bake
