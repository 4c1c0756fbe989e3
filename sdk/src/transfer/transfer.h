// Baked radiance transfer of a static shape as plain data. The separated form stores, for each vertex and
// lobe, the fraction of the lobe's light that reaches the vertex. The method follows Y.-T. Tsai, Z.-C. Shih:
// K-Clustered Tensor Approximation, 2012, section 6.3, but the separated form replaces the transfer matrix of
// a vertex by a product.
//
// A vertex with the frame F and the visibility V(s) under the light sum_j l_j G_j(s) has, for channel c and
// light mode a of a material, the vector
//   r[c, a] = sum_j l_j[c] integral of V G_j phi[c, a](F s)
//           ~ sum_j l_j[c] v_j P[c, a](F axis_j),   P[c, a](d) = integral of G(d, s) phi[c, a](s),
// where v_j = integral of V G_j cos+ / integral of G_j cos+ is stored in this data as a byte. The response P
// depends only on the material. The radiance of a pixel is sum_a L_a r[c, a], where L_a are the light modes
// that the material decodes.
//
// Light that the shape reflects onto itself is stored separately, as the irradiance that light in the
// spherical-harmonic bands 0 to 2 causes. If a channel has the mean reflectance a, the irradiance that a
// vertex receives after 1 to B reflections is
//   E[c] = sum_b a[c]^b sum_k L_k[c] m_(b,k),   b = 1 to B,
// where a is to the power b, and m is computed for a shape that reflects all light. So the file does not
// depend on the material's reflectance, and you can use any material on the shape. E[c] / pi times the
// integral of phi[c, a] is added to the vector.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/paper.h"
#include "sdk/src/transfer/tangent_frame.h"

namespace nook::transfer {

inline constexpr std::uint32_t max_vertices = 10'000'000;
inline constexpr std::uint32_t max_bounces = 2;

// XXH64 hashes of the arrays of the baked mesh. Arrays are hashed as little-endian floats. -0 is hashed as 0.
struct MeshHashes {
  std::uint64_t position = 0;  // 3 floats for each vertex
  std::uint64_t normal = 0;    // 3
  std::uint64_t tangent = 0;   // 4: the direction and the handedness
  std::uint64_t uv = 0;        // 2
  bool operator==(const MeshHashes&) const = default;
};

struct Transfer {
  explicit Transfer(Memory* memory = default_memory())
      : shares(memory), frames(memory), paper(memory), indirect(memory), recipe(memory) {}

  std::uint32_t lobes = 0;
  MeshHashes hashes;
  Vector<std::uint8_t> shares;  // vertices x lobes, 255 is open
  Vector<PackedFrame> frames;   // one for each vertex
  PaperTransfer paper;          // if used, `shares` and `frames` are empty
  std::uint32_t bounces = 0;    // number of reflections, up to max_bounces
  // vertices x bounces x band_count half floats m_(b,k), in the order of distant_light.h.
  Vector<std::uint16_t> indirect;
  // The hash of the VOTF that defined the holes of surfaces in the bake; see material/tables.h. It is 0 if
  // surfaces had no holes.
  std::uint64_t votf_hash = 0;
  String recipe;  // settings of the bake, JSON; the runtime does not read it

  std::uint32_t vertex_count() const {
    return std::uint32_t(paper.is_used() ? paper.cluster.size() : frames.size());
  }
  const std::uint8_t* shares_of(std::size_t vertex) const { return shares.data() + vertex * lobes; }
};

}  // namespace nook::transfer
