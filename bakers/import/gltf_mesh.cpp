#include "bakers/import/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bakers/import/accessor.h"
#include "bakers/import/fronts.h"
#include "bakers/import/shown_primitives.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {

std::vector<double> default_morph_weights(const tinygltf::Mesh& mesh, const tinygltf::Node& node) {
  const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
  const bool all_zero = std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; });
  return all_zero ? std::vector<double>() : weights;
}

namespace {

// Limits the targets with a weight other than 0. Each is read for up to 10 million vertices, and accessors
// may share their bytes, so a small file could take very long.
constexpr std::size_t max_targets_at_work = 256;

}  // namespace

void refuse_many_primitives(std::size_t count) {
  constexpr std::size_t most = std::size_t{1} << 20;
  if (count > most)
    throw Failure(NOOK_ERROR_BAD_FILE, "the nodes show more than %zu primitives; join meshes", most);
}

void add_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                       const std::vector<double>& weights, const std::string& what,
                       std::vector<float>& position) {
  if (weights.size() > primitive.targets.size())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has %zu morph targets but %zu default weights (need at most one for each target)",
                  what.c_str(), primitive.targets.size(), weights.size());
  const auto at_work =
      std::size_t(std::count_if(weights.begin(), weights.end(), [](double weight) { return weight != 0; }));
  if (at_work > max_targets_at_work)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has %zu morph targets with default weights other than 0 (need "
                  "at most %zu); apply the targets to the mesh",
                  what.c_str(), at_work, max_targets_at_work);
  for (std::size_t t = 0; t < weights.size(); ++t) {
    if (weights[t] == 0) continue;
    const std::string target = what + " morph target " + std::to_string(t);
    if (!std::isfinite(weights[t]))
      throw Failure(NOOK_ERROR_BAD_FILE, "%s has a default weight that is not finite", target.c_str());
    const auto accessor = primitive.targets[t].find("POSITION");
    if (accessor == primitive.targets[t].end()) continue;
    const std::size_t count = element_count(model, accessor->second, target);
    if (count != position.size() / 3)
      throw Failure(NOOK_ERROR_BAD_FILE, "%s moves %zu vertices, but the primitive has %zu", target.c_str(),
                    count, position.size() / 3);
    const Floats moved = read_floats(model, accessor->second, 3, target);
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] += static_cast<float>(weights[t] * static_cast<double>(moved.value[i]));
  }
}

namespace {

// The file may give 64 joints per vertex, and SkinWeights::max_bones of them are kept. The joints of one
// primitive may take a GiB of memory.
constexpr std::size_t max_influence_sets = 16, max_influence_elements = std::size_t{1} << 25;

// The joints and weights of one primitive: JOINTS_0, JOINTS_1 and so on.
struct Influences {
  std::vector<Integers> joint;
  std::vector<Floats> weight;
};

// Counts the sets of joints and weights, which are numbered from 0. Does not read them.
std::size_t count_influence_sets(const tinygltf::Primitive& primitive, const std::string& what) {
  for (std::size_t set = 0;; ++set) {
    const bool joints = attribute(primitive, "JOINTS_" + std::to_string(set)) >= 0;
    const bool weights = attribute(primitive, "WEIGHTS_" + std::to_string(set)) >= 0;
    if (!joints && !weights) return set;
    if (!joints || !weights)
      throw Failure(NOOK_ERROR_BAD_FILE, "%s has only one of JOINTS_%zu and WEIGHTS_%zu (need both)",
                    what.c_str(), set, set);
  }
}

Influences read_influences(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           std::size_t vertices, const std::string& what) {
  const std::size_t sets = count_influence_sets(primitive, what);
  if (sets == 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has a skin but no JOINTS_0 and WEIGHTS_0; export the mesh with its weights",
                  what.c_str());
  if (sets > max_influence_sets || sets * vertices > max_influence_elements)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s has too many joints: %zu sets of joints and weights for %zu vertices (need at most %zu "
                  "sets, and at most %zu elements in all sets together)",
                  what.c_str(), sets, vertices, max_influence_sets, max_influence_elements);
  Influences out;
  for (std::size_t set = 0; set < sets; ++set) {
    const std::string joints = "JOINTS_" + std::to_string(set), weights = "WEIGHTS_" + std::to_string(set);
    const int joint_accessor = attribute(primitive, joints), weight_accessor = attribute(primitive, weights);
    const std::size_t joint_count = element_count(model, joint_accessor, what + "." + joints);
    const std::size_t weight_count = element_count(model, weight_accessor, what + "." + weights);
    if (joint_count != vertices || weight_count != vertices)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s has %zu joints and %zu weights for %zu vertices (need the same number)", what.c_str(),
                    joint_count, weight_count, vertices);
    out.joint.push_back(read_integers(model, joint_accessor, 4, what + "." + joints));
    out.weight.push_back(read_floats(model, weight_accessor, 4, what + "." + weights));
  }
  return out;
}

