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

// The readings of another kind or skin, the likeliest first.
void add_kinds(const CharacterModel& model, const PoseSource& given, Vector<Reading>& out) {
  for (std::uint32_t skin = 0; skin < model.bind.skins.size(); ++skin) {
    Reading reading{given};
    reading.source.kind = NOOK_POSE_SKINNING;
    reading.source.skin = skin;
    if (given.kind == NOOK_POSE_SKINNING && skin == given.skin) continue;
    reading.fault = given.kind == NOOK_POSE_SKINNING        ? NOOK_POSE_FAULT_SKIN
                    : given.kind == NOOK_POSE_REST_TO_WORLD ? NOOK_POSE_FAULT_NO_BIND
                                                            : NOOK_POSE_FAULT_KIND;
    out.push_back(reading);
  }
  for (const nook_pose_kind kind : {NOOK_POSE_REST_TO_WORLD, NOOK_POSE_JOINT_TO_WORLD}) {
    if (kind == given.kind) continue;
    Reading reading{given};
    reading.source.kind = kind;
    reading.fault = NOOK_POSE_FAULT_KIND;
    out.push_back(reading);
  }
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
  for (int i = 3; i < 12; i += 4) m.m[i] *= reading.translation_scale;
  return m;
}

Vector<Reading> other_readings(const CharacterModel& model, const PoseSource& given, Memory* memory) {
  Vector<Reading> out(memory);
  add_kinds(model, given, out);
  Reading other{given};
  other.source.layout = transposed(given.layout);
  other.fault = NOOK_POSE_FAULT_TRANSPOSED;
  if (other.source.layout != given.layout) out.push_back(other);
  other = Reading{given};
  other.is_turned_back = true;
  other.fault = NOOK_POSE_FAULT_TRANSPOSED;
  out.push_back(other);
  other = Reading{given};
  other.is_inverted = true;
  other.fault = NOOK_POSE_FAULT_INVERTED;
  out.push_back(other);
  // Centimetres, millimetres, inches and feet against metres, both ways round.
  for (const double unit : {100.0, 0.01, 1000.0, 0.001, 1 / 0.0254, 0.0254, 1 / 0.3048, 0.3048}) {
    other = Reading{given};
    other.translation_scale = unit;
    other.fault = NOOK_POSE_FAULT_UNIT;
    out.push_back(other);
  }
  // A layout read wrong hides the kind; the two mistakes occur together.
  const std::size_t kinds = out.size();
  for (std::size_t r = 0; r < kinds && transposed(given.layout) != given.layout; ++r)
    if (out[r].source.kind != given.kind || out[r].source.skin != given.skin) {
      Reading both = out[r];
      both.source.layout = transposed(given.layout);
      both.fault = NOOK_POSE_FAULT_TRANSPOSED;
      out.push_back(both);
    }
  return out;
}

void describe(const CharacterModel& model, const PoseSource& given, const Reading& reading,
              PoseFinding& finding) {
  finding.fault = reading.fault;
  const PoseSource& source = reading.source;
  switch (reading.fault) {
    case NOOK_POSE_FAULT_TRANSPOSED:
      if (source.kind != given.kind)
        say(finding, "the transforms are transposed, and they are %s; give desc.layout and desc.kind",
            kind_name(source.kind));
      else if (reading.is_turned_back)
        say(finding, "the rotations are transposed, while the translations are right");
      else
        say(finding,
            "the transforms are transposed: rows were given as columns or columns as rows; give "
            "desc.layout");
      break;
    case NOOK_POSE_FAULT_NO_BIND:
      finding.fitting_skin = model.bind.skins[source.skin].file_index;
      say(finding,
          "skinning matrices were given as rest-to-world matrices, so that S^-1 is missing; give "
          "NOOK_POSE_SKINNING with skin %u",
          finding.fitting_skin);
      break;
    case NOOK_POSE_FAULT_SKIN:
      finding.fitting_skin = model.bind.skins[source.skin].file_index;
      say(finding, "the skinning matrices are those of skin %u, not of skin %u", finding.fitting_skin,
          model.bind.skins[given.skin].file_index);
      break;
    case NOOK_POSE_FAULT_KIND:
      say(finding, "the transforms are %s, not %s; give desc.kind", kind_name(source.kind),
          kind_name(given.kind));
      break;
    case NOOK_POSE_FAULT_INVERTED:
      say(finding,
          "the transforms are the inverses of what is needed: they lead from the world to the joints");
      break;
    case NOOK_POSE_FAULT_UNIT:
      finding.scale = reading.translation_scale;
      say(finding, "the translations are in another unit than the vertices: they fit when multiplied by %.6g",
          reading.translation_scale);
      break;
    default:
      break;
  }
}

}  // namespace nook
