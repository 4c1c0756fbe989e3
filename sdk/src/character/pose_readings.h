// The ways to read a host's transforms, of which mistakes take one for another.
#pragma once

#include "sdk/src/character/pose_finding.h"
#include "sdk/src/character/pose_source.h"
#include "sdk/src/core/affine.h"
#include "sdk/src/core/memory.h"

namespace nook {

// One way to read the host's transforms.
struct Reading {
  PoseSource source;
  bool is_turned_back = false;  // the 3x3 part is transposed, the translation stays
  bool is_inverted = false;
  double translation_scale = 1;
  nook_pose_fault fault = NOOK_POSE_FAULT_NONE;
};

Affine read_transform(const Reading& reading, std::uint32_t index);

// All but the one that the host gives, the likeliest first.
Vector<Reading> other_readings(const CharacterModel& model, const PoseSource& given, Memory* memory);

// Says that the host's transforms are right when read so.
void describe(const CharacterModel& model, const PoseSource& given, const Reading& reading,
              PoseFinding& finding);

}  // namespace nook
