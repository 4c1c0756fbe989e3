#include "bakers/import/gltf_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "bakers/import/accessor.h"
#include "bakers/import/gltf_types.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

std::optional<AccessorUse> use_of(std::string_view attribute) {
  if (attribute == "POSITION") return AccessorUse::position;
  if (attribute == "NORMAL") return AccessorUse::normal;
  if (attribute == "TANGENT") return AccessorUse::tangent;
  if (attribute.starts_with("TEXCOORD_")) return AccessorUse::texture_coordinates;
  if (attribute.starts_with("COLOR_")) return AccessorUse::colour;
  if (attribute.starts_with("JOINTS_")) return AccessorUse::joints;
  if (attribute.starts_with("WEIGHTS_")) return AccessorUse::weights;
  return std::nullopt;
}

// Returns true for uses that every import reads. All other uses are checked by the code that reads them.
bool decides_shape(AccessorUse use) {
  return use == AccessorUse::position || use == AccessorUse::joints || use == AccessorUse::weights;
}

std::string name_of_primitive(std::size_t mesh, std::size_t primitive) {
  return "mesh " + std::to_string(mesh) + " primitive " + std::to_string(primitive);
}

template <typename Visit>
void for_each_primitive(const tinygltf::Model& model, Visit visit) {
  for (std::size_t m = 0; m < model.meshes.size(); ++m)
    for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p)
      visit(model.meshes[m].primitives[p], m, p);
}

void check_primitive_types(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           const std::string& what) {
  for (const auto& [name, accessor] : primitive.attributes) {
    const auto use = use_of(name);
    if (use && decides_shape(*use)) require_allowed_type(model, accessor, *use, what + "." + name);
  }
  require_allowed_type(model, primitive.indices, AccessorUse::indices, what + ".indices");
  for (std::size_t t = 0; t < primitive.targets.size(); ++t)
    if (const auto moved = primitive.targets[t].find("POSITION"); moved != primitive.targets[t].end())
      require_allowed_type(model, moved->second, AccessorUse::morph_position,
                           what + " morph target " + std::to_string(t));
}

void check_animation_types(const tinygltf::Model& model, const tinygltf::Animation& animation,
                           const std::string& name) {
  for (std::size_t c = 0; c < animation.channels.size(); ++c) {
    const tinygltf::AnimationChannel& channel = animation.channels[c];
    if (channel.sampler < 0 || std::size_t(channel.sampler) >= animation.samplers.size()) continue;
    const tinygltf::AnimationSampler& sampler = animation.samplers[std::size_t(channel.sampler)];
    const std::string what = name + " channel " + std::to_string(c);
    const std::string& path = channel.target_path;
    // We do not read weights of morph targets.
    if (path != "translation" && path != "rotation" && path != "scale") continue;
    require_allowed_type(model, sampler.input, AccessorUse::key_times, what + " input");
    if (path == "translation" || path == "scale")
      require_allowed_type(model, sampler.output, AccessorUse::translation_or_scale, what + " output");
    if (path == "rotation")
      require_allowed_type(model, sampler.output, AccessorUse::rotation, what + " output");
  }
}

struct Fault {
  std::size_t count = 0;
  std::string first;
  void add(const std::string& where) {
    if (count++ == 0) first = where;
  }
};

void warn(std::vector<std::string>& warnings, const Fault& fault, const char* what) {
  if (fault.count == 0) return;
  warnings.push_back(std::to_string(fault.count)
                         .append(" ")
                         .append(what)
                         .append(" (the first is ")
                         .append(fault.first)
                         .append(")"));
}

std::string name_of_node(const tinygltf::Model& model, std::size_t node) {
  const std::string& name = model.nodes[node].name;
  return "node " + std::to_string(node) + (name.empty() ? "" : ", \"" + name.substr(0, 80) + "\"");
}

// The last row of a column-major matrix must be 0 0 0 1 (glTF 2.0, sections 3.5.2 and 3.7.3.1).
template <typename Number>
bool has_last_row(const Number* matrix) {
  constexpr double tolerance = 1e-4;  // exporters write six digits or more
  for (std::size_t column = 0; column < 4; ++column)
    if (!(std::abs(double(matrix[4 * column + 3]) - (column == 3 ? 1 : 0)) <= tolerance)) return false;
  return true;
}

void look_at_skins(const tinygltf::Model& model, std::vector<std::string>& warnings) {
  Fault last_row;
  std::size_t left = std::size_t{1} << 22;  // matrices; skins may share them
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    const int accessor = model.skins[s].inverseBindMatrices;
    if (accessor < 0 || std::size_t(accessor) >= model.accessors.size()) continue;
    const std::size_t count = model.accessors[std::size_t(accessor)].count;
    if (count > left) continue;
    left -= count;
    try {
      const Floats matrices = read_floats(model, accessor, 16, "inverse bind matrices");
      for (std::size_t m = 0; m + 16 <= matrices.value.size(); m += 16)
        if (!has_last_row(&matrices.value[m])) {
          last_row.add("skin " + std::to_string(s) + " matrix " + std::to_string(m / 16));
          break;
        }
    } catch (const Failure&) {
    }
  }
  warn(warnings, last_row,
       "skins have inverse bind matrices whose last row is not 0 0 0 1; the row was ignored");
}

