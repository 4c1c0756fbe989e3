// Measures how a character darkens a neighbour. One caster stands at several distances. Each form of the
// model is compared with ray tracing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// Means are weighted by area. They cover all bearings, all poses, and the receiver's vertices outside the
// neighbour. Darkening is the AO of the body alone minus its AO beside the neighbour.
struct CasterRow {
  float distance_m = 0;      // between the two bodies' centres, along the ground
  float distance_radii = 0;  // the same in bounding radii of the body
  const char* form = "";     // "composed" or "paper"
  double darkening = 0;
  double darkening_traced = 0;
  double mse_over_none = 0;  // mean squared error of the darkening, divided by the error without any
                             // darkening; both without the noise of the rays
  double rms_darkened = 0;   // root mean squared error where the traced darkening is above darkened_from
  double share_inside = 0;   // share of the area that is left out, because it is inside the neighbour, where
                             // no camera sees it
  // How much a scene's default far_error changes the AO: the root mean square over vertices, weighted by
  // area. It includes the neighbour's spheres and the body's own far spheres.
  double change_of_groups = 0;

  static constexpr float darkened_from = 0.02f;
};

struct CasterStudy {
  std::vector<float> distances{0.3f, 0.5f, 0.75f, 1, 2, 3, 5, 10};
  bool in_radii = false;  // distances are in bounding radii of the body instead of metres
  std::size_t bearings = 6;
  std::uint32_t rays = 256;  // per vertex, in two halves; the same rays are used with and without the
                             // neighbour
  std::uint64_t seed = 1;
};

// Converts a distance of the study to metres.
float distance_in_metres(const CasterStudy& study, const CharacterModel& model, float distance);

// Two bodies in world space.
struct BodyPair {
  bake::Pose receiver, caster;
};

// Takes pose p for the receiver and the next pose for the caster. The caster is turned, and stands at a
// bearing from the receiver's centre.
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

// Each pose is used for the receiver, and the next one for the caster. Both stand on the ground, with +y up.
// Returns two rows per distance.
std::vector<CasterRow> measure_casters(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const bake::Pose> poses, const CasterStudy& study,
                                       const bake::Progress& progress = {});

// Measures one pair. The means are over the vertices of both bodies, and each body is darkened by the other
// one. Returns two rows, whose distance is measured along the ground.
std::vector<CasterRow> measure_pair(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                    const BodyPair& pair, const CasterStudy& study);

}  // namespace nook::measure