// Returns the bone of JOINTS_0.x for a vertex without weights. If the artist did not paint a vertex,
// exporters write no weights for it. JOINTS_0.x then names the joint that the vertex would follow, or the
// root.
std::uint16_t first_bone(const Influences& influences, const MeshBinding& binding, std::size_t vertex,
                         const std::string& what) {
  const std::uint32_t joint = influences.joint[0].value[4 * vertex];
  if (joint >= binding.bone.size())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s: vertex %zu has no weights and refers to joint %u, but the skin has only %zu",
                  what.c_str(), vertex, joint, binding.bone.size());
  return binding.bone[joint];
}

[[noreturn]] void refuse_weight(const std::string& what, std::size_t vertex) {
  throw Failure(NOOK_ERROR_BAD_FILE, "%s: vertex %zu has a weight that is not finite", what.c_str(), vertex);
}

void append_skin_weights(const Influences& influences, const MeshBinding& binding, std::size_t vertices,
                         const std::string& what, FileMesh& out, MeshRepairs& repairs) {
  std::vector<std::pair<std::uint16_t, float>> of_vertex;
  for (std::size_t v = 0; v < vertices; ++v) {
    of_vertex.clear();
    double sum = 0;
    std::size_t positive = 0;
    bool has_nan = false;
    for (std::size_t set = 0; set < influences.joint.size(); ++set)
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t joint = influences.joint[set].value[4 * v + k];
        const float weight = influences.weight[set].value[4 * v + k];
        if (std::isnan(weight)) {
          has_nan = true;
          continue;
        }
        if (!std::isfinite(weight)) refuse_weight(what, v);
        // A slot with weight 0 may refer to any joint.
        if (weight == 0) continue;
        if (weight < 0) {
          ++repairs.negative_weights;
          continue;
        }
        if (joint >= binding.bone.size())
          throw Failure(NOOK_ERROR_BAD_FILE, "%s: vertex %zu refers to joint %u, but the skin has only %zu",
                        what.c_str(), v, joint, binding.bone.size());
        of_vertex.push_back({binding.bone[joint], weight});
        sum += weight;
        ++positive;
      }
    ++repairs.skinned;
    // Some exporters divide weights by their sum. They write NaN if all weights of a vertex are 0.
    if (has_nan && positive > 0) refuse_weight(what, v);
    if (positive == 0) {
      ++repairs.without_weights;
      of_vertex.push_back({first_bone(influences, binding, v, what), 1.0f});
    }
    // Exporters round weights to bytes or shorts. For four weights, this changes the sum by at most 2/255.
    if (positive > 0 && std::abs(sum - 1) > 0.01) {
      ++repairs.sums_not_one;
      if (std::abs(sum - 1) > std::abs(repairs.worst_sum - 1)) repairs.worst_sum = sum;
    }
    if (positive > SkinWeights::max_bones) ++repairs.too_many_bones;
    out.weights.push_back(make_weights(of_vertex));
  }
}

// The data that all primitives of a mesh share.
struct MeshSource {
  std::string name;
  const MeshBinding& binding;
  bool is_skinned, node_mirrors;
  std::vector<double> morph_weights;
};

