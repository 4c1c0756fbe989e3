#include "bakers/import/gltf_types.h"

#include <algorithm>
#include <array>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// Component types as bits; the suffix n stands for normalised.
enum : unsigned {
  f32 = 1u << 0,
  u8 = 1u << 1,
  u8n = 1u << 2,
  i8 = 1u << 3,
  i8n = 1u << 4,
  u16 = 1u << 5,
  u16n = 1u << 6,
  i16 = 1u << 7,
  i16n = 1u << 8,
  u32 = 1u << 9,
};
constexpr unsigned normalised_integers = u8n | i8n | u16n | i16n;

struct TypeName {
  unsigned bit;
  const char* name;
};
constexpr std::array<TypeName, 10> names{{{f32, "FLOAT"},
                                          {u8, "UNSIGNED_BYTE"},
                                          {u8n, "normalized UNSIGNED_BYTE"},
                                          {i8, "BYTE"},
                                          {i8n, "normalized BYTE"},
                                          {u16, "UNSIGNED_SHORT"},
                                          {u16n, "normalized UNSIGNED_SHORT"},
                                          {i16, "SHORT"},
                                          {i16n, "normalized SHORT"},
                                          {u32, "UNSIGNED_INT"}}};

// The two allowed element types. Both are equal if only one is allowed.
struct Allowed {
  AccessorUse use;
  int element, other_element;
  unsigned components;  // glTF 2.0
  unsigned quantised;   // added by KHR_mesh_quantization
};

// clang-format off
// glTF 2.0, sections 3.7.2.1 (attributes and indices), 3.7.2.2 (morph targets), 3.7.3.1 (skins) and 3.11
// (animations); KHR_mesh_quantization, "Extending Mesh Attributes" and "Extending Morph Target Attributes".
constexpr std::array<Allowed, 15> table{{
    {AccessorUse::position, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3, f32, u8 | u8n | i8 | i8n | u16 | u16n | i16 | i16n},
    {AccessorUse::normal, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3, f32, i8n | i16n},
    {AccessorUse::tangent, TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_VEC4, f32, i8n | i16n},
    {AccessorUse::texture_coordinates, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC2, f32 | u8n | u16n, u8 | i8 | i8n | u16 | i16 | i16n},
    {AccessorUse::colour, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4, f32 | u8n | u16n, 0},
    {AccessorUse::joints, TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_VEC4, u8 | u16, 0},
    {AccessorUse::weights, TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_VEC4, f32 | u8n | u16n, 0},
    {AccessorUse::indices, TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_SCALAR, u8 | u16 | u32, 0},
    {AccessorUse::morph_position, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3, f32, i8 | i8n | i16 | i16n},
    {AccessorUse::morph_normal, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3, f32, i8n | i16n},
    {AccessorUse::morph_tangent, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3, f32, i8n | i16n},
    {AccessorUse::inverse_bind, TINYGLTF_TYPE_MAT4, TINYGLTF_TYPE_MAT4, f32, 0},
    {AccessorUse::key_times, TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_SCALAR, f32, 0},
    {AccessorUse::translation_or_scale, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3, f32, 0},
    {AccessorUse::rotation, TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_VEC4, f32 | normalised_integers, 0},
}};
// clang-format on

const Allowed& row_of(AccessorUse use) {
  return *std::find_if(table.begin(), table.end(), [&](const Allowed& row) { return row.use == use; });
}

unsigned bit_of(int component_type, bool normalised) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return f32;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return normalised ? u8n : u8;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalised ? i8n : i8;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return normalised ? u16n : u16;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalised ? i16n : i16;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return normalised ? 0u : unsigned{u32};
    default:
      return 0;
  }
}

const char* element_name(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return "SCALAR";
    case TINYGLTF_TYPE_VEC2:
      return "VEC2";
    case TINYGLTF_TYPE_VEC3:
      return "VEC3";
    case TINYGLTF_TYPE_VEC4:
      return "VEC4";
    case TINYGLTF_TYPE_MAT2:
      return "MAT2";
    case TINYGLTF_TYPE_MAT3:
      return "MAT3";
    case TINYGLTF_TYPE_MAT4:
      return "MAT4";
    default:
      return "an unknown type";
  }
}

bool uses_quantisation(const tinygltf::Model& model) {
  const auto has = [](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), "KHR_mesh_quantization") != list.end();
  };
  return has(model.extensionsUsed) || has(model.extensionsRequired);
}

std::string component_names(unsigned bits) {
  std::string text;
  for (const TypeName& type : names)
    if (bits & type.bit) text += (text.empty() ? "" : ", ") + std::string(type.name);
  return text;
}

}  // namespace

std::string type_name(const tinygltf::Accessor& accessor) {
  const std::string components = component_names(bit_of(accessor.componentType, accessor.normalized));
  return std::string(element_name(accessor.type)) + " of " +
         (components.empty() ? "component type " + std::to_string(accessor.componentType) : components);
}

bool has_allowed_type(const tinygltf::Model& model, const tinygltf::Accessor& accessor, AccessorUse use) {
  const Allowed& row = row_of(use);
  const unsigned bit = bit_of(accessor.componentType, accessor.normalized);
  const bool fits = accessor.type == row.element || accessor.type == row.other_element;
  return fits && ((bit & row.components) || ((bit & row.quantised) && uses_quantisation(model)));
}

void require_allowed_type(const tinygltf::Model& model, int index, AccessorUse use, const std::string& what) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) return;
  const tinygltf::Accessor& accessor = model.accessors[index];
  if (has_allowed_type(model, accessor, use)) return;
  const Allowed& row = row_of(use);
  const bool only_undeclared = (bit_of(accessor.componentType, accessor.normalized) & row.quantised) != 0 &&
                               accessor.type == row.element;
  throw Failure(NOOK_ERROR_BAD_FILE, "%s (accessor %d) contains %s (need %s; allowed component types: %s)%s",
                what.c_str(), index, type_name(accessor).c_str(), element_name(row.element),
                component_names(row.components).c_str(),
                only_undeclared ? "; list KHR_mesh_quantization in extensionsUsed"
                                : "; export the file again with an exporter that follows glTF 2.0");
}

}  // namespace nook::bake
