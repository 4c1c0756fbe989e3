// The per-frame work of a character on the CPU, as a table of plain functions. There is one table for each
// instruction set. The functions work on arrays that the caller owns. They do not allocate, lock or throw.
//
// These are the steps of a frame. First, pose_spheres and pose_key_points transform the model to world space.
// Then self_norm_sum and norm_root compute the shadow at each key point, and composed_depth, exact_open and
// composed_occlusion compute the occlusion by other casters. Finally, encode_points and linear_layer compute
// the AO of the vertices from both.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sdk/src/character/directional_occlusion.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/core/isa.h"
#include "sdk/src/core/vec.h"

namespace nook {

// The kernels process key points in groups of this size. Arrays over key points have padded_key_points(count)
// entries. The padding must hold finite values; pose_key_points fills it.
inline constexpr std::uint32_t key_point_group = 16;
constexpr std::uint32_t padded_key_points(std::uint32_t count) {
  return (count + key_point_group - 1) / key_point_group * key_point_group;
}

// The minimum radius of a sphere, 1 micrometre. Smaller spheres get this radius, so that squared distances in
// units of the radius stay finite.
inline constexpr float min_sphere_radius = float(NOOK_MIN_SPHERE_RADIUS);
// Coordinates up to this many metres from the origin give finite results. Float precision becomes useless at
// much smaller distances.
inline constexpr float max_coordinate = 1e9f;
constexpr float inverse_sphere_radius(float radius) {
  return 1 / (radius > min_sphere_radius ? radius : min_sphere_radius);
}

// Spheres in metres, in the same space as the key points that they darken.
struct SphereSoa {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* inverse_radius = nullptr;  // from inverse_sphere_radius, per metre
  const float* caster_weight = nullptr;   // only composed_depth and exact_open read it
  std::uint32_t count = 0;
};

// Key points in metres. Normals have unit length, or are zero in the padding. Each array has padded_count
// entries. 64-byte alignment is not required, but is faster.
struct KeyPointSoa {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* nx = nullptr;
  const float* ny = nullptr;
  const float* nz = nullptr;
  std::uint32_t padded_count = 0;  // a multiple of key_point_group
};

// Arrays that pose_spheres and pose_key_points write. You can then pass the same arrays to the other kernels
// as SphereSoa and KeyPointSoa.
struct SphereTarget {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
  float* inverse_radius = nullptr;
};
struct KeyPointTarget {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
  float* nx = nullptr;
  float* ny = nullptr;
  float* nz = nullptr;
};

// Proxy spheres of a model in rest space, in metres. RestSpheres owns the arrays.
struct RestSphereView {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* radius = nullptr;
  const std::uint16_t* bone = nullptr;
  std::uint32_t count = 0;
};

// Key points of a model in rest space, in metres. RestKeyPoints owns the arrays. `bone` and `weight` hold
// four consecutive entries for each key point.
struct RestKeyPointView {
  KeyPointSoa fitted;
  KeyPointSoa surface;
  const std::uint16_t* bone = nullptr;
  const float* weight = nullptr;
  const float* saturation = nullptr;
  std::uint32_t padded_count = 0;
};

// The posed nodes and spheres of a tree, in world space and in metres. Each array holds the nodes first, then
// the spheres. The values have the form that shadow_nook_of_mass needs, which is the term of the default
// kernel with gamma 1.
struct PosedSphereTree {
  static constexpr std::uint32_t max_spheres = 256, max_masses = 512;  // there is one node less than there
                                                                       // are spheres

