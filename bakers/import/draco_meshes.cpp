#include "bakers/import/draco_meshes.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <map>
#include <string>
#include <utility>

#if NOOK_DRACO
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#endif

#include "bakers/import/file_reader.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr const char* extension_name = "KHR_draco_mesh_compression";

bool has_bytes(const tinygltf::Model& model, int accessor) {
  return accessor >= 0 && std::size_t(accessor) < model.accessors.size() &&
         model.accessors[std::size_t(accessor)].bufferView >= 0;
}

// Returns true if some data of the primitive exists only in compressed form. Draco compresses only meshes
// with indices. Indices without bytes were removed before parsing.
bool needs_decoding(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                    const tinygltf::Value& extension) {
  if (!has_bytes(model, primitive.indices)) return true;
  if (!extension.IsObject() || !extension.Has("attributes") || !extension.Get("attributes").IsObject())
    return true;
  for (const std::string& name : extension.Get("attributes").Keys()) {
    const auto accessor = primitive.attributes.find(name);
    if (accessor != primitive.attributes.end() && !has_bytes(model, accessor->second)) return true;
  }
  return false;
}

#if NOOK_DRACO

[[noreturn]] void refuse(const std::string& what, const std::string& fault) {
  throw Failure(NOOK_ERROR_BAD_FILE, "%s, compressed by Draco: %s; export the file again", what.c_str(),
                fault.c_str());
}

int whole_number(const tinygltf::Value& object, const char* name, const std::string& what) {
  if (!object.IsObject() || !object.Has(name) || !object.Get(name).IsInt() ||
      object.Get(name).GetNumberAsInt() < 0)
    refuse(what, std::string("\"").append(name).append("\" is missing or not a whole number of 0 or more"));
  return object.Get(name).GetNumberAsInt();
}

