#include <algorithm>
#include <cmath>

#include "core/failure.h"
#include "import/accessor.h"
#include "import/gltf_parts.h"
#include "import/validate.h"

namespace nook::bake {
namespace {

// Triangles of lists, strips and fans; points and lines give none.
std::vector<std::array<std::uint32_t, 3>> assemble(const std::vector<std::uint32_t>& index, int mode) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES || mode == -1) {
    for (std::size_t i = 0; i + 2 < index.size(); i += 3) triangles.push_back({index[i], index[i + 1], index[i + 2]});
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t i = 0; i + 2 < index.size(); ++i)
      triangles.push_back({index[i], index[i + 1 + i % 2], index[i + 2 - i % 2]});
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (std::size_t i = 1; i + 1 < index.size(); ++i) triangles.push_back({index[0], index[i], index[i + 1]});
  }
  return triangles;
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

// Skin weights of a primitive's vertices: JOINTS_0/WEIGHTS_0, JOINTS_1/WEIGHTS_1, ...
std::vector<SkinWeights> read_weights(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                      const std::vector<std::uint16_t>& joint_bone, std::size_t count,
                                      const std::string& what) {
  std::vector<std::vector<std::pair<std::uint16_t, float>>> influences(count);
  for (int set = 0;; ++set) {
    const int joints_at = attribute(primitive, "JOINTS_" + std::to_string(set));
    const int weights_at = attribute(primitive, "WEIGHTS_" + std::to_string(set));
    if (joints_at < 0 || weights_at < 0) {
      if (set == 0) throw Failure(NOOK_ERROR_BAD_FILE, "%s: skinned, but without JOINTS_0 and WEIGHTS_0", what.c_str());
      break;
    }
    const Integers joints = read_integers(model, joints_at, 4, what + " joints");
    const Floats weights = read_floats(model, weights_at, 4, what + " weights");
    if (joints.count != count || weights.count != count)
      throw Failure(NOOK_ERROR_BAD_FILE, "%s: %zu joints and %zu weights for %zu positions", what.c_str(), joints.count,
                    weights.count, count);
    for (std::size_t v = 0; v < count; ++v)
      for (std::size_t i = 4 * v; i < 4 * v + 4; ++i) {
        const float w = weights.value[i];
        if (!std::isfinite(w)) throw Failure(NOOK_ERROR_BAD_FILE, "%s: weight of vertex %zu is not finite", what.c_str(), v);
        if (w <= 0) continue;
        if (joints.value[i] >= joint_bone.size())
          throw Failure(NOOK_ERROR_BAD_FILE, "%s: vertex %zu names joint %u (the skin has %zu)", what.c_str(), v,
                        joints.value[i], joint_bone.size());
        influences[v].push_back({joint_bone[joints.value[i]], w});
      }
  }
  std::vector<SkinWeights> result(count);
  for (std::size_t v = 0; v < count; ++v) result[v] = make_weights(influences[v]);
  return result;
}

}  // namespace

FileMesh read_meshes(const tinygltf::Model& model, const NodeTree& nodes, const Skeleton& skeleton,
                     std::vector<std::string>& warnings) {
  const std::vector<Affine> world = default_world_transforms(nodes);
  FileMesh mesh;
  std::size_t corners_lost = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const tinygltf::Node& node = model.nodes[n];
    if (node.mesh < 0 || (node.skin < 0 && skeleton.rigid_bone[n] < 0)) continue;
    if (std::size_t(node.mesh) >= model.meshes.size())
      throw Failure(NOOK_ERROR_BAD_FILE, "node \"%s\": mesh %d does not exist", nodes.nodes[n].name.c_str(), node.mesh);
    if (node.skin >= 0 && std::size_t(node.skin) >= model.skins.size())
      throw Failure(NOOK_ERROR_BAD_FILE, "node \"%s\": skin %d does not exist", nodes.nodes[n].name.c_str(), node.skin);
    const tinygltf::Mesh& source = model.meshes[std::size_t(node.mesh)];
    const Affine& rest_from_mesh = node.skin >= 0 ? skeleton.rest_from_skin[std::size_t(node.skin)] : world[n];
    const bool mirrored = determinant(rest_from_mesh) < 0;
    for (std::size_t p = 0; p < source.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = source.primitives[p];
      const std::string what =
          "mesh \"" + (source.name.empty() ? std::to_string(node.mesh) : source.name) + "\" primitive " + std::to_string(p);
      const Floats position = read_floats(model, attribute(primitive, "POSITION"), 3, what + " positions");
      if (mesh.position.size() + position.count > max_file_vertices)
        throw Failure(NOOK_ERROR_BAD_FILE, "too many vertices (at most %zu)", max_file_vertices);
      const auto first = std::uint32_t(mesh.position.size());
      mesh.primitives.push_back({source.name, first, std::uint32_t(position.count)});
      for (std::size_t v = 0; v < position.count; ++v) {
        const float* q = &position.value[3 * v];
        if (!std::isfinite(q[0]) || !std::isfinite(q[1]) || !std::isfinite(q[2]))
          throw Failure(NOOK_ERROR_BAD_FILE, "%s: position of vertex %zu is not finite (%g, %g, %g)", what.c_str(), v,
                        double(q[0]), double(q[1]), double(q[2]));
        mesh.position.push_back(transform(rest_from_mesh, Vec3{q[0], q[1], q[2]}));
      }
      if (node.skin >= 0) {
        const std::vector<SkinWeights> weights =
            read_weights(model, primitive, skeleton.joint_bone[std::size_t(node.skin)], position.count, what);
        mesh.weights.insert(mesh.weights.end(), weights.begin(), weights.end());
      } else {
        SkinWeights rigid;
        rigid.bone[0] = std::uint16_t(skeleton.rigid_bone[n]);
        rigid.weight[0] = 1;
        mesh.weights.insert(mesh.weights.end(), position.count, rigid);
      }
      std::vector<std::uint32_t> index;
      if (primitive.indices >= 0) {
        index = read_integers(model, primitive.indices, 1, what + " indices").value;
      } else {
        for (std::uint32_t v = 0; v < position.count; ++v) index.push_back(v);
      }
      for (std::uint32_t i : index)
        if (i >= position.count)
          throw Failure(NOOK_ERROR_BAD_FILE, "%s: index %u out of range (%zu vertices)", what.c_str(), i, position.count);
      if ((primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1) && index.size() % 3 != 0)
        corners_lost += index.size() % 3;
      for (std::array<std::uint32_t, 3> t : assemble(index, primitive.mode)) {
        if (mirrored) std::swap(t[1], t[2]);
        mesh.triangle.push_back({first + t[0], first + t[1], first + t[2]});
      }
    }
  }
  if (corners_lost) warnings.push_back(std::to_string(corners_lost) + " left-over indices that make no triangle");
  return mesh;
}

}  // namespace nook::bake
