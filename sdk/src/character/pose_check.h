// Compares a pose with vertices that the host skinned itself. If they differ, finds the host's most likely
// mistake.
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

// The results of the check, for nook_pose_check_info.
struct PoseFinding {
  nook_pose_fault fault = NOOK_POSE_FAULT_NONE;
  double max_error = 0, rms_error = 0;  // divided by the bounding radius times the scale of the pose
  std::uint32_t worst_bone = 0;
  std::uint32_t fitting_skin = 0;
  double scale = 1;
  char text[512] = {};
};

// Adds a fault that explains the difference. Add the most likely fault first. Each further fault is only
// appended to the text, if there is room for it. Returns true if this was the first fault.
bool explain(PoseFinding& finding, nook_pose_fault fault, const char* format, ...) NOOK_PRINTF(3, 4);

// One way to interpret the host's transforms. If the host made a mistake, the vertices match a different
// reading than the one that the host declared.
struct Reading {
  PoseSource source;
  Vector<std::int32_t> map;     // transform of each bone, replaces the source's map; empty: use the source's
                                // map
  bool is_transposed = false;   // rows and columns of the layout are swapped
  bool is_turned_back = false;  // the 3x3 part is transposed, but not the translation
  bool is_inverted = false;
  int mirrored_axis = -1;  // the axis that is mirrored both before and after the transform; -1: none
  double translation_scale = 1;
  std::uint32_t readable_count =
      ~0u;  // only transforms below this index lie in the memory that the host gave
  bool is_laid_out_otherwise = false;  // the same bytes in another layout or with another stride
  nook_pose_fault fault = NOOK_POSE_FAULT_NONE;

  Reading(const PoseSource& as_given, Memory* memory) : source(as_given), map(memory) {}
};

Affine read_transform(const Reading& reading, std::uint32_t index);

// other_readings returns the readings that differ from the host's own reading by one mistake, except for
// wrong layouts. readings_of_other_layouts reads the same bytes with other layouts and strides.
// readings_of_two_mistakes returns the readings that differ by two mistakes. The most likely reading comes
// first.
Vector<Reading> other_readings(const CharacterModel& model, const PoseSource& given, Memory* memory);
Vector<Reading> readings_of_other_layouts(const PoseSource& given, Memory* memory);
Vector<Reading> readings_of_two_mistakes(const CharacterModel& model, const PoseSource& given,
                                         Memory* memory);

// Adds to the finding that `reading` is the correct way to interpret the host's transforms.
void describe(const CharacterModel& model, const PoseSource& given, const Reading& reading,
              PoseFinding& finding);

// Sets of points in space, and the map from one set to another.

using Point3 = std::array<double, 3>;

double distance(const Point3& a, const Point3& b);

// Returns the root mean square distance of the points from their mean, or 0 if there are no points.
double spread(std::span<const Point3> points);

// The input of explain_by_place: the vertices that the model poses, the vertices that the host skinned, and
// the place matrices of both.

struct PosedPoints {
  std::span<const Point3> posed;  // posed by the model, with pose_place applied
  std::span<const Point3> host;
  double tolerance_ws = 0;
  Affine pose_place, vertex_place;  // the identity if the host gave none
};

// Tries to explain the difference by a wrong place, or by a wrong rotation, mirroring or unit of length of
// the whole pose. Returns false if none of these explains it.
bool explain_by_place(const PosedPoints& points, PoseFinding& finding);

// A vertex of BindData::vertices, and its world position after the host's skinning.
struct SkinnedVertex {
  std::uint32_t rest_vertex = 0;
  std::array<double, 3> position_ws{};
};

// vertex_place must already be applied to the vertices, and `source` must have passed check_pose_source.
// Distances up to `tolerance`, relative to the bounding radius, are treated as equal. Throws Failure in the
// same cases as for_each_transform, and if no vertex has transforms for all of its bones.
PoseFinding find_pose_fault(const CharacterModel& model, const PoseSource& source,
                            std::span<const SkinnedVertex> vertices, const Affine& vertex_place,
                            double tolerance, Memory* memory);

}  // namespace nook
