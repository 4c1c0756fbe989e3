#include "bakers/character/rig_file.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> side_names{"none", "left", "right"};
constexpr std::int32_t most_limbs = 65535;

[[noreturn]] void refuse(const std::string& what) {
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "rig file: %s", what.c_str());
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::uint32_t bone_named(const SkinnedMesh& mesh, const std::string& name) {
  std::int64_t found = -1;
  for (std::size_t b = 0; b < mesh.bones.size(); ++b) {
    if (mesh.bones[b].name != name) continue;
    if (found >= 0) refuse("two bones are named \"" + name + "\"; give each bone its own name");
    found = std::int64_t(b);
  }
  if (found < 0)
    refuse("no bone is named \"" + name + "\" (the rig has " + std::to_string(mesh.bones.size()) +
           " bones); list them with `nook inspect FILE --rig`");
  return std::uint32_t(found);
}

JointRole role_of(const std::string& bone, const Json& value) {
  const std::string name = value.is_string() ? value.get<std::string>() : value.dump();
  if (const auto role = role_named(name)) return *role;
  std::vector<std::string> known;
  for (std::size_t r = 0; r < joint_role_count; ++r) known.push_back(name_of(JointRole(r)));
  refuse("bone \"" + bone + "\": unknown role (got " + name + ", need one of " + list_of(known) + ")");
}

Side side_of(const std::string& bone, const Json& value) {
  const std::string name = value.is_string() ? value.get<std::string>() : value.dump();
  const auto found = std::find(side_names.begin(), side_names.end(), name);
  if (found == side_names.end())
    refuse("bone \"" + bone + "\": unknown side (got " + name + ", need left, right or none)");
  return Side(found - side_names.begin());
}

std::int32_t limb_of(const std::string& bone, const Json& value) {
  if (!value.is_number_integer() || value < -1 || value > most_limbs)
    refuse("bone \"" + bone + "\": limb is not a valid limb number (got " + value.dump() +
           ", need -1 for none, or 0 to " + std::to_string(most_limbs) + ")");
  return value.get<std::int32_t>();
}

std::int32_t parent_of(const SkinnedMesh& mesh, const std::string& bone, const Json& value) {
  if (value.is_null()) return -1;
  if (!value.is_string())
    refuse("bone \"" + bone + "\": parent is not a name (got " + value.dump() +
           "); give the name of a bone, or null");
  return std::int32_t(bone_named(mesh, value.get<std::string>()));
}

BoneCorrection correction_of(const SkinnedMesh& mesh, const std::string& bone, const Json& entries) {
  BoneCorrection c;
  c.bone = bone_named(mesh, bone);
  if (!entries.is_object()) refuse("bone \"" + bone + "\" is not an object (got " + entries.dump() + ")");
  for (const auto& [key, value] : entries.items()) {
    if (key == "role")
      c.role = role_of(bone, value);
    else if (key == "side")
      c.side = side_of(bone, value);
    else if (key == "limb")
      c.limb = limb_of(bone, value);
    else if (key == "parent")
      c.parent = parent_of(mesh, bone, value);
    else
      refuse("bone \"" + bone + "\": unknown key \"" + key + "\" (need role, side, limb or parent)");
  }
  return c;
}

void refuse_rings(const SkinnedMesh& mesh, const RigCorrections& corrections) {
  std::vector<std::int32_t> parent;
  for (const Bone& bone : mesh.bones) parent.push_back(bone.parent);
  for (const BoneCorrection& c : corrections)
    if (c.parent) parent[c.bone] = *c.parent;
  for (const BoneCorrection& c : corrections) {
    std::size_t steps = 0;
    for (std::int32_t at = std::int32_t(c.bone); at >= 0; at = parent[std::size_t(at)])
      if (++steps > parent.size())
        refuse("bone \"" + mesh.bones[c.bone].name +
               "\" is its own ancestor; correct the parents in the rig file");
  }
}

}  // namespace

RigCorrections read_rig(const SkinnedMesh& mesh, std::string_view text) {
  Json j;
  try {
    j = Json::parse(text);
  } catch (const std::exception& e) {
    refuse(std::string("the file is not JSON (") + e.what() + ")");
  }
  if (!j.is_object() || !j.contains("bones") || !j.at("bones").is_object())
    refuse("the file has no object \"bones\"; see `docs/character.md`, Rig files");
  for (const auto& [key, value] : j.items())
    if (key != "bones") refuse("unknown key \"" + key + "\" (need bones)");
  if (j.at("bones").empty()) refuse("\"bones\" is empty; name at least one bone");
  RigCorrections corrections;
  for (const auto& [bone, entries] : j.at("bones").items())
    corrections.push_back(correction_of(mesh, bone, entries));
  refuse_rings(mesh, corrections);
  return corrections;
}

std::string rig_text(const SkinnedMesh& mesh, const RigCorrections& corrections) {
  if (corrections.empty()) return {};
  Json bones = Json::object();
  for (const BoneCorrection& c : corrections) {
    Json entries = Json::object();
    if (c.role) entries["role"] = name_of(*c.role);
    if (c.side) entries["side"] = side_names[std::size_t(*c.side)];
    if (c.limb) entries["limb"] = *c.limb;
    if (c.parent)
      entries["parent"] = *c.parent >= 0 ? Json(mesh.bones[std::size_t(*c.parent)].name) : Json(nullptr);
    bones[mesh.bones[c.bone].name] = std::move(entries);
  }
  return Json{{"bones", std::move(bones)}}.dump();
}

}  // namespace nook::bake
