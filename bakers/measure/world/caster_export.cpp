#include "bakers/measure/world/caster_export.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bakers/world/posed_casters.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr float centimetres = 100, inches = 1 / 0.0254f;
constexpr float degrees = 180 / std::numbers::pi_v<float>;

template <class... Values>
void add(std::string& text, const char* format, Values... values) {
  char line[400];
  const int length = std::snprintf(line, sizeof line, format, values...);
  text.append(line, std::size_t(std::clamp(length, 0, int(sizeof line) - 1)));
}

// Puts a name in quotes, and removes characters that would end the quotes.
std::string quoted(const String& name) {
  std::string text = "\"";
  for (const char c : name)
    if (c != '"' && c != '\\' && static_cast<unsigned char>(c) >= 32) text.push_back(c);
  text.push_back('"');
  return text;
}

void require_exportable(const CharacterModel& model) {
  if (model.world_casters.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the model has no world casters; bake the character again");
  if (model.bind.empty())
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the model does not contain the joint spaces of its bones; bake the character from its glTF file");
}

float ao_factor(const WorldCaster& caster, CasterRadii radii) {
  return radii == CasterRadii::ao ? caster.ao_scale : 1;
}

// Transforms a capsule from rest space to the space of the bone's joint. The radii stay in metres, because
// the scale of a joint only converts units.
Capsule in_joint(const CharacterModel& model, const WorldCaster& caster, const Capsule& capsule) {
  const Mat3x4& m = model.bind.bones[caster.bone].node_from_rest;
  const float scale = scale_of(m);
  return {transform_point(m, capsule.a), transform_point(m, capsule.b), scale * capsule.radius_a,
          scale * capsule.radius_b};
}

// Groups the indices of casters by bone.
std::vector<std::vector<std::size_t>> by_bone(const CharacterModel& model) {
  std::vector<std::vector<std::size_t>> casters(model.bone_count());
  for (std::size_t i = 0; i < model.world_casters.size(); ++i)
    casters[model.world_casters[i].bone].push_back(i);
  return casters;
}

// Converts a position to Unreal's axes, which are left-handed with z up. Unreal's importers swap y and z of
// every joint.
Vec3 unreal_axes(Vec3 p) {
  return centimetres * Vec3{p.x, p.z, p.y};
}

void add_unreal_capsule(std::string& text, const Capsule& c) {
  const Vec3 a = unreal_axes(c.a), b = unreal_axes(c.b), middle = 0.5f * (a + b);
  Vec3 axis = normalised(b - a);
  if (axis.z < 0) axis = -1 * axis;
  // The capsule's axis is the z axis, turned by pitch and then by yaw.
  const float across = std::sqrt(axis.x * axis.x + axis.y * axis.y);
  const float pitch = degrees * std::atan2(across, axis.z),
              yaw = across > 0 ? degrees * std::atan2(-axis.y, -axis.x) : 0;
  add(text,
      "(Center=(X=%.4f,Y=%.4f,Z=%.4f),Rotation=(Pitch=%.4f,Yaw=%.4f,Roll=0.0000),Radius=%.4f,Length=%.4f)",
      double(middle.x), double(middle.y), double(middle.z), double(pitch), double(yaw),
      double(centimetres * c.radius_a), double(length(b - a)));
}

std::string unreal_text(const CharacterModel& model, std::span<const Capsule> capsules) {
  std::string text;
  const auto bones = by_bone(model);
  int body = 0;
  for (std::size_t bone = 0; bone < bones.size(); ++bone) {
    if (bones[bone].empty()) continue;
    add(text, "Begin Object Class=/Script/Engine.SkeletalBodySetup Name=\"SkeletalBodySetup_%d\"\n", body++);
    text += "   AggGeom=(SphylElems=(";
    for (std::size_t i = 0; i < bones[bone].size(); ++i) {
      if (i) text += ",";
      const std::size_t k = bones[bone][i];
      add_unreal_capsule(text, in_joint(model, model.world_casters[k], capsules[k]));
    }
    text += "))\n   BoneName=";
    text += quoted(model.bone_names[bone]);
    text += "\n   CollisionReponse=BodyCollision_Disabled\nEnd Object\n";
  }
  return text;
}

std::string source2_text(const CharacterModel& model, std::span<const Capsule> capsules) {
  std::string text = "{\n\t_class = \"PhysicsShapeList\"\n\tchildren =\n\t[\n";
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    const WorldCaster& caster = model.world_casters[k];
    const Capsule c = in_joint(model, caster, capsules[k]);
    const Vec3 a = inches * c.a, b = inches * c.b;
    text += "\t\t{\n\t\t\t_class = \"PhysicsShapeCapsule\"\n\t\t\tparent_bone = ";
    text += quoted(model.bone_names[caster.bone]);
    add(text,
        "\n\t\t\tradius = %.5f\n\t\t\tpoint0 = [ %.5f, %.5f, %.5f ]\n\t\t\tpoint1 = [ %.5f, %.5f, %.5f ]\n",
        double(inches * c.radius_a), double(a.x), double(a.y), double(a.z), double(b.x), double(b.y),
        double(b.z));
    add(text, "\t\t\tname = \"nook_%zu\"\n\t\t},\n", k);
  }
  text += "\t]\n}\n";
  return text;
}

