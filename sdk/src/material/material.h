// A compressed material as plain data: a bidirectional texture function (BTF) and optionally a view-dependent
// occlusion texture function (VOTF). N-SVD, CTA and K-CTA share one form; neural.h has another form of the
// BTF. The method is by Y.-T. Tsai, Z.-C. Shih: K-Clustered Tensor Approximation, 2012.
//
// Directions are unit vectors in tangent space that point away from the surface: x along u, y along v, z >= 0
// along the normal. Texel (x, y) has its centre at u = (x + 0.5) / I_x, v = (y + 0.5) / I_y; the tile
// repeats.
//
// With c = membership[i, k], equations (24) and (25) are
//   A[j, i, x, y] =
//     sum_k sum_{a, b, p, q} light[j, a] coefficients[i, k, b] Z_c[a, b, p, q] X_c[x, p] Y_c[y, q],
// with k < K, a < R_l, b < R_v, p < R_x, q < R_y. Colour is folded into the light mode: j = 3 l + channel for
// light l and channel red, green, blue. A VOTF has no light mode: R_l = 1 and light[j, a] = 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/material/neural.h"
#include "sdk/src/material/tensor_shape.h"

namespace nook::material {

// The non-zero entries of rows of the sparse view bases U_{v,c}.
struct ViewRows {
  explicit ViewRows(Memory* memory = default_memory()) : membership(memory), coefficients(memory) {}

  Vector<std::uint16_t> membership;  // rows x K: clusters, all different within a row
  Vector<float> coefficients;        // rows x K x R_v: row i of U_{v,c}, c = membership[i, k]
};

// The view mode resampled over the hemisphere (section 6.3.2 of the paper) in the parabolic map. Cell
// (column, row) has row number row * side + column, which belongs to the direction d with
//   d.xy / (1 + d.z) = 2 (cell + 0.5) / side - 1,
// or to the nearest direction of the horizon if d lies outside the unit disc.
struct ViewMap {
  explicit ViewMap(Memory* memory = default_memory()) : rows(memory) {}

  std::uint32_t side = 0;  // cells; 0 if the view mode is not resampled
  ViewRows rows;           // side x side rows
};

struct ClusteredTensor {
  explicit ClusteredTensor(Memory* memory = default_memory())
      : cores(memory), x_bases(memory), y_bases(memory), rows(memory), map(memory) {}

  TensorShape shape;
  Vector<float> cores;  // C x R_l x R_v x R_x x R_y: Z_c, the last index varies fastest
  // C x I_x x R_x and C x I_y x R_y: X_c and Y_c. At full rank, R_x = I_x or R_y = I_y, they are empty and
  // stand for the identity, because a square basis is multiplied into the core.
  Vector<float> x_bases;
  Vector<float> y_bases;
  ViewRows rows;  // one for each view of the material
  ViewMap map;
};

enum class VisibilityForm : std::uint32_t {
  none = 0,    // there is no VOTF; the surface is visible everywhere
  binary = 1,  // 1 where the view meets the meso-structure, 0 where it passes through
  // Distance to the boundary of the binary mask, positive where the view meets the structure, scaled to [-1,
  // 1].
  distance = 2,
};

// The visibility mapping (26): 1 where the value is at least `threshold`, weight * value between 0 and
// threshold, else 0.
struct VisibilityMapping {
  float threshold = 0;
  float weight = 0;
};
// Returns the paper's parameters.
constexpr VisibilityMapping paper_mapping(VisibilityForm form) {
  return form == VisibilityForm::binary ? VisibilityMapping{0.5f, 1} : VisibilityMapping{0.05f, 12};
}

// The relief on which the texels of the BTF lie: texel (x, y) of a view is what it sees at the relief's point
// above that texel. So relief does not move between views, and mixing views does not blur it. relief_place of
// relief_tables.h finds the point that a view sees through the plane z = 0. The VOTF stays on that plane.
struct Relief {
  explicit Relief(Memory* memory = default_memory()) : levels(memory) {}

  float low = 0, high = 0;      // heights over z = 0 of the levels 0 and 255, tiles; both 0: no relief
  float max_slope = 0;          // the tangent of a view's tilt beyond which texels move no further
  std::uint32_t steps = 0;      // of the march; 0 for a plane, which is at low = high
  Vector<std::uint8_t> levels;  // I_y x I_x of the BTF, row by row; empty for a plane

  bool moves() const { return low != 0 || high != 0; }
};

struct Material {
  explicit Material(Memory* memory = default_memory())
      : lights(memory),
        views(memory),
        light_basis(memory),
        btf(memory),
        neural(memory),
        votf(memory),
        relief(memory),
        recipe(memory) {}

  Vector<Vec3> lights;  // I_l different directions to the light
  Vector<Vec3> views;   // I_v different directions to the viewer, for BTF and VOTF

  // 3 I_l x R_l: the mode-light basis that all clusters share; its row is 3 l + channel.
  Vector<float> light_basis;
  // The radiance towards the view, linear RGB, for a directional light whose irradiance on a plane that faces
  // it is 1. It includes the cosine of the light: a white Lambertian plane under a perpendicular light gives
  // 1 / pi.
  ClusteredTensor btf;
  Neural neural;  // replaces light_basis and btf, which are then empty

  VisibilityForm visibility = VisibilityForm::none;
  VisibilityMapping mapping;  // not read if visibility is none
  ClusteredTensor votf;       // empty if visibility is none

  Relief relief;

  // How numbers are stored in the file and in the decoder's tables: 16 for half floats, 8 for small integers.
  // The file's integers have steps; the tables' integers have 8 bits and scales.
  std::uint32_t bits = 16;
  // The squared error that rounding cores to integers causes in the file, relative to their squared norm.
  float core_rounding = 0x1p-14f;

  String recipe;  // settings of the bake, JSON; the runtime does not read it
};

// Returns the bytes of all compressed numbers as Table I of the paper counts them, without resampled view
// maps and directions. Integers count without their scales.
inline std::size_t compressed_bytes(const Material& material) {
  const std::uint32_t bits = material.bits;
  const std::size_t btf = material.neural.is_used()
                              ? neural_bytes(material.neural.shape)
                              : light_basis_bytes(material.lights.size(), material.btf.shape, bits) +
                                    compressed_bytes(material.btf.shape, bits);
  return btf +
         (material.visibility == VisibilityForm::none ? 0 : compressed_bytes(material.votf.shape, bits));
}

}  // namespace nook::material
