// Measures how a character darkens a neighbour, with one caster at several distances. Compares each form of
// the model with ray tracing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// All means are weighted by area. They are taken over all bearings, all poses, and those vertices of the
// receiver that are outside the neighbour. Darkening is the AO of the body without the neighbour minus its AO
// with the neighbour.
struct CasterRow {
  float distance_m = 0;      // distance between the two bodies' centres, along the ground
  float distance_radii = 0;  // the same distance in bounding radii of the body
  const char* form = "";     // "composed" or "paper"
  double darkening = 0;
  double darkening_traced = 0;
  double mse_over_none = 0;  // mean squared error of the darkening, divided by the error of a method that
                             // never darkens; the noise of the rays is removed from both
  double rms_darkened = 0;   // root mean squared error where the traced darkening is above darkened_from
  // Fraction of the area that is left out, because it is inside the neighbour and no camera sees it.
  double share_inside = 0;
  // The change of AO that the default far_error of a scene causes, as a root mean square over vertices,
  // weighted by area. It includes the effect of grouping the neighbour's spheres and of grouping the body's
  // own far spheres.
  double change_of_groups = 0;

  static constexpr float darkened_from = 0.02f;
};

struct CasterStudy {
  std::vector<float> distances{0.3f, 0.5f, 0.75f, 1, 2, 3, 5, 10};
  bool in_radii = false;  // distances are in bounding radii of the body instead of metres
  std::size_t bearings = 6;
  // Per vertex, traced in two halves; the same rays are used with and without the neighbour.
  std::uint32_t rays = 256;
  std::uint64_t seed = 1;
};

// Converts a distance of the study to metres.
float distance_in_metres(const CasterStudy& study, const CharacterModel& model, float distance);

// Two bodies in world space.
struct BodyPair {
  bake::Pose receiver, caster;
};

// Uses pose `p` for the receiver and the next pose for the caster. Turns the caster, and places it in a
// direction (the bearing) from the receiver's centre.
BodyPair body_pair(const CharacterModel& model, std::span<const bake::Pose> poses, std::size_t p,
                   std::size_t bearing, std::size_t bearings, float distance_m);

// Turns the caster about the vertical axis through its centre, and moves it from the receiver's centre by
// `offset` (x, y and z, metres).
BodyPair body_pair(const CharacterModel& model, const bake::Pose& receiver, const bake::Pose& caster,
                   Vec3 offset, float yaw_radians);

// Returns the ray-traced AO of the receiver's vertices, alone and with the caster.
struct TracedPair {
  std::vector<float> alone, together;
};
TracedPair trace_pair(const bake::SkinnedMesh& mesh, const BodyPair& pair, std::uint32_t rays,
                      std::uint64_t seed);

// Returns the AO that the runtime computes for a receiver with one linked caster. Nothing is culled.
std::vector<float> linked_ao(const CharacterModel& model, const BodyPair& pair);

// Forms one pair for each pose: the receiver has this pose, and the caster has the next pose. Both stand on
// the ground, with +y up. Returns two rows per distance, one for each form.
std::vector<CasterRow> measure_casters(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const bake::Pose> poses, const CasterStudy& study,
                                       const bake::Progress& progress = {});

// Measures one pair. Each body is darkened by the other one, and the means are taken over the vertices of
// both. Returns two rows, one for each form. The distance in these rows is measured along the ground.
std::vector<CasterRow> measure_pair(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                    const BodyPair& pair, const CasterStudy& study);

}  // namespace nook::measure
