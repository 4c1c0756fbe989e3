#include "bakers/character/export_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {
namespace {

// The smallest weight that a vertex keeps. It lets other casters darken vertices that have no self-shadow.
// The self-shadow from this weight is below one step of an 8-bit image.
constexpr float least_alpha = 1e-3f;

// Entries below this weight are dropped, unless they are anchors. Dropping an entry saves two bytes and
// changes AO by less than 1e-3.
constexpr float dropped_alpha = 4e-3f;

KeyPoint key_point_of(const FitState& state, std::size_t k) {
  const LayerStructure& structure = state.structure;
  const float* q = &state.parameters[structure.key_point_offset(k)];
  KeyPoint p;
  p.position = {q[0], q[1], q[2]};
  p.normal = normalised({q[3], q[4], q[5]});
  if (dot(p.normal, p.normal) == 0) p.normal = {0, 1, 0};
  float sum = 0;
  for (int j = 0; j < KeyPoint::max_bones; ++j) sum += q[6 + j] * q[6 + j];
  for (int j = 0; j < KeyPoint::max_bones; ++j) p.weight[j] = q[6 + j] * q[6 + j] / sum;
  p.bone = structure.key_point_bone[k];
  const float root = state.parameters[structure.saturation_offset(k)];
  p.saturation = root * root;
  return p;
}

// Among the key points that a vertex uses, returns the one whose surface position and normal are nearest to
// the given ones.
std::size_t nearest_key_point(const CharacterModel& model, std::size_t vertex, Vec3 position, Vec3 normal) {
  constexpr float metres_of_a_normal = 0.1f;
  std::size_t nearest = 0;
  float least = INFINITY;
  for (std::size_t s = vertex * model.influences; s < (vertex + 1) * model.influences; ++s) {
    if (model.alpha[s] == 0) continue;
    const KeyPoint& p = model.key_points[model.influence[s]];
    const Vec3 d = p.surface_position - position, turn = (p.surface_normal - normal) * metres_of_a_normal;
    const float distance = dot(d, d) + dot(turn, turn);
    if (distance < least) {
      least = distance;
      nearest = model.influence[s];
    }
  }
  return nearest;
}

// Sets the surface position and normal at which other casters darken each key point. K-means assigns each
// vertex to one of the key points that it uses, and each key point gets the mean of its vertices. The mean
// over all vertices that use a key point would lie inside the body and have a blurred normal.
void set_surface_frames(CharacterModel& model, const SkinnedMesh& mesh, std::span<const float> vertex_area,
                        std::span<const Vec3> vertex_normal) {
  for (KeyPoint& p : model.key_points) {
    p.surface_position = p.position;
    p.surface_normal = p.normal;
  }
  constexpr int rounds = 6;  // the error against ray tracing no longer changes after 4
  for (int r = 0; r < rounds; ++r) {
    std::vector<float> total(model.key_points.size(), 0.0f);
    std::vector<Vec3> position(total.size()), normal(total.size());
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      const std::size_t k = nearest_key_point(model, i, mesh.position[i], vertex_normal[i]);
      const float w = vertex_area[i] + 1e-9f;
      total[k] += w;
      position[k] += w * mesh.position[i];
      normal[k] += w * vertex_normal[i];
    }
    for (std::size_t k = 0; k < total.size(); ++k) {
      if (total[k] == 0) continue;
      KeyPoint& p = model.key_points[k];
      p.surface_position = position[k] * (1 / total[k]);
      const Vec3 n = normalised(normal[k]);
      if (dot(n, n) > 0) p.surface_normal = n;
    }
  }
}

}  // namespace