std::pair<const char*, std::size_t> source_of(const tinygltf::Model& model, int index,
                                              const std::string& what) {
  if (std::size_t(index) >= model.bufferViews.size())
    refuse(what, "it refers to buffer view " + std::to_string(index) + ", but the file has only " +
                     std::to_string(model.bufferViews.size()));
  const tinygltf::BufferView& view = model.bufferViews[std::size_t(index)];
  if (view.buffer < 0 || std::size_t(view.buffer) >= model.buffers.size())
    refuse(what, "its buffer view refers to a buffer that does not exist");
  const std::vector<unsigned char>& data = model.buffers[std::size_t(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    refuse(what, "its buffer view is not inside its buffer");
  return {reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength};
}

// Errors that the library reports become Failures. Exceptions that it throws on damaged data, such as a
// failed allocation, also become Failures.
std::unique_ptr<draco::Mesh> decode(std::pair<const char*, std::size_t> source, const std::string& what) {
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(source.first, source.second);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (decoded.ok()) return std::move(decoded).value();
    refuse(what, "its data are damaged (" + decoded.status().error_msg_string() + ")");
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& fault) {
    refuse(what, std::string("its data are damaged (") + fault.what() + ")");
  }
}

// Appends the decompressed data of primitives to the model.
class Decompressed {
 public:
  explicit Decompressed(tinygltf::Model& model) : model_(model) {}

  void decode_primitive(tinygltf::Primitive& primitive, const tinygltf::Value& extension,
                        const std::string& what) {
    const auto source = source_of(model_, whole_number(extension, "bufferView", what), what);
    const std::unique_ptr<draco::Mesh> mesh = decode(source, what);
    if (mesh->num_points() > max_file_vertices || mesh->num_faces() > max_file_vertices * 4)
      refuse(what, "it has too many vertices or triangles");
    add_indices(*mesh, primitive);
    if (!extension.Has("attributes") || !extension.Get("attributes").IsObject())
      refuse(what, "\"attributes\" is missing");
    const tinygltf::Value& attributes = extension.Get("attributes");
    for (const std::string& name : attributes.Keys()) {
      const auto accessor = primitive.attributes.find(name);
      if (accessor == primitive.attributes.end()) continue;
      const int id = whole_number(attributes, name.c_str(), what);
      const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(std::uint32_t(id));
      if (!attribute)
        refuse(what,
               name + " refers to identifier " + std::to_string(id) + ", which does not exist in the data");
      accessor->second = add_attribute(*mesh, *attribute, accessor->second, what + "." + name);
    }
  }

 private:
  int add_accessor(tinygltf::Accessor accessor, std::vector<unsigned char> bytes) {
    if (bytes.size() > left_)
      throw Failure(NOOK_ERROR_BAD_FILE, "the decompressed data have more than 2 GiB");
    left_ -= bytes.size();
    tinygltf::BufferView view;
    view.buffer = int(model_.buffers.size());
    view.byteLength = bytes.size();
    model_.buffers.emplace_back();
    model_.buffers.back().data = std::move(bytes);
    accessor.bufferView = int(model_.bufferViews.size());
    accessor.byteOffset = 0;
    accessor.sparse.isSparse = false;
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return int(model_.accessors.size()) - 1;
  }

  void add_indices(const draco::Mesh& mesh, tinygltf::Primitive& primitive) {
    tinygltf::Accessor accessor;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = 3 * std::size_t(mesh.num_faces());
    std::vector<unsigned char> bytes(4 * accessor.count);
    std::size_t at = 0;
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
      for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f))) {
        const std::uint32_t index = corner.value();
        std::memcpy(bytes.data() + at, &index, 4);
        at += 4;
      }
    primitive.indices = add_accessor(std::move(accessor), std::move(bytes));
    // The library decompresses strips as triangle lists.
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
  }

  template <typename T>
  static std::vector<unsigned char> values(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                                           int components, const std::string& what) {
    std::vector<unsigned char> bytes(sizeof(T) * std::size_t(components) * mesh.num_points());
    std::array<T, 4> value{};
    for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
      const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(p));
      if (at.value() >= attribute.size() ||
          !attribute.ConvertValue<T>(at, static_cast<std::int8_t>(components), value.data()))
        refuse(what, "its values do not fit the accessor's type");
      std::memcpy(bytes.data() + sizeof(T) * std::size_t(components) * p, value.data(),
                  sizeof(T) * std::size_t(components));
    }
    return bytes;
  }

  int add_attribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int index,
                    const std::string& what) {
    if (index < 0 || std::size_t(index) >= model_.accessors.size())
      refuse(what, "it refers to an accessor that does not exist: " + std::to_string(index));
    tinygltf::Accessor accessor = model_.accessors[std::size_t(index)];
    const int components = attribute.num_components();
    if (components < 1 || components > 4 ||
        tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type)) != components)
      refuse(what, "its data have " + std::to_string(components) +
                       " components per element, but its accessor has a different number");
    accessor.count = mesh.num_points();
    switch (accessor.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return add_accessor(accessor, values<std::int8_t>(mesh, attribute, components, what));
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return add_accessor(accessor, values<std::uint8_t>(mesh, attribute, components, what));
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return add_accessor(accessor, values<std::int16_t>(mesh, attribute, components, what));
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return add_accessor(accessor, values<std::uint16_t>(mesh, attribute, components, what));
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return add_accessor(accessor, values<std::uint32_t>(mesh, attribute, components, what));
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return add_accessor(accessor, values<float>(mesh, attribute, components, what));
      default:
        refuse(what, "its accessor has a component type that glTF does not define");
    }
  }

  tinygltf::Model& model_;
  std::uint64_t left_ = max_file_bytes;
};

#endif

}  // namespace

bool reads_draco() {
  return NOOK_DRACO != 0;
}

void decompress_draco(tinygltf::Model& model) {
#if NOOK_DRACO
  Decompressed decompressed(model);
#endif
  for (std::size_t m = 0; m < model.meshes.size(); ++m)
    for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
      tinygltf::Primitive& primitive = model.meshes[m].primitives[p];
      const auto extension = primitive.extensions.find(extension_name);
      if (extension == primitive.extensions.end() || !needs_decoding(model, primitive, extension->second))
        continue;
      const std::string what = "mesh " + std::to_string(m) + " primitive " + std::to_string(p);
#if NOOK_DRACO
      decompressed.decode_primitive(primitive, extension->second, what);
#else
      throw Failure(
          NOOK_ERROR_BAD_FILE,
          "%s is compressed by Draco, which this build does not read; decode it first: gltf-transform "
          "copy IN.glb OUT.glb",
          what.c_str());
#endif
    }
}

}  // namespace nook::bake
