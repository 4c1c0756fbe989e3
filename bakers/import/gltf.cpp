#include "bakers/import/gltf.h"

#include <algorithm>
#include <cstdio>
#include <span>

#include "bakers/import/accessor.h"
#include "bakers/import/coincident_surfaces.h"
#include "bakers/import/content_hash.h"
#include "bakers/import/file_reader.h"
#include "bakers/import/fronts.h"
#include "bakers/import/gltf_check.h"
#include "bakers/import/gltf_clips.h"
#include "bakers/import/gltf_document.h"
#include "bakers/import/gltf_mesh.h"
#include "bakers/import/gltf_skeleton.h"
#include "bakers/import/shown_nodes.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

Skin read_skin(const tinygltf::Model& model, int index, const NodeTree& nodes,
               std::vector<std::string>& warnings) {
  const tinygltf::Skin& source = model.skins[index];
  const std::string what = "skin " + std::to_string(index);
  if (source.joints.empty()) throw Failure(NOOK_ERROR_BAD_FILE, "%s has no joints", what.c_str());
  if (source.joints.size() > max_bone_count)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has too many joints (got %zu, need at most %zu)", what.c_str(),
                  source.joints.size(), max_bone_count);
  Skin skin;
  for (const int joint : source.joints) {
    if (joint < 0 || static_cast<std::size_t>(joint) >= nodes.size())
      throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to node %d as a joint, but the file has only %zu nodes",
                    what.c_str(), joint, nodes.size());
    skin.joint.push_back(static_cast<std::uint32_t>(joint));
  }
  std::vector<std::uint32_t> sorted = skin.joint;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    warnings.push_back(what + " lists joint node " + std::to_string(*twice) +
                       " twice, which glTF forbids; both entries follow this node");
  // Without the accessor, all matrices are the identity (glTF 2.0, section 3.7.3.1).
  skin.inverse_bind.resize(skin.joint.size());
  if (source.inverseBindMatrices < 0) return skin;
  const std::string matrices_name = what + " inverse bind matrices";
  const std::size_t count = element_count(model, source.inverseBindMatrices, matrices_name);
  if (count < skin.joint.size() || count > max_bone_count)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has %zu inverse bind matrices for %zu joints (need one for each joint)", what.c_str(),
                  count, skin.joint.size());
  const Floats matrices =
      read_floats(model, source.inverseBindMatrices, 16, matrices_name, skin.joint.size());
  for (std::size_t j = 0; j < skin.joint.size(); ++j) {
    std::array<double, 16> columns;
    std::copy_n(matrices.value.begin() + 16 * j, 16, columns.begin());
    skin.inverse_bind[j] = from_columns(columns.data());
  }
  return skin;
}

std::vector<bool> animated_nodes(const std::vector<Clip>& clips, std::size_t node_count) {
  std::vector<bool> moves(node_count, false);
  for (const Clip& clip : clips)
    for (const Channel& channel : clip.channels) moves[channel.node] = true;
  return moves;
}

// A mesh node that the scene shows, and the index of its binding in the skeleton.
struct MeshNode {
  std::uint32_t node = 0;
  bool is_skinned = false;
  std::size_t binding = 0;  // index into Skeleton::skins or rigid_parts
};

struct MeshNodes {
  std::vector<MeshNode> all;              // in the file's node order
  std::vector<Skin> skins;                // only those in use
  std::vector<std::uint32_t> file_skins;  // indices of these skins in the file
  std::vector<std::uint32_t> rigid_nodes;
};

MeshNodes find_mesh_nodes(const tinygltf::Model& model, const NodeTree& nodes, const ShownNodes& shown,
                          std::vector<std::string>& warnings) {
  MeshNodes out;
  std::vector<std::int64_t> place_of_skin(model.skins.size(), -1);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const int skin = model.nodes[i].skin;
    if (!shown.shows(i)) continue;
    if (skin < 0) {
      out.all.push_back({i, false, out.rigid_nodes.size()});
      out.rigid_nodes.push_back(i);
      continue;
    }
    if (static_cast<std::size_t>(skin) >= model.skins.size())
      throw Failure(NOOK_ERROR_BAD_FILE, "node %u refers to skin %d, but the file has only %zu", i, skin,
                    model.skins.size());
    if (place_of_skin[skin] < 0) {
      place_of_skin[skin] = static_cast<std::int64_t>(out.skins.size());
      out.skins.push_back(read_skin(model, skin, nodes, warnings));
      out.file_skins.push_back(static_cast<std::uint32_t>(skin));
    }
    out.all.push_back({i, true, static_cast<std::size_t>(place_of_skin[skin])});
  }
  if (out.all.empty()) throw Failure(NOOK_ERROR_BAD_FILE, "no triangles: the scene shows no mesh");
  return out;
}