// Returns the name as a JSON string. Escapes do not change the name itself, so that an engine finds the node
// by it.
std::string json_string(const String& name) {
  using Json = nlohmann::json;
  return Json(std::string(name.data(), name.size())).dump(-1, ' ', false, Json::error_handler_t::replace);
}

// The only member that glTF requires is "asset".
std::string gltf_text(const CharacterModel& model) {
  std::string text =
      "{\n  \"asset\": {\"version\": \"2.0\", \"generator\": \"nook export casters\"},\n"
      "  \"extras\": {\n    \"nook_world_casters\": [\n";
  for (std::size_t k = 0; k < model.world_casters.size(); ++k) {
    const WorldCaster& caster = model.world_casters[k];
    const Capsule c = in_joint(model, caster, caster.capsule);
    text += "      {\"joint\": ";
    text += json_string(model.bone_names[caster.bone]);
    add(text,
        ", \"a\": [%.6g, %.6g, %.6g], \"radius_a\": %.6g, \"b\": [%.6g, %.6g, %.6g], \"radius_b\": %.6g, "
        "\"ao_scale\": %.6g}%s\n",
        double(c.a.x), double(c.a.y), double(c.a.z), double(c.radius_a), double(c.b.x), double(c.b.y),
        double(c.b.z), double(c.radius_b), double(caster.ao_scale),
        k + 1 < model.world_casters.size() ? "," : "");
  }
  text += "    ]\n  }\n}\n";
  return text;
}

// Returns the comment that goes before the text for Unreal and Source 2. The glTF form has a member for this
// purpose instead.
std::string note_of(const ExportError& error, CasterRadii radii) {
  std::string text;
  add(text,
      "capsules with one radius, fitted to %s; AO on the floor below the rest pose: rms %.5f, at most %.5f",
      radii == CasterRadii::ao ? "AO" : "light", error.rms, error.largest);
  return text;
}

}  // namespace

std::vector<Capsule> engine_capsules(const CharacterModel& model, CasterFormat format, CasterRadii radii) {
  std::vector<Capsule> capsules;
  for (const WorldCaster& caster : model.world_casters) {
    Capsule c = caster.capsule;
    const float factor = ao_factor(caster, radii);
    c.radius_a *= factor;
    c.radius_b *= factor;
    if (format != CasterFormat::gltf) {
      // The mean projected area of a convex body is a quarter of its surface area (Cauchy). A cone frustum
      // has about the lateral area of a cylinder with the mean radius.
      const float half = 0.5f * length(c.b - c.a);
      const float area = half * 0.5f * (c.radius_a + c.radius_b) +
                         0.5f * (c.radius_a * c.radius_a + c.radius_b * c.radius_b);
      c.radius_a = c.radius_b = 0.5f * (std::sqrt(half * half + 4 * area) - half);
    }
    capsules.push_back(c);
  }
  return capsules;
}

ExportError export_error(const CharacterModel& model, CasterFormat format, CasterRadii radii) {
  const std::vector<Capsule> own = engine_capsules(model, CasterFormat::gltf, CasterRadii::ao),
                             written = engine_capsules(model, format, radii);
  ExportError error;
  if (own.empty()) return error;
  float floor = INFINITY;
  Vec3 middle;
  for (const Capsule& c : own) {
    floor = std::min({floor, c.a.y - c.radius_a, c.b.y - c.radius_b});
    middle += (0.5f / float(own.size())) * (c.a + c.b);
  }
  constexpr int side = 60;
  constexpr float step_m = 0.05f;
  double error2 = 0, none2 = 0;
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x) {
      const Vec3 point{middle.x + step_m * (float(x) - 0.5f * side), floor,
                       middle.z + step_m * (float(z) - 0.5f * side)};
      const double ao = double(open_share(own, point, {0, 1, 0})),
                   off = double(open_share(written, point, {0, 1, 0})) - ao;
      error2 += off * off;
      none2 += (1 - ao) * (1 - ao);
      error.largest = std::max(error.largest, std::abs(off));
    }
  error.rms = std::sqrt(error2 / (side * side));
  error.over_none = none2 > 0 ? error2 / none2 : 0;
  return error;
}

std::string export_casters(const CharacterModel& model, CasterFormat format, CasterRadii radii) {
  require_exportable(model);
  if (format == CasterFormat::gltf) return gltf_text(model);
  const std::vector<Capsule> capsules = engine_capsules(model, format, radii);
  const std::string note = note_of(export_error(model, format, radii), radii);
  std::string text = format == CasterFormat::unreal ? "; " : "// ";
  text += note;
  text += "\n";
  text += format == CasterFormat::unreal ? unreal_text(model, capsules) : source2_text(model, capsules);
  return text;
}

}  // namespace nook::measure
