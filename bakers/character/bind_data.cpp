#include "bakers/character/bind_data.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bakers/import/skinning.h"

namespace nook::bake {
namespace {

void add_bones(const ImportedCharacter& character, BindData& out) {
  for (std::size_t b = 0; b < character.mesh.bones.size(); ++b) {
    BoneBind bone;
    bone.first_of_joint = static_cast<std::uint16_t>(b);
    if (character.bindings.empty()) {
      bone.node_from_rest = to_float(inverse(to_double(character.mesh.bones[b].frame_rest)));
    } else {
      bone.node_from_rest = to_float(character.bindings[b].node_from_rest);
      for (std::size_t first = 0; first < b; ++first)
        if (character.bindings[first].node == character.bindings[b].node) {
          bone.first_of_joint = static_cast<std::uint16_t>(first);
          break;
        }
    }
    out.bones.push_back(bone);
  }
}

std::uint16_t space_of(const Affine& rest_from_mesh, BindData& out) {
  const Mat3x4 matrix = to_float(rest_from_mesh);
  for (std::size_t s = 0; s < out.rest_from_mesh.size(); ++s)
    if (std::equal(matrix.m, matrix.m + 12, out.rest_from_mesh[s].m)) return static_cast<std::uint16_t>(s);
  out.rest_from_mesh.push_back(matrix);
  return static_cast<std::uint16_t>(out.rest_from_mesh.size() - 1);
}

void add_skins(const ImportedCharacter& character, BindData& out) {
  for (std::size_t p = 0; p < character.mesh.primitives.size(); ++p)
    out.primitive_space.push_back(space_of(
        p < character.rest_from_primitive.size() ? character.rest_from_primitive[p] : Affine{}, out));
  for (const BoundSkin& source : character.skins) {
    SkinBind skin;
    skin.file_index = source.file_index;
    skin.space = space_of(source.rest_from_mesh, out);
    skin.first_joint = static_cast<std::uint32_t>(out.bone_of_joint.size());
    skin.joint_count = static_cast<std::uint32_t>(source.bone.size());
    out.bone_of_joint.insert(out.bone_of_joint.end(), source.bone.begin(), source.bone.end());
    out.skins.push_back(skin);
  }
}

// The vertices that each bone moves more than any other bone does.
std::vector<std::vector<std::uint32_t>> vertices_of_bones(const SkinnedMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> out(mesh.bones.size());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) out[mesh.weights[v].bone[0]].push_back(v);
  return out;
}

// The vertex that tells most about its bone: a large weight far from what is known already.
std::uint32_t clearest(const SkinnedMesh& mesh, const std::vector<std::uint32_t>& vertices, Vec3 known) {
  const auto clarity = [&](std::uint32_t v) {
    const float weight = mesh.weights[v].weight[0];
    return weight * weight * (0.02f + length(mesh.position[v] - known));
  };
  return *std::ranges::max_element(vertices, {}, clarity);
}

// First the clearest vertex of each bone, from the bones with most vertices on, then a second one of each.
std::vector<std::uint32_t> spread_vertices(const SkinnedMesh& mesh) {
  const auto vertices = vertices_of_bones(mesh);
  std::vector<std::uint32_t> bones(mesh.bones.size());
  std::iota(bones.begin(), bones.end(), 0u);
  std::ranges::stable_sort(bones, std::greater{}, [&](std::uint32_t b) { return vertices[b].size(); });
  std::vector<std::uint32_t> chosen, first(mesh.bones.size());
  for (int round = 0; round < 2; ++round)
    for (const std::uint32_t bone : bones) {
      if (vertices[bone].empty() || chosen.size() == BindData::max_vertices) continue;
      const Mat3x4& frame = mesh.bones[bone].frame_rest;
      const Vec3 joint{frame.m[3], frame.m[7], frame.m[11]};
      const std::uint32_t vertex = clearest(mesh, vertices[bone], round ? mesh.position[first[bone]] : joint);
      if (round && vertex == first[bone]) continue;
      first[bone] = vertex;
      chosen.push_back(vertex);
    }
  return chosen;
}

RestVertex rest_vertex(const SkinnedMesh& mesh, std::uint32_t vertex) {
  RestVertex out;
  const auto file = std::ranges::find(mesh.file_to_welded, vertex);
  out.file_vertex = static_cast<std::uint32_t>(file - mesh.file_to_welded.begin());
  out.position = mesh.position[vertex];
  const SkinWeights& weights = mesh.weights[vertex];
  static_assert(SkinWeights::max_bones == RestVertex::max_bones);
  while (out.bone_count < RestVertex::max_bones && weights.weight[out.bone_count] > 0) ++out.bone_count;
  std::copy_n(weights.bone.begin(), out.bone_count, out.bone.begin());
  std::copy_n(weights.weight.begin(), out.bone_count, out.weight.begin());
  return out;
}

}  // namespace

BindData bind_data_of(const ImportedCharacter& character) {
  BindData out;
  add_bones(character, out);
  add_skins(character, out);
  for (const std::uint32_t vertex : spread_vertices(character.mesh))
    out.vertices.push_back(rest_vertex(character.mesh, vertex));
  return out;
}

RestSurface rest_surface_of(const SkinnedMesh& mesh) {
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, mesh.position, normal);
  RestSurface out;
  out.position.assign(mesh.position.begin(), mesh.position.end());
  out.normal.assign(normal.begin(), normal.end());
  return out;
}

}  // namespace nook::bake
