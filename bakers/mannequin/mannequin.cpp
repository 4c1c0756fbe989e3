#include "bakers/mannequin/mannequin.h"

#include <tiny_gltf.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>

#include "bakers/mannequin/body_mesh.h"
#include "bakers/mannequin/bones.h"
#include "bakers/mannequin/motions.h"
#include "bakers/mannequin/skin_weights.h"

namespace nook::mannequin {
namespace {

constexpr double keys_per_second = 24.0;
constexpr int fewest_keys = 24;

// Like files from Blender and Mixamo, the file has z up and its own unit. A node above the skeleton rotates
// and scales it into the world. So the skinning matrices of the file are not rest-to-world matrices. A sample
// that confuses the two looks wrong. The scale is a power of two and the rotation a quarter turn, so that no
// precision is lost.
constexpr double units_per_metre = 128.0;

/// Converts from model space (y up) to the axes of the file (z up).
Vec3 turned(const Vec3& v) {
  return {v.x, -v.z, v.y};
}

/// The armature node converts the file's axes and units to the world. The root bone rotates the axes back, so
/// that all other bones keep the axes of model space. The root can have a matrix because it is not animated.
const std::vector<double> armature_columns{
    1 / units_per_metre, 0, 0, 0, 0, 0, -1 / units_per_metre, 0, 0, 1 / units_per_metre, 0, 0, 0, 0, 0, 1};
const std::vector<double> root_columns{1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1};

class Builder {
 public:
  Builder() {
    model_.asset.version = "2.0";
    model_.asset.generator = "nook mannequin";
    model_.buffers.emplace_back();
  }

  /// Appends tightly packed components. If `bounds` is true, also stores the minimum and maximum, which glTF
  /// requires for some accessors.
  template <typename Component>
  int add_accessor(const std::vector<Component>& values, int component_type, int type, int target,
                   bool bounds) {
    std::vector<unsigned char>& bytes = model_.buffers[0].data;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = values.size() * sizeof(Component);
    view.target = target;
    bytes.resize(bytes.size() + view.byteLength);
    std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);

    const auto width =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = values.size() / width;
    if (bounds) {
      for (std::size_t k = 0; k < width; ++k) {
        Component low = values[k], high = values[k];
        for (std::size_t i = k; i < values.size(); i += width) {
          low = std::min(low, values[i]);
          high = std::max(high, values[i]);
        }
        accessor.minValues.push_back(static_cast<double>(low));
        accessor.maxValues.push_back(static_cast<double>(high));
      }
    }
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_floats(const std::vector<float>& values, int type, int target = 0, bool bounds = false) {
    return add_accessor(values, TINYGLTF_COMPONENT_TYPE_FLOAT, type, target, bounds);
  }

  tinygltf::Model& model() { return model_; }