// Limits the total number of nodes and bones over all sampled poses. Otherwise, the time would grow with
// clips * nodes. Usual characters with thousands of clips stay below this limit.
constexpr std::size_t max_checked_matrices = std::size_t{1} << 24;

// Warns of bones that a clip shears or scales unevenly. Their matrices are replaced by the nearest
// similarity.
void warn_of_uneven_bones(ImportedCharacter& character) {
  constexpr int samples = 8;
  constexpr double tolerance = 1e-3;
  std::vector<double> worst(character.bindings.size(), 0.0);
  std::vector<double> deviation;
  const auto look = [&](const std::vector<Trs>& locals) {
    bone_matrices(character, locals, &deviation);
    for (std::size_t b = 0; b < worst.size(); ++b) worst[b] = std::max(worst[b], deviation[b]);
  };
  look(default_locals(character.nodes));
  std::size_t left = max_checked_matrices, unchecked = 0;
  for (const Clip& clip : character.clips) {
    const std::size_t cost = samples * (character.nodes.size() + worst.size());
    if (cost > left) {
      ++unchecked;
      continue;
    }
    left -= cost;
    for (int i = 0; i < samples; ++i) {
      std::vector<Trs> locals = default_locals(character.nodes);
      apply_clip(clip, clip.duration_s * static_cast<float>(i) / (samples - 1), locals);
      look(locals);
    }
  }
  if (unchecked > 0)
    character.warnings.push_back(
        std::to_string(unchecked) +
        " clips were not checked for shear and uneven scale, because the file has too many clips");
  for (std::size_t b = 0; b < worst.size(); ++b) {
    if (worst[b] <= tolerance) continue;
    char percent[32];
    std::snprintf(percent, sizeof percent, "%.2g", 100 * worst[b]);
    character.warnings.push_back("bone \"" + character.mesh.bones[b].name +
                                 "\" is sheared or scaled unevenly by the default pose or a clip, by up to " +
                                 percent + " %; the nearest rotation with one scale is used");
  }
}

