// A character model: the baked regression of Le et al. 2019 as plain data, in rest space and metres.
#pragma once

#include <nook/nook.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sdk/src/character/bent_normal.h"
#include "sdk/src/character/bind_data.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/core/vec.h"

namespace nook {

// A sphere that is rigid to one bone.
struct ProxySphere {
  Vec3 centre;
  float radius = 0;
  std::uint16_t bone = 0;
  // The form factor of the sphere is multiplied by this weight, >= 0, when the sphere darkens another
  // instance. The bake fits the weight against ray tracing, so that overlapping spheres of one character do
  // not darken twice.
  float caster_weight = 1;
};

// A capsule that is rigid to one bone. Together, the capsules of a body represent its volume when the body
// darkens the world.
struct WorldCaster {
  Capsule capsule;  // its radii are the radii for light, which do not include ao_scale
  std::uint16_t bone = 0;
  // AO uses the capsule's radii times this scale. For AO, the open shares of several casters are multiplied
  // together, as if the casters covered the hemisphere independently. Casters that overlap must therefore be
  // thinner for AO than for light.
  float ao_scale = 1;
};

// A point that follows up to four bones by linear blend skinning; the blended normal is renormalised.
struct KeyPoint {
  static constexpr int max_bones = 4;
  Vec3 position;          // fitted position, at which self-shadow is evaluated
  Vec3 normal;            // fitted, unit length
  Vec3 surface_position;  // mean of the nearest vertices; the occlusion by other casters is evaluated here
  Vec3 surface_normal;    // mean normal of the same vertices, unit length
  std::array<std::uint16_t, max_bones> bone{};
  std::array<float, max_bones> weight{};  // non-negative, with sum 1
  float saturation = 0;                   // c of saturated() in kernel.h, >= 0
};

struct PrimitiveRange {
  std::uint32_t first_vertex = 0;  // in file order
  std::uint32_t vertex_count = 0;
};

// A coarser version of the non-linear layer for distant instances. It has fewer spheres, and evaluates only
// some of the key points. The shadow of each remaining key point is computed from one evaluated key point.
// The linear layer stays the same.
struct CharacterLevel {
  using allocator_type = Allocator<std::byte>;
  explicit CharacterLevel(const allocator_type& memory = {})
      : spheres(memory), evaluated(memory), source(memory), scale(memory), offset(memory) {}
  CharacterLevel(const CharacterLevel&) = default;
  CharacterLevel(CharacterLevel&&) = default;
  CharacterLevel(const CharacterLevel& other, const allocator_type& memory) : CharacterLevel(memory) {
    *this = other;
  }
  CharacterLevel(CharacterLevel&& other, const allocator_type& memory) : CharacterLevel(memory) {
    *this = std::move(other);
  }
  CharacterLevel& operator=(const CharacterLevel&) = default;
  CharacterLevel& operator=(CharacterLevel&&) = default;

  Vector<ProxySphere> spheres;
  Vector<std::uint16_t> evaluated;  // key points, ascending
  // For each key point k, shadow[k] = max(0, scale[k] * shadow[evaluated[source[k]]] + offset[k]). The
  // occlusion by other casters at k is the occlusion at the evaluated key point, without scale and offset.
  Vector<std::uint16_t> source;
  Vector<float> scale;
  Vector<float> offset;
  // The RMS difference in AO between this level and full detail, over all vertices and all poses that were
  // not used for the fit. Only the body itself casts shadow.
  float error_rms = 0;
};

struct CharacterModel {
  explicit CharacterModel(Memory* memory = default_memory())
      : bone_names(memory),
        spheres(memory),
        key_points(memory),
        influence(memory),
        alpha(memory),
        bias(memory),
        blend(memory),
        static_ao(memory),
        occluded(memory),
        file_to_welded(memory),
        primitives(memory),
        levels(memory),
        world_casters(memory),
        bind(memory),
        rest(memory),
        recipe(memory) {}

  static constexpr std::uint32_t max_influences = 8;

  Kernel kernel;
  Vector<String> bone_names;  // one for each bone
  Vector<ProxySphere> spheres;
  Vector<KeyPoint> key_points;

  // Linear layer: the AO of welded vertex i is 1 - (sum_s alpha[i * influences + s] * shadow[influence[...]]
  // + bias[i]).
  std::uint32_t influences = 0;     // entries per vertex, 1 to max_influences; unused entries have alpha 0
  Vector<std::uint16_t> influence;  // key-point indices
  Vector<float> alpha;              // >= 0; at least one entry of each vertex is > 0
  Vector<float> bias;
  // The occlusion by other casters is blended from the same key points: AO is also multiplied by 1 - sum_s
  // blend[i * influences + s] * occlusion[influence[...]]. The weights of a vertex sum to 1; some may be
  // negative, and they are 0 where alpha is 0.
  Vector<float> blend;
  // AO of the rest pose for each welded vertex, as in a static bake; may be empty.
  Vector<float> static_ao;

  // The occluded directions of each welded vertex, in rest space. Empty if the model was baked without them.
  Vector<OccludedEnds> occluded;

  Vector<std::uint32_t> file_to_welded;  // the welded vertex of each vertex in file order
  Vector<PrimitiveRange> primitives;

  static constexpr std::size_t max_levels = 4;
  Vector<CharacterLevel> levels;  // from fine to coarse; full detail is not included; may be empty

  static constexpr std::size_t max_world_casters = 64;
  Vector<WorldCaster> world_casters;  // empty if the model was baked without world casters

  float bounding_radius = 0;  // metres; the sphere around bounding_centre contains the rest pose
  Vec3 bounding_centre;
  std::uint16_t root_bone = 0;  // the ground and the bounding sphere move with this bone

  BindData bind;     // may be empty
  RestSurface rest;  // may be empty

  String recipe;  // JSON text of the bake's settings; the runtime does not read it

  std::size_t vertex_count() const { return bias.size(); }
  std::size_t bone_count() const { return bone_names.size(); }
};

// Returns the largest saturation of the key points, or 0 if no key point saturates its shadow.
inline float max_saturation_of(const CharacterModel& model) {
  float max = 0;
  for (const KeyPoint& point : model.key_points) max = std::max(max, point.saturation);
  return max;
}

// Upper bound for alpha, bias and caster weight. A fit comes near this bound only if the spheres are far too
// small.
constexpr float max_coefficient = 1e4f;

// Upper bound for the saturation. Above it, a key point acts like a switch: a norm of 1/64 is enough for half
// of its maximum shadow.
constexpr float max_saturation = 64;

// Throws Failure with `code` for the first fault that it finds. A fault is a count or index out of range, a
// value that is not finite or out of its range, or weights that do not sum to one.
void check_model(const CharacterModel& model, nook_result code);

}  // namespace nook