void append_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                      const std::string& what, const MeshSource& source, FileMesh& out,
                      MeshRepairs& repairs) {
  const MeshBinding& binding = source.binding;
  if (!has_triangles(primitive)) {
    ++repairs.not_triangles;
    return;
  }
  const int position_accessor = attribute(primitive, "POSITION");
  if (position_accessor < 0) throw Failure(NOOK_ERROR_BAD_FILE, "%s has no POSITION", what.c_str());
  const std::size_t first = out.position.size();
  if (element_count(model, position_accessor, what + ".POSITION") > max_file_vertices - first)
    throw Failure(NOOK_ERROR_BAD_FILE, "too many vertices (need at most %zu)", max_file_vertices);
  Floats position = read_floats(model, position_accessor, 3, what + ".POSITION");
  add_morph_targets(model, primitive, source.morph_weights, what, position.value);

  const std::size_t first_triangle = out.triangle.size();
  append_triangles(model, primitive, position.count, what, out.triangle);
  const std::vector<float> normal = read_normals(model, primitive, position.count, what);
  const bool turns = turns_round({position.value, normal, std::span(out.triangle).subspan(first_triangle)},
                                 binding.rest_from_mesh, source.node_mirrors);
  for (std::size_t t = first_triangle; t < out.triangle.size(); ++t) {
    for (std::uint32_t& i : out.triangle[t]) i += static_cast<std::uint32_t>(first);
    if (turns) std::swap(out.triangle[t][1], out.triangle[t][2]);
  }

  for (std::size_t v = 0; v < position.count; ++v) {
    out.mesh_position.push_back(
        {position.value[3 * v], position.value[3 * v + 1], position.value[3 * v + 2]});
    out.position.push_back(transform(binding.rest_from_mesh, out.mesh_position.back()));
  }
  if (source.is_skinned) {
    append_skin_weights(read_influences(model, primitive, position.count, what), binding, position.count,
                        what, out, repairs);
  } else {
    const std::pair<std::uint16_t, float> rigid{binding.bone[0], 1.0f};
    out.weights.resize(out.position.size(), make_weights({&rigid, 1}));
  }
  out.primitives.push_back(
      {source.name, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(position.count)});
}

}  // namespace

void append_mesh(const tinygltf::Model& model, const PlacedMesh& placed, FileMesh& out,
                 MeshRepairs& repairs) {
  const tinygltf::Node& node = placed.node;
  const bool is_skinned = node.skin >= 0;
  // A rigid part moves with its node, so its transform to rest space mirrors if the node mirrors.
  const bool node_mirrors = is_skinned ? placed.node_mirrors : determinant(placed.binding.rest_from_mesh) < 0;
  const tinygltf::Mesh& mesh = model.meshes[node.mesh];
  const std::string name = mesh.name.empty() ? "mesh_" + std::to_string(node.mesh) : mesh.name;
  const MeshSource source{name, placed.binding, is_skinned, node_mirrors, default_morph_weights(mesh, node)};
  repairs.primitives += mesh.primitives.size();
  refuse_many_primitives(repairs.primitives);
  if (!source.morph_weights.empty()) ++repairs.morphed;
  if (std::ranges::any_of(mesh.primitives, [](const tinygltf::Primitive& p) { return !p.targets.empty(); }))
    ++repairs.with_targets;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
    append_primitive(model, mesh.primitives[p], "mesh \"" + name + "\" primitive " + std::to_string(p),
                     source, out, repairs);
}

void add_warnings(const MeshRepairs& repairs, std::vector<std::string>& warnings) {
  // Uses integers: at most one vertex in a hundred.
  if (repairs.without_weights > repairs.skinned / 100)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "%zu of %zu skinned vertices have no weights (need at most 1 %%); weight them in the modelling "
        "tool, for example by \"Normalize All\" and \"Limit Total\" in Blender, and export again",
        repairs.without_weights, repairs.skinned);
  if (repairs.without_weights > 0)
    warnings.push_back(std::to_string(repairs.without_weights) + " of " + std::to_string(repairs.skinned) +
                       " skinned vertices have no weights; each follows only its first joint");
  char text[200];
  if (repairs.sums_not_one > 0) {
    std::snprintf(
        text, sizeof text,
        "%zu vertices have weights that do not add up to 1 (worst sum %g); the weights were normalised",
        repairs.sums_not_one, repairs.worst_sum);
    warnings.push_back(text);
  }
  if (repairs.negative_weights > 0)
    warnings.push_back(std::to_string(repairs.negative_weights) + " negative weights were taken as 0");
  if (repairs.too_many_bones > 0)
    warnings.push_back(std::to_string(repairs.too_many_bones) + " vertices have more than " +
                       std::to_string(SkinWeights::max_bones) + " bones; the smallest weights were dropped");
  if (repairs.with_targets > 0)
    warnings.push_back(
        std::to_string(repairs.with_targets) +
        " meshes have morph targets; AO follows the bones, but ignores changes of the morph weights");
  if (repairs.morphed > 0)
    warnings.push_back(std::to_string(repairs.morphed) +
                       " meshes have morph targets with default weights; the rest pose includes them");
  if (repairs.not_triangles > 0)
    warnings.push_back(std::to_string(repairs.not_triangles) +
                       " primitives of points or lines were left out");
}

}  // namespace nook::bake
