#include "bakers/import/json_types.h"

#include <cmath>
#include <string>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::json;

enum class Type {
  integer,
  number,
  boolean,
  string,
  object,
  integers,
  numbers,
  strings,
  objects,
  integer_map
};

// The kinds of JSON objects in a document.
enum class Owner {
  document,
  scene,
  node,
  node_extensions,
  instancing,
  levels,
  mesh,
  primitive,
  skin,
  animation,
  channel,
  target,
  sampler,
  accessor,
  sparse,
  sparse_part,
  view,
  buffer,
  none
};

struct Member {
  Owner owner;
  const char* name;
  Type type;
  Owner inner = Owner::none;  // the kind of the member's object, or of the objects in its array
};

// clang-format off
// glTF 2.0, section 5 (JSON schema reference), and the extensions of nodes that the import reads.
constexpr Member members[] = {
    {Owner::document, "scene", Type::integer},
    {Owner::document, "scenes", Type::objects, Owner::scene},
    {Owner::document, "nodes", Type::objects, Owner::node},
    {Owner::document, "meshes", Type::objects, Owner::mesh},
    {Owner::document, "skins", Type::objects, Owner::skin},
    {Owner::document, "animations", Type::objects, Owner::animation},
    {Owner::document, "accessors", Type::objects, Owner::accessor},
    {Owner::document, "bufferViews", Type::objects, Owner::view},
    {Owner::document, "buffers", Type::objects, Owner::buffer},
    {Owner::document, "materials", Type::objects},
    {Owner::document, "extensionsUsed", Type::strings},
    {Owner::document, "extensionsRequired", Type::strings},
    {Owner::scene, "nodes", Type::integers},
    {Owner::node, "children", Type::integers},
    {Owner::node, "mesh", Type::integer},
    {Owner::node, "skin", Type::integer},
    {Owner::node, "matrix", Type::numbers},
    {Owner::node, "translation", Type::numbers},
    {Owner::node, "rotation", Type::numbers},
    {Owner::node, "scale", Type::numbers},
    {Owner::node, "weights", Type::numbers},
    {Owner::node, "extensions", Type::object, Owner::node_extensions},
    {Owner::node_extensions, "EXT_mesh_gpu_instancing", Type::object, Owner::instancing},
    {Owner::node_extensions, "MSFT_lod", Type::object, Owner::levels},
    {Owner::instancing, "attributes", Type::integer_map},
    {Owner::levels, "ids", Type::integers},
    {Owner::mesh, "primitives", Type::objects, Owner::primitive},
    {Owner::mesh, "weights", Type::numbers},
    {Owner::primitive, "attributes", Type::integer_map},
    {Owner::primitive, "indices", Type::integer},
    {Owner::primitive, "material", Type::integer},
    {Owner::primitive, "mode", Type::integer},
    {Owner::primitive, "targets", Type::objects},
    {Owner::skin, "joints", Type::integers},
    {Owner::skin, "inverseBindMatrices", Type::integer},
    {Owner::animation, "channels", Type::objects, Owner::channel},
    {Owner::animation, "samplers", Type::objects, Owner::sampler},
    {Owner::channel, "sampler", Type::integer},
    {Owner::channel, "target", Type::object, Owner::target},
    {Owner::target, "node", Type::integer},
    {Owner::target, "path", Type::string},
    {Owner::sampler, "input", Type::integer},
    {Owner::sampler, "output", Type::integer},
    {Owner::sampler, "interpolation", Type::string},
    {Owner::accessor, "bufferView", Type::integer},
    {Owner::accessor, "byteOffset", Type::integer},
    {Owner::accessor, "componentType", Type::integer},
    {Owner::accessor, "count", Type::integer},
    {Owner::accessor, "normalized", Type::boolean},
    {Owner::accessor, "type", Type::string},
    {Owner::accessor, "sparse", Type::object, Owner::sparse},
    {Owner::sparse, "count", Type::integer},
    {Owner::sparse, "indices", Type::object, Owner::sparse_part},
    {Owner::sparse, "values", Type::object, Owner::sparse_part},
    {Owner::sparse_part, "bufferView", Type::integer},
    {Owner::sparse_part, "byteOffset", Type::integer},
    {Owner::sparse_part, "componentType", Type::integer},
    {Owner::view, "buffer", Type::integer},
    {Owner::view, "byteOffset", Type::integer},
    {Owner::view, "byteLength", Type::integer},
    {Owner::view, "byteStride", Type::integer},
    {Owner::buffer, "byteLength", Type::integer},
    {Owner::buffer, "uri", Type::string},
};
// clang-format on