  float x[max_masses], y[max_masses], z[max_masses];
  float softness[max_masses];  // square metres, softens the horizon
  float core[max_masses];      // square metres, added to the squared distance
  float mass[max_masses];      // square metres: 3/4 of the squared radius, or for a node, 3/4 of the sum of
                               // squared radii
  float reach[max_spheres];    // only for nodes: a squared distance in square metres; for key points that are
                               // closer, the node's two halves are used instead of the node
};
// The two halves of a node. Each is the index of a node or sphere in PosedSphereTree. A node has a smaller
// index than its halves.
struct SphereTreeNode {
  std::uint16_t half[2] = {};
};
// A view of data that SphereTree and PosedSphereTree own.
struct SphereTreeView {
  const SphereTreeNode* node = nullptr;
  std::uint32_t nodes = 0;
  const PosedSphereTree* pose = nullptr;
};

// The weights of 16 vertices of the linear layer, as a small dense matrix. It has a column for each key point
// that at least one of the vertices uses. A column takes only a few instructions for all 16 vertices. Without
// blocks, each entry of each vertex would need its own load. Columns are stored in pairs, because processors
// can sum two products of 16-bit numbers in one instruction. The two key points of pair p of the block are in
// key_points[first_pair + p]. The pair's values start at alpha[32 (first_pair + p)] and blend[32 (first_pair
// + p)]. There, the two values of each vertex are next to each other. If the number of columns is odd, a last
// column without weights is added.
struct LinearBlock {
  std::uint32_t first_pair = 0;
  std::uint32_t pairs = 0;
};
inline constexpr std::uint32_t linear_block_vertices = 16;
inline constexpr std::uint32_t linear_pair_weights = 2 * linear_block_vertices;

// Values at key points, encoded as integer multiples of `step`. encode_points chooses the step so that the
// largest value is `limit` steps. Each code is stored twice: in the lower half of a word in `low`, and in the
// upper half of a word in `high`. The other half of each word is 0.
struct PointCodes {
  std::int32_t* low = nullptr;
  std::int32_t* high = nullptr;
  float step = 0;
};

// The linear layer. Its vertices are stored in slots, in an order that differs from the file's. LinearLayer
// owns the arrays.
struct LinearView {
  const LinearBlock* blocks = nullptr;
  std::uint32_t block_count = 0;
  // Each word holds the first key point of a pair in its lower half and the second in its upper half, so that
  // one load reads both.
  const std::uint32_t* key_points = nullptr;
  const std::int16_t* alpha = nullptr;
  const std::int16_t* blend = nullptr;  // blend weights, in the same layout as `alpha`
  float alpha_step = 1, blend_step = 1;
  const float* open_bias = nullptr;  // 1 - bias, for each slot
  // The limits for encode_points. With codes up to these limits, the sum of every vertex fits into 32 bits.
  float shadow_limit = 1, occlusion_limit = 1;
};
inline constexpr float max_code_limit = 32767;

struct ShadowKernels {
  Isa isa = Isa::scalar;
  const char* name = nullptr;

  // sum[k] += sum over spheres of y^gamma. To add several sets of spheres to the same sum, call the function
  // once for each set, with the same key points. SIMD tables use the processor's fast estimates of roots.
  // Therefore the shadow after norm_root can differ from the formulas in double precision: by at most 2e-4,
  // or by the relative error 2e-4 if the shadow is above 1.
  void (*self_norm_sum)(const SphereSoa& spheres, const KeyPointSoa& points, const Kernel& kernel,
                        float* sum);
  // Computes the same sum for the default kernel and gamma 1, but replaces far spheres by nodes of a tree.
  // Each group of key points uses the largest nodes for which the whole box of the group is farther away than
  // the node's `reach`. Returns the number of evaluated pairs of a key point and a sphere or node.
  std::uint64_t (*tree_sum)(const SphereTreeView& tree, const KeyPointSoa& points, float* sum);
  // shadow[k] = saturated(sum[k]^(1 / gamma), saturation[k]). `sum` and `shadow` may be the same array.
  void (*norm_root)(const float* sum, const float* saturation, std::uint32_t padded_count, float gamma,
                    float* shadow);

  // depth[k] += solid_depth(sum over spheres of caster_weight * form factor), with the fast formula of the
  // form factor. Pass the spheres of one caster, and key points with surface positions and normals.
  void (*composed_depth)(const SphereSoa& spheres, const KeyPointSoa& points, float* depth);
  // open[k] *= 1 - min(1, caster_weight * form factor) for each sphere, with the exact formula of the form
  // factor. Pass the spheres of the ground or of free occluders. If caster_weight is NULL, all weights are 1.
  void (*exact_open)(const SphereSoa& spheres, const KeyPointSoa& points, float* open);
  // occlusion[k] = 1 - open[k] * exp(-depth[k]). NULL for `depth` means 0 everywhere, and NULL for `open`
  // means 1 everywhere.
  void (*composed_occlusion)(const float* depth, const float* open, std::uint32_t padded_count,
                             float* occlusion);