// The length unit of glTF is the metre, but some exporters write other units.
void warn_of_size(const SkinnedMesh& mesh, std::vector<std::string>& warnings) {
  Vec3 low = mesh.position[0];
  Vec3 high = low;
  for (const Vec3 p : mesh.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const float diagonal = length(high - low);
  if (diagonal > 0.05f && diagonal < 20) return;
  char text[120];
  std::snprintf(text, sizeof text, "the rest pose is %.3g m across; the unit of the file may not be metres",
                static_cast<double>(diagonal));
  warnings.push_back(text);
}

// If no mesh has a skin and no clip moves a mesh, the file is a prop. Each root of its meshes becomes a bone.
Skeleton skeleton_of(ImportedCharacter& character, const MeshNodes& mesh_nodes) {
  const NodeTree& nodes = character.nodes;
  std::vector<bool> moves = animated_nodes(character.clips, nodes.size());
  Skeleton skeleton = build_skeleton(nodes, mesh_nodes.skins, moves, mesh_nodes.rigid_nodes);
  if (!skeleton.bones.empty()) return skeleton;
  for (std::uint32_t node : mesh_nodes.rigid_nodes) {
    while (nodes.nodes[node].parent >= 0) node = static_cast<std::uint32_t>(nodes.nodes[node].parent);
    moves[node] = true;
  }
  skeleton = build_skeleton(nodes, mesh_nodes.skins, moves, mesh_nodes.rigid_nodes);
  character.warnings.push_back(
      "no mesh has a skin and no clip moves a mesh, so the file was read as a rigid prop with " +
      std::to_string(skeleton.bones.size()) + " bones");
  return skeleton;
}

// The triangles of primitives in file order.
SurfaceParts parts_of(const FileMesh& file, const std::vector<std::uint32_t>& node_of_primitive) {
  SurfaceParts parts;
  std::size_t end = 0;
  std::uint32_t of_node = 0;
  for (std::size_t p = 0; p < file.primitives.size(); ++p) {
    const std::size_t end_vertex = file.primitives[p].first_vertex + file.primitives[p].vertex_count;
    while (end < file.triangle.size() && file.triangle[end][0] < end_vertex) ++end;
    of_node = p > 0 && node_of_primitive[p] == node_of_primitive[p - 1] ? of_node + 1 : 0;
    parts.all.push_back({node_of_primitive[p], of_node, end});
  }
  return parts;
}

// The meshes of all nodes, one after another.
void append_meshes(const tinygltf::Model& model, const MeshNodes& mesh_nodes, const Skeleton& skeleton,
                   ImportedCharacter& character, FileMesh& file) {
  MeshRepairs repairs;
  const std::vector<Affine> world = default_world_transforms(character.nodes);
  for (const MeshNode& at : mesh_nodes.all) {
    MeshBinding binding = at.is_skinned ? skeleton.skins[at.binding] : skeleton.rigid_parts[at.binding];
    if (binding.bone.empty()) {
      character.warnings.push_back("mesh node \"" + character.nodes.nodes[at.node].name +
                                   "\" has no skin and follows no joint, so it was left out");
      continue;
    }
    const Affine rest_from_node = binding.rest_from_mesh;
    for (const Affine& instance : mesh_instances(model, at.node)) {
      binding.rest_from_mesh = rest_from_node * instance;
      append_mesh(model, {model.nodes[at.node], binding, determinant(world[at.node]) < 0}, file, repairs);
      character.rest_from_primitive.resize(file.primitives.size(), binding.rest_from_mesh);
      character.node_of_primitive.resize(file.primitives.size(), at.node);
    }
  }
  add_warnings(repairs, character.warnings);
}

ImportedCharacter import_bytes(std::span<const std::byte> bytes, const FileAccess& files,
                               const MeshSelection& selection) {
  const tinygltf::Model model = parse_gltf(bytes, files);
  ImportedCharacter character;
  character.nodes = read_nodes(model);
  character.warnings = document_warnings(model);
  character.clips = read_clips(model, character.nodes, character.warnings);

  const ShownNodes shown = choose_nodes(model, character.nodes, selection);
  character.warnings.insert(character.warnings.end(), shown.notes.begin(), shown.notes.end());
  const MeshNodes mesh_nodes = find_mesh_nodes(model, character.nodes, shown, character.warnings);
  Skeleton skeleton = skeleton_of(character, mesh_nodes);

  FileMesh file;
  append_meshes(model, mesh_nodes, skeleton, character, file);
  const SurfaceParts parts = parts_of(file, character.node_of_primitive);
  const std::vector<OutlineHull> hulls =
      warn_of_close_surfaces(model, parts, file.position, file.triangle, character.warnings);
  warn_of_inside_out_parts(model, parts, file.position, file.triangle, hulls, character.warnings);
  for (std::size_t s = 0; s < skeleton.skins.size(); ++s)
    character.skins.push_back(
        {mesh_nodes.file_skins[s], skeleton.skins[s].rest_from_mesh, std::move(skeleton.skins[s].bone)});
  file.bones = std::move(skeleton.bones);
  character.bindings = std::move(skeleton.bindings);
  character.mesh_position = std::move(file.mesh_position);
  character.mesh = weld(std::move(file), character.warnings, NOOK_ERROR_BAD_FILE);
  warn_of_size(character.mesh, character.warnings);
  warn_of_uneven_bones(character);
  character.source_hash = short_hash(content_hash(character));
  return character;
}

}  // namespace

ImportedCharacter import_gltf(const std::filesystem::path& path, const ImportOptions& options) {
  return import_bytes(read_file_bytes(path),
                      {std::filesystem::absolute(path).parent_path().string(), options.linked},
                      options.meshes);
}

ImportedCharacter import_gltf(std::span<const std::byte> bytes, const MeshSelection& meshes) {
  return import_bytes(bytes, {}, meshes);
}

}  // namespace nook::bake