void look_at_nodes(const tinygltf::Model& model, std::vector<std::string>& warnings) {
  Fault both, not_unit, last_row;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Node& node = model.nodes[n];
    if (!node.matrix.empty() && !(node.translation.empty() && node.rotation.empty() && node.scale.empty()))
      both.add(name_of_node(model, n));
    if (node.matrix.size() == 16 && !has_last_row(node.matrix.data())) last_row.add(name_of_node(model, n));
    double square = 0;
    for (const double q : node.rotation) square += q * q;
    // Exporters write six digits or more.
    if (!node.rotation.empty() && !(std::abs(square - 1) < 1e-3)) not_unit.add(name_of_node(model, n));
  }
  warn(warnings, last_row, "nodes have a matrix whose last row is not 0 0 0 1; the row was ignored");
  warn(warnings, both,
       "nodes have a matrix as well as a translation, rotation or scale; the matrix was used");
  warn(warnings, not_unit, "nodes have a rotation that is not a unit quaternion; it was normalised");
}

// In graphics APIs, the largest index of a type restarts the primitive. So glTF files must not use it (glTF
// 2.0, section 3.7.2.1).
bool has_restart(const tinygltf::Model& model, int accessor) {
  const int type = model.accessors[std::size_t(accessor)].componentType;
  const std::uint32_t restart = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 0xffu
                                : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 0xffffu
                                                                                 : 0xffffffffu;
  try {
    const Integers index = read_integers(model, accessor, 1, "indices");
    return std::find(index.value.begin(), index.value.end(), restart) != index.value.end();
  } catch (const Failure&) {
    return false;
  }
}

// Returns false if the accessor has no bounds, or if its bounds are correct within the rounding to six
// digits.
bool has_false_bounds(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors[std::size_t(index)];
  if (accessor.minValues.empty() || accessor.maxValues.empty() || accessor.normalized) return false;
  try {
    const Floats values = read_floats(model, index, "bounds");
    const auto components = std::size_t(values.components);
    if (accessor.minValues.size() != components || accessor.maxValues.size() != components) return true;
    for (std::size_t c = 0; c < components && values.count > 0; ++c) {
      double low = double(values.value[c]), high = low;
      for (std::size_t i = c; i < values.value.size(); i += components) {
        low = std::min(low, double(values.value[i]));
        high = std::max(high, double(values.value[i]));
      }
      const double tolerance = 1e-4 * (high - low) + 1e-5 * std::max({std::abs(low), std::abs(high), 1e-3});
      if (!(std::abs(accessor.minValues[c] - low) <= tolerance) ||
          !(std::abs(accessor.maxValues[c] - high) <= tolerance))
        return true;
    }
  } catch (const Failure&) {
  }
  return false;
}

bool is_there(const tinygltf::Model& model, int accessor) {
  return accessor >= 0 && std::size_t(accessor) < model.accessors.size();
}

// The accessors that were not checked yet. Each accessor is checked once. The checks stop at a limit far
// above the elements of an import. The limit is necessary because accessors may share their bytes, or have no
// bytes.
class Unseen {
 public:
  explicit Unseen(const tinygltf::Model& model) : model_(model) {}
  bool take(int accessor) {
    if (!is_there(model_, accessor) || !seen_.insert(accessor).second) return false;
    const std::size_t count = model_.accessors[std::size_t(accessor)].count;
    if (count > left_) return false;
    left_ -= count;
    return true;
  }

 private:
  const tinygltf::Model& model_;
  std::set<int> seen_;
  std::size_t left_ = std::size_t{1} << 26;
};

void look_at_primitives(const tinygltf::Model& model, std::vector<std::string>& warnings) {
  Unseen positions(model), indices(model);
  Fault unread_types, restarts, bounds;
  for_each_primitive(model, [&](const tinygltf::Primitive& primitive, std::size_t m, std::size_t p) {
    for (const auto& [name, accessor] : primitive.attributes) {
      if (!is_there(model, accessor)) continue;
      const auto use = use_of(name);
      if (use && !has_allowed_type(model, model.accessors[std::size_t(accessor)], *use))
        unread_types.add(name_of_primitive(m, p) + "." + name + ", " +
                         type_name(model.accessors[std::size_t(accessor)]));
      if (use == AccessorUse::position && positions.take(accessor) && has_false_bounds(model, accessor))
        bounds.add("accessor " + std::to_string(accessor));
    }
    if (indices.take(primitive.indices) && has_restart(model, primitive.indices))
      restarts.add(name_of_primitive(m, p));
  });
  warn(warnings, unread_types, "attributes have a type that glTF does not allow for them");
  warn(warnings, restarts,
       "index lists contain the value that restarts primitives, which glTF "
       "forbids; it was read as the index of a vertex");
  warn(warnings, bounds,
       "accessors of positions have a min and max that do not match their values; min and max were ignored");
}

}  // namespace

void check_types(const tinygltf::Model& model) {
  for_each_primitive(model, [&](const tinygltf::Primitive& primitive, std::size_t m, std::size_t p) {
    check_primitive_types(model, primitive, name_of_primitive(m, p));
  });
  for (std::size_t s = 0; s < model.skins.size(); ++s)
    require_allowed_type(model, model.skins[s].inverseBindMatrices, AccessorUse::inverse_bind,
                         "skin " + std::to_string(s) + " inverse bind matrices");
  for (std::size_t a = 0; a < model.animations.size(); ++a)
    check_animation_types(model, model.animations[a], "animation " + std::to_string(a));
}

std::vector<std::string> document_warnings(const tinygltf::Model& model) {
  std::vector<std::string> warnings;
  look_at_nodes(model, warnings);
  look_at_skins(model, warnings);
  look_at_primitives(model, warnings);
  return warnings;
}

}  // namespace nook::bake