  // Rounds values to codes from -limit to limit. A code changes a value by at most half of the step.
  void (*encode_points)(const float* value, std::uint32_t padded_count, float limit, PointCodes& codes);
  // ao[slot] = clamp(1 - (sum alpha * shadow + bias), 0, 1) * clamp(1 - sum blend * occlusion, 0, 1) in the
  // layer's slot order, with 16 entries for each block. If `occlusion` is NULL, evaluates only self-shadow.
  // For any input, `ao` is in [0, 1].
  void (*linear_layer)(const LinearView& layer, const PointCodes& shadow, const PointCodes* occlusion,
                       float* ao);

  // pose_spheres and pose_key_points transform from rest space to world space. `bones` map rest space to
  // world space. They must be rigid or have a uniform scale, which also scales radii. offset_ws is subtracted
  // from the positions, so that a scene far from the world's origin keeps its precision near the instance.
  void (*pose_spheres)(const RestSphereView& rest, const Mat3x4* bones, Vec3 offset_ws,
                       const SphereTarget& out);
  // If `surface` is NULL, transforms only the fitted positions and normals. Otherwise also transforms the
  // surface positions and normals, which composed_depth reads.
  void (*pose_key_points)(const RestKeyPointView& rest, const Mat3x4* bones, Vec3 offset_ws,
                          const KeyPointTarget& out, const KeyPointTarget* surface);

  // The following functions compute directional occlusion (directional_occlusion.h). `rgb` and `inverse` have
  // one array of padded_count entries for each channel. rho is the mean radiance behind a sphere, relative to
  // the mean radiance of the hemisphere. directional_norm_sum is the coloured form of self_norm_sum: rgb[k]
  // += sum over spheres of y^gamma rho. rho is computed from bands 0 to 2 of the light.
  void (*directional_norm_sum)(const SphereSoa& spheres, const KeyPointSoa& points, const Kernel& kernel,
                               const LightBands& light, float* const* rgb);
  // inverse[k] = inverse_hemisphere at key point k. The next two functions need it.
  void (*directional_hemisphere)(const KeyPointSoa& points, const LightView& light, float* const* inverse);
  // rgb[k] += rho * solid_depth(sum over spheres of caster_weight * form factor): the coloured form of
  // composed_depth. Pass the spheres of one caster, which share one rho.
  void (*directional_depth)(const SphereSoa& spheres, const KeyPointSoa& points, const LightView& light,
                            float* const* inverse, float* const* rgb);
  // rgb[k] *= 1 - min(1, form factor * rho) for each sphere: the coloured form of exact_open.
  void (*directional_open)(const SphereSoa& spheres, const KeyPointSoa& points, const LightView& light,
                           float* const* inverse, float* const* rgb);
  // Like directional_open, for the sphere of the ground. `up` is the unit normal of the ground's plane.
  void (*directional_ground)(const SphereSoa& ground, const KeyPointSoa& points, const LightView& light,
                             Vec3 up, float* const* rgb);
  // The coloured form of linear_layer. It multiplies the vertex's self-shadow, including the bias, by (sum
  // alpha * coloured) / (sum alpha * shadow), see vertex_light_ratio. Without the factor on the bias,
  // vertices whose key points are darker than the vertex would get wrong colours, because their self-shadow
  // is a small difference of large values. If `occlusion` is NULL, evaluates only self-shadow. For any input,
  // the results are in [0, 1].
  void (*directional_linear_layer)(const LinearView& layer, const float* shadow, const float* const* coloured,
                                   const float* const* occlusion, float* const* rgb);
};

// Returns the table of one instruction set, or NULL if the processor or the build lacks it. The scalar table
// always exists.
const ShadowKernels* shadow_kernels(Isa isa);
// Returns the table of the best available instruction set.
const ShadowKernels& best_shadow_kernels();

}  // namespace nook

// Declares, for each instruction set, the function that returns its table. Each instruction set has its own
// translation unit. Use a table only on a processor that has the instruction set.
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  namespace nook::isa_##name {                   \
    const ShadowKernels& kernels();              \
  }
#include "sdk/src/core/isa_list.inl"