CharacterModel export_model(const FitState& state, const SkinnedMesh& mesh,
                            std::span<const float> vertex_area, std::span<const Vec3> vertex_normal,
                            std::span<const float> static_ao) {
  const LayerStructure& structure = state.structure;
  CharacterModel model;
  model.kernel = structure.kernel;
  for (const Bone& bone : mesh.bones) model.bone_names.emplace_back(bone.name);
  for (std::size_t h = 0; h < structure.sphere_count(); ++h) {
    const float* q = &state.parameters[structure.sphere_offset(h)];
    model.spheres.push_back({{q[0], q[1], q[2]}, std::exp(q[3]), structure.sphere_bone[h], 1.0f});
  }
  for (std::size_t k = 0; k < structure.key_point_count(); ++k)
    model.key_points.push_back(key_point_of(state, k));
  const LinearLayerFit& linear = state.linear;
  model.influences = std::uint32_t(linear.entries);
  model.influence.assign(linear.key_point.begin(), linear.key_point.end());
  model.alpha.assign(linear.alpha.begin(), linear.alpha.end());
  model.bias.assign(linear.bias.begin(), linear.bias.end());
  for (std::size_t s = 0; s < model.alpha.size(); ++s)
    if (model.alpha[s] < dropped_alpha && (linear.floor.empty() || linear.floor[s] == 0)) model.alpha[s] = 0;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    float* alpha = &model.alpha[i * model.influences];
    float* largest = std::max_element(alpha, alpha + model.influences);
    *largest = std::max(*largest, least_alpha);
  }
  model.static_ao.assign(static_ao.begin(), static_ao.end());
  model.file_to_welded.assign(mesh.file_to_welded.begin(), mesh.file_to_welded.end());
  for (const Primitive& p : mesh.primitives) model.primitives.push_back({p.first_vertex, p.vertex_count});

  Vec3 low = mesh.position.front(), high = low;
  for (Vec3 p : mesh.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  model.bounding_centre = 0.5f * (low + high);
  for (Vec3 p : mesh.position)
    model.bounding_radius = std::max(model.bounding_radius, length(p - model.bounding_centre));
  // Finds the bone that follows the body as a whole: the bone with the largest weight at the vertex nearest
  // to the centre of the bounding box.
  float nearest = INFINITY;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const float d = length(mesh.position[i] - model.bounding_centre);
    if (d < nearest) {
      nearest = d;
      model.root_bone = mesh.weights[i].bone[0];
    }
  }
  set_surface_frames(model, mesh, vertex_area, vertex_normal);
  return model;
}

FitState state_of_model(const CharacterModel& model) {
  FitState state;
  state.structure.kernel = model.kernel;
  for (const ProxySphere& s : model.spheres) {
    state.structure.sphere_bone.push_back(s.bone);
    state.parameters.insert(state.parameters.end(), {s.centre.x, s.centre.y, s.centre.z, std::log(s.radius)});
  }
  for (const KeyPoint& p : model.key_points) {
    state.structure.key_point_bone.push_back(p.bone);
    state.parameters.insert(state.parameters.end(),
                            {p.position.x, p.position.y, p.position.z, p.normal.x, p.normal.y, p.normal.z});
    for (float w : p.weight) state.parameters.push_back(std::sqrt(w));
    state.parameters.push_back(std::sqrt(p.saturation));
  }
  state.linear.entries = model.influences;
  state.linear.key_point.assign(model.influence.begin(), model.influence.end());
  state.linear.alpha.assign(model.alpha.begin(), model.alpha.end());
  state.linear.bias.assign(model.bias.begin(), model.bias.end());
  return state;
}

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

using Cell = std::array<std::int64_t, 3>;

struct CellVertices {
  std::uint32_t first = 0;
  // True if a vertex of the cell has another position, or other weights, than the cell's first vertex.
  bool has_other_places = false, has_other_weights = false;
};

// Tells whether the vertices near a vertex differ from it.
struct Neighbourhood {
  Cell cell{};
  bool has_other_places = false, has_other_weights = false;
};

