// Compares a pose with vertices that the host skinned itself, and finds the likely mistake.
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

// Adds a fault that explains the difference. The first one is the likeliest; the text names further ones as
// far as it has room. Returns whether it was the first.
bool explain(PoseFinding& finding, nook_pose_fault fault, const char* format, ...) NOOK_PRINTF(3, 4);

// One way to read the host's transforms. A mistake takes one reading for another.
struct Reading {
  PoseSource source;
  Vector<std::int32_t> map;     // of the bones, in place of the source's map; empty: use the source's
  bool is_transposed = false;   // the layout swaps rows and columns
  bool is_turned_back = false;  // the 3x3 part is transposed, the translation stays
  bool is_inverted = false;
  int mirrored_axis = -1;  // the axis whose sign changes before and after the transform; -1: none
  double translation_scale = 1;
  nook_pose_fault fault = NOOK_POSE_FAULT_NONE;

  Reading(const PoseSource& as_given, Memory* memory) : source(as_given), map(memory) {}
};

Affine read_transform(const Reading& reading, std::uint32_t index);

// Returns all readings except the host's own, the likeliest first: readings with one mistake, and readings
// with two.
Vector<Reading> other_readings(const CharacterModel& model, const PoseSource& given, Memory* memory);
Vector<Reading> readings_of_two_mistakes(const CharacterModel& model, const PoseSource& given,
                                         Memory* memory);

// Says that this reading of the host's transforms is right.
void describe(const CharacterModel& model, const PoseSource& given, const Reading& reading,
              PoseFinding& finding);

// Sets of points in space, and the map that leads from one set to another.

using Point3 = std::array<double, 3>;

double distance(const Point3& a, const Point3& b);

// Returns the root mean square distance of points from their mean; 0 without points.
double spread(std::span<const Point3> points);

// What explain_by_place compares: the model's and the host's vertices, and the places of both.

struct PosedPoints {
  std::span<const Point3> posed;  // by the model, under the pose's place
  std::span<const Point3> host;
  double tolerance_ws = 0;
  Affine pose_place, vertex_place;  // the identity if the host gave none
};

// Explains the difference by a wrong place, or by a turn, mirror image or other unit of the whole pose.
// Returns false if none of them fits.
bool explain_by_place(const PosedPoints& points, PoseFinding& finding);

// A vertex of BindData::vertices, and the world position to which the host's skinning moves it.
struct SkinnedVertex {
  std::uint32_t rest_vertex = 0;
  std::array<double, 3> position_ws{};
};

// Expects vertices that vertex_place has been applied to, and a source that passed check_pose_source.
// Distances up to `tolerance`, a share of the bounding radius, count as equal. Throws Failure if no vertex
// follows only bones with transforms, or for the reasons of for_each_transform.
PoseFinding find_pose_fault(const CharacterModel& model, const PoseSource& source,
                            std::span<const SkinnedVertex> vertices, const Affine& vertex_place,
                            double tolerance, Memory* memory);

}  // namespace nook
