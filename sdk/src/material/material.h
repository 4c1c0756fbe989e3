// A compressed material as plain data: a bidirectional texture function (BTF) and optionally a view-dependent
// occlusion texture function (VOTF). The BTF is compressed by N-SVD, CTA or K-CTA, or it is a neural BTF,
// which is stored in the data structure of neural.h. The method is by Y.-T. Tsai, Z.-C. Shih: K-Clustered
// Tensor Approximation, 2012.
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

// Rows of the sparse view bases U_{v,c}. Only non-zero entries are stored.
struct ViewRows {
  explicit ViewRows(Memory* memory = default_memory()) : membership(memory), coefficients(memory) {}

  Vector<std::uint16_t> membership;  // rows x K: clusters, all different within a row
  Vector<float> coefficients;        // rows x K x R_v: row i of U_{v,c}, c = membership[i, k]
};

// The view mode resampled over the hemisphere (section 6.3.2 of the paper) in the parabolic map. Cell
// (column, row) is stored in row index row * side + column of `rows`. It belongs to the direction d with
//   d.xy / (1 + d.z) = 2 (cell + 0.5) / side - 1,
// or to the nearest direction of the horizon if d lies outside the unit disc.
struct ViewMap {
  explicit ViewMap(Memory* memory = default_memory()) : rows(memory) {}

  std::uint32_t side = 0;  // cells along a side; 0 if the view mode is not resampled
  ViewRows rows;           // side x side rows
};

struct ClusteredTensor {
  explicit ClusteredTensor(Memory* memory = default_memory())
      : cores(memory), x_bases(memory), y_bases(memory), rows(memory), map(memory) {}

  TensorShape shape;
  Vector<float> cores;  // C x R_l x R_v x R_x x R_y: Z_c, the last index varies fastest
  // C x I_x x R_x and C x I_y x R_y: X_c and Y_c. At full rank (R_x = I_x or R_y = I_y), a basis is square
  // and can be multiplied into the core. The array is then empty and represents the identity.
  Vector<float> x_bases;
  Vector<float> y_bases;
  ViewRows rows;  // one for each view of the material
  ViewMap map;
};

enum class VisibilityForm : std::uint32_t {
  none = 0,    // there is no VOTF; the surface is visible everywhere
  binary = 1,  // 1 where the view ray hits the meso-structure, 0 where it passes through
  // Signed distance to the boundary of the binary mask, scaled to [-1, 1]. The distance is positive where the
  // view ray hits the structure.
  distance = 2,
};

// The visibility mapping, equation (26). The visibility is 1 if the value is at least `threshold`, weight *
// value if the value is between 0 and `threshold`, and 0 if the value is negative.
struct VisibilityMapping {
  float threshold = 0;
  float weight = 0;
};
// Returns the parameters that the paper uses.
constexpr VisibilityMapping paper_mapping(VisibilityForm form) {
  return form == VisibilityForm::binary ? VisibilityMapping{0.5f, 1} : VisibilityMapping{0.05f, 12};
}

// The relief on which the texels of the BTF lie. For each view, texel (x, y) stores the appearance of the
// point of the relief above that texel. So a detail of the surface is at the same texel in all views, and
// stays sharp when views are mixed. relief_place of relief_tables.h finds the point that a view sees through
// the plane z = 0. The VOTF has no relief; its texels lie on that plane.
struct Relief {
  explicit Relief(Memory* memory = default_memory()) : levels(memory) {}

  float low = 0, high = 0;      // heights above z = 0 of level 0 and level 255, in tiles; both 0: no relief
  float max_slope = 0;          // limit for the tangent of the view's angle to the normal; larger tangents
                                // are clamped
  std::uint32_t steps = 0;      // number of steps of the march; 0 if the relief is a plane at low = high
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

  Vector<Vec3> lights;  // I_l distinct directions to the light
  Vector<Vec3> views;   // I_v distinct directions to the viewer, for BTF and VOTF

  // The mode-light basis, 3 I_l x R_l, which all clusters share. Row 3 l + channel belongs to light l.
  Vector<float> light_basis;
  // The BTF decodes to the radiance towards the viewer, in linear RGB. The light is directional, and causes
  // an irradiance of 1 on a plane that faces it. The radiance includes the cosine of the angle between light
  // and normal: a white Lambertian plane under a perpendicular light has the radiance 1 / pi.
  ClusteredTensor btf;
  Neural neural;  // if used, replaces light_basis and btf, which are then empty

  VisibilityForm visibility = VisibilityForm::none;
  VisibilityMapping mapping;  // ignored if `visibility` is none
  ClusteredTensor votf;       // empty if visibility is none

  Relief relief;

  // The number format in the file and in the decoder's tables: 16 for half floats, 8 for small integers.
  // Integers in the file are multiples of a step. Integers in the tables have 8 bits and a scale.
  std::uint32_t bits = 16;
  // The squared error that rounding the cores to integers may cause in the file, relative to the squared norm
  // of the cores.
  float core_rounding = 0x1p-14f;

  String recipe;  // settings of the bake, JSON; the runtime does not read it
};

// Returns the size of the compressed data in bytes, counted as in Table I of the paper. Resampled view maps,
// directions and the scales of integers are not included.
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