 private:
  tinygltf::Model model_;
};

void append(std::vector<float>& to, const Vec3& v) {
  to.insert(to.end(), {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
}

void append(std::vector<float>& to, const Quat& q) {
  to.insert(to.end(), {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
                       static_cast<float>(q.w)});
}

void add_mesh(Builder& builder, const TriangleMesh& mesh, const std::vector<VertexWeights>& weights) {
  std::vector<float> positions, normals, shares;
  std::vector<std::uint16_t> joints, indices;
  for (const Vec3& p : mesh.positions_m) {
    append(positions, units_per_metre * turned(p));
  }
  for (const Vec3& n : area_weighted_normals(mesh)) {
    append(normals, turned(n));
  }
  for (const VertexWeights& w : weights) {
    shares.insert(shares.end(), w.weights.begin(), w.weights.end());
    joints.insert(joints.end(), w.bones.begin(), w.bones.end());
  }
  for (const Triangle& t : mesh.triangles) {
    for (std::uint32_t v : t) {
      indices.push_back(static_cast<std::uint16_t>(v));
    }
  }
  constexpr int vertices = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  primitive.attributes["POSITION"] = builder.add_floats(positions, TINYGLTF_TYPE_VEC3, vertices, true);
  primitive.attributes["NORMAL"] = builder.add_floats(normals, TINYGLTF_TYPE_VEC3, vertices);
  primitive.attributes["JOINTS_0"] = builder.add_accessor(joints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                                          TINYGLTF_TYPE_VEC4, vertices, false);
  primitive.attributes["WEIGHTS_0"] = builder.add_floats(shares, TINYGLTF_TYPE_VEC4, vertices);
  primitive.indices = builder.add_accessor(indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                           TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, false);
  tinygltf::Mesh gltf_mesh;
  gltf_mesh.name = "mannequin";
  gltf_mesh.primitives.push_back(std::move(primitive));
  builder.model().meshes.push_back(std::move(gltf_mesh));

  tinygltf::Material material;
  material.name = "clay";
  material.pbrMetallicRoughness.baseColorFactor = {0.80, 0.72, 0.64, 1.0};
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 0.85;
  builder.model().materials.push_back(std::move(material));
}

/// Returns a bone's offset from its parent, in the parent's own axes. The bone must not be the root, which
/// has no parent and is at the origin.
Vec3 local_offset_m(const Skeleton& skeleton, const Bone& bone) {
  const Bone& parent = skeleton.bones()[static_cast<std::size_t>(bone.parent)];
  return glm::conjugate(parent.orientation) * (bone.position_m - parent.position_m);
}

/// Appends the inverse bind matrix of a bone. It converts from the axes and units of the mesh to the axes and
/// units of the bone.
void append_inverse_bind(std::vector<float>& to, const Bone& bone) {
  const Mat3 turn = glm::transpose(glm::mat3_cast(bone.orientation));
  for (const Vec3& column : {turn[0], -turn[2], turn[1]}) {
    append(to, column);
    to.push_back(0.0F);
  }
  append(to, -units_per_metre * (turn * bone.position_m));
  to.push_back(1.0F);
}

/// Adds the nodes. Nodes 0 to n - 1 are the bones in the skeleton's order. Node n has the mesh. Node n + 1 is
/// the armature, the parent of the root bone and of node n.
void add_nodes(Builder& builder, const Skeleton& skeleton) {
  tinygltf::Model& model = builder.model();
  const Pose bind(skeleton);
  std::vector<float> inverse_bind;
  tinygltf::Skin skin;
  skin.name = "mannequin";
  skin.skeleton = 0;
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    const Bone& bone = skeleton.bones()[i];
    tinygltf::Node node;
    node.name = bone.name;
    if (bone.parent < 0) {
      node.matrix = root_columns;
    } else {
      const Vec3 t = units_per_metre * local_offset_m(skeleton, bone);
      const Quat q = bind.local_rotation(static_cast<int>(i));
      node.translation = {t.x, t.y, t.z};
      node.rotation = {q.x, q.y, q.z, q.w};
    }
    model.nodes.push_back(std::move(node));
    if (bone.parent >= 0) {
      model.nodes[static_cast<std::size_t>(bone.parent)].children.push_back(static_cast<int>(i));
    }
    skin.joints.push_back(static_cast<int>(i));
    append_inverse_bind(inverse_bind, bone);
  }
  skin.inverseBindMatrices = builder.add_floats(inverse_bind, TINYGLTF_TYPE_MAT4);
  model.skins.push_back(std::move(skin));

  tinygltf::Node body;
  body.name = "mannequin";
  body.mesh = 0;
  body.skin = 0;
  const int body_index = static_cast<int>(model.nodes.size());
  model.nodes.push_back(std::move(body));
  tinygltf::Node armature;
  armature.name = "Armature";
  armature.matrix = armature_columns;
  armature.children = {0, body_index};
  model.nodes.push_back(std::move(armature));
  tinygltf::Scene scene;
  scene.nodes = {body_index + 1};
  model.scenes.push_back(std::move(scene));
  model.defaultScene = 0;
}

void add_animation(Builder& builder, const Skeleton& skeleton, const Clip& clip) {
  const int intervals =
      std::max(fewest_keys, static_cast<int>(std::lround(clip.duration_s * keys_per_second)));
  std::vector<float> times;
  std::vector<std::vector<float>> rotations(skeleton.size());
  std::vector<float> pelvis;
  std::vector<Quat> previous(skeleton.size(), Quat(1.0, 0.0, 0.0, 0.0));
  const auto pelvis_bone = static_cast<std::size_t>(skeleton.find("pelvis"));
  for (int key = 0; key <= intervals; ++key) {
    // The last key equals the first one, so that a player can loop without a jump.
    const double phase = key == intervals ? 0.0 : static_cast<double>(key) / intervals;
    times.push_back(static_cast<float>(clip.duration_s * key / intervals));
    const Pose pose = clip.pose_at(skeleton, phase);
    append(pelvis, units_per_metre *
                       (local_offset_m(skeleton, skeleton.bones()[pelvis_bone]) + pose.pelvis_shift_m()));
    for (std::size_t i = 0; i < skeleton.size(); ++i) {
      Quat q = pose.local_rotation(static_cast<int>(i));
      // q and -q are the same rotation. We choose the one closer to the previous key, so that players
      // interpolate along the shorter way.
      if (glm::dot(q, previous[i]) < 0.0) {
        q = -q;
      }
      previous[i] = q;
      append(rotations[i], q);
    }
  }

  tinygltf::Animation animation;
  animation.name = clip.name;
  const int key_times = builder.add_floats(times, TINYGLTF_TYPE_SCALAR, 0, true);
  const auto add_channel = [&](std::size_t node, const char* path, int input, int output) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = static_cast<int>(node);
    channel.target_path = path;
    animation.samplers.push_back(std::move(sampler));
    animation.channels.push_back(std::move(channel));
  };
  add_channel(pelvis_bone, "translation", key_times, builder.add_floats(pelvis, TINYGLTF_TYPE_VEC3));
  const int end_times = builder.add_floats({times.front(), times.back()}, TINYGLTF_TYPE_SCALAR, 0, true);
  for (std::size_t i = 1; i < skeleton.size(); ++i) {
    // Most finger bones do not move. Two keys are enough for them and save most of the bytes.
    std::vector<float>& keys = rotations[i];
    const bool is_still = std::equal(keys.begin() + 4, keys.end(), keys.begin());
    if (is_still) {
      keys.resize(8);
    }
    add_channel(i, "rotation", is_still ? end_times : key_times,
                builder.add_floats(keys, TINYGLTF_TYPE_VEC4));
  }
  builder.model().animations.push_back(std::move(animation));
}

/// Packs the character into one binary glTF 2.0 file: one skinned mesh, one skin, one animation for each
/// clip.
std::vector<unsigned char> write_glb(const TriangleMesh& mesh, const std::vector<VertexWeights>& weights,
                                     const Skeleton& skeleton, const std::vector<Clip>& clips) {
  if (mesh.positions_m.size() > 65535) {
    throw std::runtime_error("write_glb: too many vertices for 16-bit indices (got " +
                             std::to_string(mesh.positions_m.size()) + ", need 65535 or fewer)");
  }
  Builder builder;
  add_mesh(builder, mesh, weights);
  add_nodes(builder, skeleton);
  for (const Clip& clip : clips) {
    add_animation(builder, skeleton, clip);
  }
  std::ostringstream stream(std::ios::binary);
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&builder.model(), stream, false, true)) {
    throw std::runtime_error("write_glb: tinygltf could not write the scene");
  }
  const std::string bytes = stream.str();
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<unsigned char> make_mannequin_glb() {
  const Skeleton skeleton;
  const TriangleMesh mesh = make_body_mesh();
  return write_glb(mesh, make_skin_weights(mesh, skeleton), skeleton, all_clips());
}

}  // namespace nook::mannequin
