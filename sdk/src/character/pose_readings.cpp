#include "sdk/src/character/pose_check.h"

#include <iterator>
#include <utility>

namespace nook {
namespace {

const char* kind_name(nook_pose_kind kind) {
  constexpr const char* names[] = {"rest-to-world matrices", "joint world matrices", "skinning matrices"};
  static_assert(std::size(names) == NOOK_POSE_SKINNING + 1);
  return names[kind];
}

nook_transform_layout transposed(nook_transform_layout layout) {
  switch (layout) {
    case NOOK_TRANSFORM_ROWS_3X4:
      return NOOK_TRANSFORM_COLUMNS_4X3;
    case NOOK_TRANSFORM_COLUMNS_4X3:
      return NOOK_TRANSFORM_ROWS_3X4;
    case NOOK_TRANSFORM_ROWS_4X4:
      return NOOK_TRANSFORM_COLUMNS_4X4;
    case NOOK_TRANSFORM_COLUMNS_4X4:
      return NOOK_TRANSFORM_ROWS_4X4;
    default:
      return layout;
  }
}

// Returns the transform index of each bone for a host whose transforms are in the order of a skin's joints.
Vector<std::int32_t> map_of_skin(const CharacterModel& model, std::uint32_t skin, Memory* memory) {
  const SkinBind& bind = model.bind.skins[skin];
  Vector<std::int32_t> out(model.bone_count(), std::int32_t{-1}, memory);
  for (std::uint32_t j = 0; j < bind.joint_count; ++j)
    out[model.bind.bone_of_joint[bind.first_joint + j]] = static_cast<std::int32_t>(j);
  return out;
}

void add_skins(const CharacterModel& model, const PoseSource& given, Memory* memory, Vector<Reading>& out) {
  for (std::uint32_t skin = 0; skin < model.bind.skins.size(); ++skin) {
    if (given.kind == NOOK_POSE_SKINNING && skin == given.skin) continue;
    Reading reading(given, memory);
    reading.source.kind = NOOK_POSE_SKINNING;
    reading.source.skin = skin;
    reading.fault = given.kind == NOOK_POSE_SKINNING        ? NOOK_POSE_FAULT_SKIN
                    : given.kind == NOOK_POSE_REST_TO_WORLD ? NOOK_POSE_FAULT_NO_BIND
                                                            : NOOK_POSE_FAULT_KIND;
    out.push_back(reading);
    // The host may have passed the matrices of this skin, but in the joint order of the skin that it
    // specified.
    if (given.kind != NOOK_POSE_SKINNING || !given.transform_of_bone.empty()) continue;
    reading.map = map_of_skin(model, given.skin, memory);
    out.push_back(reading);
  }
}

// Adds the readings with another kind of transforms or another skin, the most likely one first. If the host
// passed the wrong kind, its transforms may be in the order of the bones or in the order of the skin's
// joints.
void add_kinds(const CharacterModel& model, const PoseSource& given, Memory* memory, Vector<Reading>& out) {
  add_skins(model, given, memory, out);
  for (const nook_pose_kind kind : {NOOK_POSE_JOINT_TO_WORLD, NOOK_POSE_REST_TO_WORLD}) {
    if (kind == given.kind) continue;
    Reading reading(given, memory);
    reading.source.kind = kind;
    reading.fault = NOOK_POSE_FAULT_KIND;
    if (given.kind == NOOK_POSE_SKINNING && given.transform_of_bone.empty())
      reading.map = map_of_skin(model, given.skin, memory);
    out.push_back(reading);
    if (reading.map.empty()) continue;
    reading.map.clear();
    out.push_back(reading);
  }
}

void add_transposed(const PoseSource& given, Memory* memory, Vector<Reading>& out) {
  Reading other(given, memory);
  other.fault = NOOK_POSE_FAULT_TRANSPOSED;
  if (transposed(given.layout) != given.layout) {
    other.source.layout = transposed(given.layout);
    other.is_transposed = true;
    out.push_back(other);
    other = Reading(given, memory);
    other.fault = NOOK_POSE_FAULT_TRANSPOSED;
  }
  other.is_turned_back = true;
  out.push_back(other);
}

}  // namespace

Affine read_transform(const Reading& reading, std::uint32_t index) {
  Affine m = read_transform(reading.source, index);
  if (reading.is_turned_back) {
    std::swap(m.m[1], m.m[4]);
    std::swap(m.m[2], m.m[8]);
    std::swap(m.m[6], m.m[9]);
  }
  if (reading.is_inverted) m = inverse(m);
  for (int i = 0; reading.mirrored_axis >= 0 && i < 12; ++i)
    if ((i / 4 == reading.mirrored_axis) != (i % 4 == reading.mirrored_axis)) m.m[i] = -m.m[i];
  for (int i = 3; i < 12; i += 4) m.m[i] *= reading.translation_scale;
  return m;
}

Vector<Reading> other_readings(const CharacterModel& model, const PoseSource& given, Memory* memory) {
  Vector<Reading> out(memory);
  add_kinds(model, given, memory, out);
  add_transposed(given, memory, out);
  Reading other(given, memory);
  other.is_inverted = true;
  other.fault = NOOK_POSE_FAULT_INVERTED;
  out.push_back(other);
  for (const int axis : {2, 0, 1}) {
    other = Reading(given, memory);
    other.mirrored_axis = axis;
    other.fault = NOOK_POSE_FAULT_PLACE;
    out.push_back(other);
  }
  // Tries centimetres, millimetres, inches and feet instead of metres, and metres instead of each of these.
  for (const double unit : {100.0, 0.01, 1000.0, 0.001, 1 / 0.0254, 0.0254, 1 / 0.3048, 0.3048}) {
    other = Reading(given, memory);
    other.translation_scale = unit;
    other.fault = NOOK_POSE_FAULT_UNIT;
    out.push_back(other);
  }
  return out;
}

namespace {

const char* layout_name(nook_transform_layout layout) {
  constexpr const char* names[] = {"NOOK_TRANSFORM_ROWS_3X4",        "NOOK_TRANSFORM_ROWS_4X4",
                                   "NOOK_TRANSFORM_COLUMNS_4X4",     "NOOK_TRANSFORM_COLUMNS_4X3",
                                   "NOOK_TRANSFORM_DUAL_QUATERNION", "NOOK_TRANSFORM_TRS"};
  static_assert(std::size(names) == NOOK_TRANSFORM_TRS + 1);
  return names[layout];
}

// Returns true for layouts with rows of four numbers. A fourth row is ignored, so these layouts are read in
// the same way.
bool has_rows(nook_transform_layout layout) {
  return layout == NOOK_TRANSFORM_ROWS_3X4 || layout == NOOK_TRANSFORM_ROWS_4X4;
}

bool is_read_alike(nook_transform_layout a, nook_transform_layout b) {
  return a == b || (has_rows(a) && has_rows(b));
}

void add_layout(const PoseSource& given, nook_transform_layout layout, std::size_t stride, Memory* memory,
                Vector<Reading>& out) {
  const std::size_t bytes = floats_of_layout(layout) * sizeof(float);
  const std::size_t of_host =
      (given.given_count - 1) * given.stride + floats_of_layout(given.layout) * sizeof(float);
  if (stride < bytes || bytes > of_host || (is_read_alike(layout, given.layout) && stride == given.stride))
    return;
  Reading reading(given, memory);
  reading.source.layout = layout;
  reading.source.stride = stride;
  reading.readable_count = static_cast<std::uint32_t>((of_host - bytes) / stride + 1);
  reading.is_laid_out_otherwise = true;
  // nook_pose_fault has no value for a wrong layout, except for swapped rows and columns.
  reading.fault = has_rows(layout) != has_rows(given.layout) && layout <= NOOK_TRANSFORM_COLUMNS_4X3 &&
                          given.layout <= NOOK_TRANSFORM_COLUMNS_4X3
                      ? NOOK_POSE_FAULT_TRANSPOSED
                      : NOOK_POSE_FAULT_UNKNOWN;
  out.push_back(reading);
}

}  // namespace

// First come readings with the host's own layout and other strides. Then come all other layouts, each with
// the host's stride and tightly packed. The strides 48 and 64 belong to 3x4 and 4x4 matrices.
Vector<Reading> readings_of_other_layouts(const PoseSource& given, Memory* memory) {
  Vector<Reading> out(memory);
  const auto bytes_of = [](nook_transform_layout layout) { return floats_of_layout(layout) * sizeof(float); };
  for (const std::size_t stride : {bytes_of(given.layout), std::size_t{48}, std::size_t{64}})
    if (out.empty() || out.back().source.stride != stride)
      add_layout(given, given.layout, stride, memory, out);
  for (nook_transform_layout layout = NOOK_TRANSFORM_ROWS_3X4; layout <= NOOK_TRANSFORM_TRS; ++layout) {
    if (layout == given.layout) continue;
    add_layout(given, layout, given.stride, memory, out);
    if (bytes_of(layout) != given.stride) add_layout(given, layout, bytes_of(layout), memory, out);
  }
  return out;
}

// If the layout and the kind are both wrong, correcting only one of them does not help. So each other kind is
// also tried with the transposed layout.
Vector<Reading> readings_of_two_mistakes(const CharacterModel& model, const PoseSource& given,
                                         Memory* memory) {
  Vector<Reading> out(memory);
  if (transposed(given.layout) == given.layout) return out;
  add_kinds(model, given, memory, out);
  for (Reading& reading : out) {
    reading.source.layout = transposed(given.layout);
    reading.is_transposed = true;
    reading.fault = NOOK_POSE_FAULT_TRANSPOSED;
  }
  return out;
}

namespace {

void describe_transposed(const PoseSource& given, const Reading& reading, PoseFinding& finding) {
  const PoseSource& source = reading.source;
  if (source.kind != given.kind)
    explain(finding, NOOK_POSE_FAULT_TRANSPOSED,
            "the transforms are transposed, and they are %s; set desc.layout and desc.kind",
            kind_name(source.kind));
  else if (reading.is_turned_back)
    explain(finding, NOOK_POSE_FAULT_TRANSPOSED,
            "the rotations are transposed, but the translations are right; transpose the rotations");
  else
    explain(
        finding, NOOK_POSE_FAULT_TRANSPOSED,
        "the transforms are transposed: rows were passed as columns, or columns as rows; set desc.layout");
}

void describe_layout(const PoseSource& given, const Reading& reading, PoseFinding& finding) {
  const PoseSource& source = reading.source;
  if (source.layout == given.layout)
    explain(finding, reading.fault, "the transforms are %zu bytes apart, not %zu; set desc.stride",
            source.stride, given.stride);
  else if (source.stride == given.stride)
    explain(finding, reading.fault, "the transforms have the layout %s, not %s; set desc.layout",
            layout_name(source.layout), layout_name(given.layout));
  else
    explain(finding, reading.fault,
            "the transforms have the layout %s and are %zu bytes apart, not %s and %zu; set desc.layout and "
            "desc.stride",
            layout_name(source.layout), source.stride, layout_name(given.layout), given.stride);
}

}  // namespace

void describe(const CharacterModel& model, const PoseSource& given, const Reading& reading,
              PoseFinding& finding) {
  const PoseSource& source = reading.source;
  if (reading.is_laid_out_otherwise) return describe_layout(given, reading, finding);
  const std::uint32_t skin = source.kind == NOOK_POSE_SKINNING ? model.bind.skins[source.skin].file_index : 0;
  switch (reading.fault) {
    case NOOK_POSE_FAULT_TRANSPOSED:
      describe_transposed(given, reading, finding);
      break;
    case NOOK_POSE_FAULT_NO_BIND:
      if (explain(finding, reading.fault,
                  "skinning matrices were passed, but desc.kind says rest-to-world matrices, so the factor "
                  "S^-1 is missing; set desc.kind to NOOK_POSE_SKINNING and desc.skin to %u",
                  skin))
        finding.fitting_skin = skin;
      break;
    case NOOK_POSE_FAULT_SKIN:
      if (explain(finding, reading.fault,
                  "the skinning matrices belong to skin %u, not to skin %u; set desc.skin", skin,
                  model.bind.skins[given.skin].file_index))
        finding.fitting_skin = skin;
      break;
    case NOOK_POSE_FAULT_KIND:
      explain(finding, reading.fault, "the transforms are %s, not %s; set desc.kind", kind_name(source.kind),
              kind_name(given.kind));
      break;
    case NOOK_POSE_FAULT_INVERTED:
      explain(finding, reading.fault,
              "the transforms are inverted: they lead from world space to the joints; pass their inverses");
      break;
    case NOOK_POSE_FAULT_PLACE:
      explain(finding, reading.fault,
              "the transforms are mirrored along %c, as in left-handed engines; negate everything along %c",
              "xyz"[reading.mirrored_axis], "xyz"[reading.mirrored_axis]);
      break;
    case NOOK_POSE_FAULT_UNIT:
      if (explain(
              finding, reading.fault,
              "the translations are in another unit than the vertices: they match when multiplied by %.6g",
              reading.translation_scale))
        finding.scale = reading.translation_scale;
      break;
    default:
      break;
  }
}

}  // namespace nook