const char* text_of(Type type) {
  switch (type) {
    case Type::integer:
      return "a whole number";
    case Type::number:
      return "a number";
    case Type::boolean:
      return "true or false";
    case Type::string:
      return "a string";
    case Type::object:
    case Type::integer_map:
      return "an object";
    default:
      return "an array";
  }
}

const char* text_of(const Json& value) {
  if (value.is_number()) return "a number";
  if (value.is_boolean()) return "true or false";
  if (value.is_string()) return "a string";
  if (value.is_null()) return "null";
  return value.is_object() ? "an object" : "an array";
}

Type element_of(Type type) {
  switch (type) {
    case Type::integers:
    case Type::integer_map:
      return Type::integer;
    case Type::numbers:
      return Type::number;
    case Type::strings:
      return Type::string;
    default:
      return Type::object;
  }
}

// The position of a value in the document, such as nodes[3].scale.
struct Place {
  const Place* outer = nullptr;
  const char* name = "";
  std::size_t index = 0;
  bool is_element = false;

  std::string text() const {
    std::string before = outer ? outer->text() : "";
    if (is_element) return before + "[" + std::to_string(index) + "]";
    return before + (before.empty() ? "" : ".") + name;
  }
};

class Walk {
 public:
  bool has_changed() const { return has_changed_; }

  void look_at(Json& object, Owner owner, const Place* place) {
    for (const Member& member : members) {
      if (member.owner != owner) continue;
      const auto found = object.find(member.name);
      if (found == object.end() || found->is_null()) continue;
      const Place own{place, member.name};
      require(*found, member.type, member.inner, own);
    }
  }

 private:
  void require(Json& value, Type type, Owner inner, const Place& place) {
    switch (type) {
      case Type::integer:
        if (value.is_number_float()) mend(value);
        return require(value.is_number_integer(), value, type, place);
      case Type::number:
        return require(value.is_number(), value, type, place);
      case Type::boolean:
        return require(value.is_boolean(), value, type, place);
      case Type::string:
        return require(value.is_string(), value, type, place);
      case Type::object:
        require(value.is_object(), value, type, place);
        return look_at(value, inner, &place);
      case Type::integer_map:
        require(value.is_object(), value, type, place);
        for (auto& item : value.items())
          require(item.value(), Type::integer, Owner::none, Place{&place, item.key().c_str()});
        return;
      default:
        require(value.is_array(), value, type, place);
        for (std::size_t i = 0; i < value.size(); ++i)
          require(value[i], element_of(type), inner, Place{&place, "", i, true});
    }
  }

  static void require(bool is_right, const Json& value, Type type, const Place& place) {
    if (!is_right)
      throw Failure(NOOK_ERROR_BAD_FILE, "%s is %s (need %s); repair the file",
                    place.text().substr(0, 200).c_str(), text_of(value), text_of(type));
  }

  void mend(Json& value) {
    constexpr double most = 9007199254740992.0;  // 2^53: larger doubles have no fractional part
    const double number = value.get<double>();
    if (!(std::abs(number) <= most) || number != std::floor(number)) return;
    value = static_cast<std::int64_t>(number);
    has_changed_ = true;
  }

  bool has_changed_ = false;
};

}  // namespace

bool require_member_types(Json& document) {
  Walk walk;
  walk.look_at(document, Owner::document, nullptr);
  return walk.has_changed();
}

}  // namespace nook::bake
