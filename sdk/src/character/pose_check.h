// Compares a pose with vertices that the host skinned itself, and finds out what is likely wrong.
#pragma once

#include <nook/nook_character.h>

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/character/pose_source.h"
#include "sdk/src/core/affine.h"
#include "sdk/src/core/compiler.h"
#include "sdk/src/core/memory.h"

namespace nook {

// The answers of nook_pose_check_info.
struct PoseFinding {
  nook_pose_fault fault = NOOK_POSE_FAULT_NONE;
  double max_error = 0, rms_error = 0;  // shares of the bounding radius times the scale of the pose
  std::uint32_t worst_bone = 0;
  std::uint32_t fitting_skin = 0;
  double scale = 1;
  char text[512] = {};
};

// Puts the text, which is cut where it is too long.
void say(PoseFinding& finding, const char* format, ...) NOOK_PRINTF(2, 3);

// The ways to read a host's transforms, of which mistakes take one for another.

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

// Sets of points in space, and the map that leads from one set to another.

using Point3 = std::array<double, 3>;

double distance(const Point3& a, const Point3& b);

// The root mean square distance of points from their mean; 0 for no points.
double spread(std::span<const Point3> points);

// The affine map from one set to another of as many points that is best in the least-squares sense. Returns
// false where the first lie in a plane.
bool best_map(std::span<const Point3> from, std::span<const Point3> to, Affine& map);

// The scale of a map that is a similarity, mirrored or not, to 1 %; else 0.
double scale_of_similarity(const Affine& map);

// The turn of a similarity of a known scale, degrees.
double turn_degrees(const Affine& map, double scale);

// A vertex of BindData::vertices and where the host's skinning puts it, in the world.
struct SkinnedVertex {
  std::uint32_t rest_vertex = 0;
  std::array<double, 3> position_ws{};
};

// Distances up to `tolerance`, a share of the bounding radius, count as equal.  Throws Failure if no vertex
// hangs on bones with transforms alone, or as for_each_transform does. The source must have passed
// check_pose_source.
PoseFinding find_pose_fault(const CharacterModel& model, const PoseSource& source,
                            std::span<const SkinnedVertex> vertices, double tolerance, Memory* memory);

}  // namespace nook