// Looks at the grid cells around each vertex. The width of a cell is `share` times the diagonal of the mesh's
// bounding box.
std::vector<Neighbourhood> neighbourhoods(const SkinnedMesh& mesh, double share) {
  Vec3 low = mesh.position[0], high = low;
  for (const Vec3 p : mesh.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double size = std::max(share * static_cast<double>(length(high - low)), 1e-30);
  const auto number = [&](float from, float to) { return std::int64_t((double(to) - double(from)) / size); };
  const auto is_other_place = [&](std::uint32_t a, std::uint32_t b) {
    return mesh.position[a] != mesh.position[b];
  };
  std::map<Cell, CellVertices> cells;
  std::vector<Neighbourhood> out(mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.position[v];
    out[v].cell = {number(low.x, p.x), number(low.y, p.y), number(low.z, p.z)};
    CellVertices& cell = cells.try_emplace(out[v].cell, CellVertices{v}).first->second;
    cell.has_other_places = cell.has_other_places || is_other_place(v, cell.first);
    cell.has_other_weights = cell.has_other_weights || mesh.weights[v] != mesh.weights[cell.first];
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    for (std::int64_t n = 0; n < 27; ++n) {
      const Cell& own = out[v].cell;
      const auto found = cells.find({own[0] + n % 3 - 1, own[1] + n / 3 % 3 - 1, own[2] + n / 9 - 1});
      if (found == cells.end()) continue;
      const CellVertices& cell = found->second;
      out[v].has_other_places |= cell.has_other_places || is_other_place(v, cell.first);
      out[v].has_other_weights |= cell.has_other_weights || mesh.weights[v] != mesh.weights[cell.first];
    }
  return out;
}

// Marks each vertex with a neighbour that has other weights and is within the tolerance of
// nook_model_match_vertices. The match may confuse these two vertices, although they move apart in a pose.
std::vector<bool> ambiguous_vertices(const SkinnedMesh& mesh) {
  std::vector<bool> out;
  for (const Neighbourhood& n : neighbourhoods(mesh, 1e-4)) out.push_back(n.has_other_weights);
  return out;
}

BoneWeights weights_of(const SkinWeights& weights) {
  BoneWeights out;
  static_assert(SkinWeights::max_bones == BoneWeights::max_bones);
  while (out.count < BoneWeights::max_bones && weights.weight[out.count] > 0) ++out.count;
  std::copy_n(weights.bone.begin(), out.count, out.bone.begin());
  std::copy_n(weights.weight.begin(), out.count, out.weight.begin());
  return out;
}

// For each welded vertex, returns its first vertex in the file.
std::vector<std::uint32_t> first_file_vertices(const SkinnedMesh& mesh) {
  std::vector<std::uint32_t> first(mesh.vertex_count());
  for (std::uint32_t v = static_cast<std::uint32_t>(mesh.file_to_welded.size()); v-- > 0;)
    first[mesh.file_to_welded[v]] = v;
  return first;
}

// Adds the vertices that have other vertices close to them, in the order of their grid cells. Close means in
// the same cell or in an adjacent one. A vertex without close neighbours is at least two steps of a stored
// rest position away from all others, so its stored position alone identifies it.
void add_close_vertices(const ImportedCharacter& character, BindData& out) {
  const SkinnedMesh& mesh = character.mesh;
  const std::vector<Neighbourhood> around = neighbourhoods(mesh, 2.0 / 65535);
  std::vector<std::uint32_t> close;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    if (around[v].has_other_places || around[v].has_other_weights) close.push_back(v);
  std::ranges::stable_sort(close, {}, [&](std::uint32_t v) { return around[v].cell; });
  const std::vector<std::uint32_t> first = first_file_vertices(mesh);
  for (const std::uint32_t v : close) {
    CloseVertex vertex;
    vertex.welded = v;
    const auto after = std::ranges::upper_bound(mesh.primitives, first[v], {}, &Primitive::first_vertex);
    vertex.space = out.primitive_space[std::size_t(after - mesh.primitives.begin()) - 1];
    vertex.mesh_position =
        character.mesh_position.empty() ? mesh.position[v] : character.mesh_position[first[v]];
    if (around[v].has_other_weights) vertex.weights = weights_of(mesh.weights[v]);
    out.close.push_back(vertex);
  }
}

// For each bone, returns the vertices that it moves more than any other bone does. Leaves out ambiguous
// vertices, unless all are ambiguous.
std::vector<std::vector<std::uint32_t>> vertices_of_bones(const SkinnedMesh& mesh) {
  std::vector<bool> left_out = ambiguous_vertices(mesh);
  if (std::ranges::find(left_out, false) == left_out.end()) left_out.assign(left_out.size(), false);
  std::vector<std::vector<std::uint32_t>> out(mesh.bones.size());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    if (!left_out[v]) out[mesh.weights[v].bone[0]].push_back(v);
  return out;
}

// Returns the vertex that tells most about its bone's motion. It has a large weight and is far from `known`.
std::uint32_t clearest(const SkinnedMesh& mesh, const std::vector<std::uint32_t>& vertices, Vec3 known) {
  const auto clarity = [&](std::uint32_t v) {
    const float weight = mesh.weights[v].weight[0];
    return weight * weight * (0.02f + length(mesh.position[v] - known));
  };
  return *std::ranges::max_element(vertices, {}, clarity);
}

// First takes the best vertex of each bone, in the order of the bones' vertex counts. Then takes a second
// vertex of each bone.
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
  add_close_vertices(character, out);
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
