#include "samples/showcase/gltf_meshes.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

namespace showcase {
namespace {

tinygltf::Model load(const std::filesystem::path& glb) {
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string error, warning;
  if (!reader.LoadBinaryFromFile(&model, &error, &warning, glb.string()))
    throw std::runtime_error("showcase: cannot read " + glb.string() + ": " + error);
  return model;
}

// Reads an accessor of floats, or of unsigned integers for indices.
template <class T>
std::vector<T> read(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors.at(std::size_t(index));
  const tinygltf::BufferView& view = model.bufferViews.at(std::size_t(accessor.bufferView));
  const std::vector<unsigned char>& bytes = model.buffers.at(std::size_t(view.buffer)).data;
  const std::size_t stride = std::size_t(accessor.ByteStride(view)),
                    first = view.byteOffset + accessor.byteOffset;
  if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
      std::size_t(tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type))) * sizeof(float) !=
          sizeof(T))
    throw std::runtime_error("accessor " + std::to_string(index) + " has another type");
  std::vector<T> values(accessor.count);
  if (!values.empty() && first + (values.size() - 1) * stride + sizeof(T) > bytes.size())
    throw std::runtime_error("accessor " + std::to_string(index) + " is outside of its buffer");
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(&values[i], &bytes[first + i * stride], sizeof(T));
  return values;
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors.at(std::size_t(index));
  const tinygltf::BufferView& view = model.bufferViews.at(std::size_t(accessor.bufferView));
  const std::vector<unsigned char>& bytes = model.buffers.at(std::size_t(view.buffer)).data;
  const std::size_t size =
      std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType)));
  const std::size_t first = view.byteOffset + accessor.byteOffset;
  if (first + accessor.count * size > bytes.size())
    throw std::runtime_error("accessor " + std::to_string(index) + " is outside of its buffer");
  std::vector<std::uint32_t> values(accessor.count, 0);
  // glTF is little-endian, and so are the processors that this sample runs on.
  for (std::size_t i = 0; i < values.size(); ++i) std::memcpy(&values[i], &bytes[first + i * size], size);
  return values;
}

glm::mat4 local_matrix(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return glm::mat4(glm::make_mat4(node.matrix.data()));
  glm::mat4 m(1);
  if (node.rotation.size() == 4)
    m = glm::mat4_cast(glm::quat(float(node.rotation[3]), float(node.rotation[0]), float(node.rotation[1]),
                                 float(node.rotation[2])));
  if (node.scale.size() == 3)
    for (int axis = 0; axis < 3; ++axis) m[axis] *= float(node.scale[std::size_t(axis)]);
  if (node.translation.size() == 3) m[3] = glm::vec4(glm::vec3(glm::make_vec3(node.translation.data())), 1);
  return m;
}

int colour_image(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  if (primitive.material < 0) return -1;
  const int texture =
      model.materials.at(std::size_t(primitive.material)).pbrMetallicRoughness.baseColorTexture.index;
  return texture < 0 ? -1 : model.textures.at(std::size_t(texture)).source;
}

int add_texture(const tinygltf::Model& model, int image_index, std::vector<Texture>& textures) {
  if (image_index < 0) return no_texture;
  const tinygltf::Image& image = model.images.at(std::size_t(image_index));
  if (image.bits != 8 || image.component < 3) throw std::runtime_error("its texture is not 8-bit RGB");
  Texture texture{image.width, image.height, {}};
  texture.rgb.reserve(std::size_t(3 * image.width * image.height));
  for (std::size_t i = 0; i < std::size_t(image.width * image.height); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      texture.rgb.push_back(image.image[i * std::size_t(image.component) + c]);
  const auto equal = std::ranges::find_if(textures, [&](const Texture& t) { return t.rgb == texture.rgb; });
  if (equal != textures.end()) return int(equal - textures.begin());
  textures.push_back(std::move(texture));
  return int(textures.size()) - 1;
}

Mesh read_mesh(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const glm::mat4& to_world,
               std::vector<Texture>& textures) {
  Mesh mesh;
  mesh.positions_ws = read<glm::vec3>(model, primitive.attributes.at("POSITION"));
  mesh.normals_ws = read<glm::vec3>(model, primitive.attributes.at("NORMAL"));
  mesh.uvs = read<glm::vec2>(model, primitive.attributes.at("TEXCOORD_0"));
  mesh.triangles = read_indices(model, primitive.indices);
  mesh.texture = add_texture(model, colour_image(model, primitive), textures);
  mesh.colours.assign(mesh.positions_ws.size(), glm::vec3(1));
  const glm::mat3 turn = glm::transpose(glm::inverse(glm::mat3(to_world)));
  for (glm::vec3& p : mesh.positions_ws) p = glm::vec3(to_world * glm::vec4(p, 1));
  for (glm::vec3& n : mesh.normals_ws) n = glm::normalize(turn * n);
  return mesh;
}

std::runtime_error in_file(const std::filesystem::path& glb, const std::exception& e) {
  return std::runtime_error("showcase: " + glb.string() + ": " + e.what());
}

}  // namespace

std::vector<Mesh> read_prop(const std::filesystem::path& glb, const glm::mat4& world_from_file,
                            std::vector<Texture>& textures) {
  const tinygltf::Model model = load(glb);
  std::vector<Mesh> meshes;
  const std::function<void(int, const glm::mat4&)> visit = [&](int n, const glm::mat4& parent) {
    const tinygltf::Node& node = model.nodes.at(std::size_t(n));
    const glm::mat4 to_world = parent * local_matrix(node);
    if (node.mesh >= 0)
      for (const tinygltf::Primitive& primitive : model.meshes.at(std::size_t(node.mesh)).primitives)
        meshes.push_back(read_mesh(model, primitive, to_world, textures));
    for (const int child : node.children) visit(child, to_world);
  };
  try {
    for (const int root : model.scenes.at(std::size_t(std::max(model.defaultScene, 0))).nodes)
      visit(root, world_from_file);
  } catch (const std::exception& e) {
    throw in_file(glb, e);
  }
  return meshes;
}

CharacterSkin read_skin(const std::filesystem::path& glb, const std::vector<std::string>& without,
                        std::vector<Texture>& textures) {
  const tinygltf::Model model = load(glb);
  CharacterSkin skin;
  try {
    for (const tinygltf::Node& node : model.nodes) {
      if (node.mesh < 0 || std::ranges::count(without, node.name) > 0) continue;
      for (const tinygltf::Primitive& primitive : model.meshes.at(std::size_t(node.mesh)).primitives) {
        const int texture = add_texture(model, colour_image(model, primitive), textures);
        if (texture == no_texture) continue;
        const std::vector<glm::vec2> uvs = read<glm::vec2>(model, primitive.attributes.at("TEXCOORD_0"));
        skin.uvs.insert(skin.uvs.end(), uvs.begin(), uvs.end());
        skin.texture = texture;
      }
    }
  } catch (const std::exception& e) {
    throw in_file(glb, e);
  }
  return skin;
}

}  // namespace showcase
