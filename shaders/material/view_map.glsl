// Computes mipmap levels, and finds cells of view maps.
#include "shaders/material/parabolic.glsl"

// Returns the mipmap level for a pixel with the derivatives dx and dy. All fetches specify this level. This
// is faster than implicit derivatives, and also works inside branches.
float nook_mipmap_level(vec2 dx, vec2 dy, vec2 texels) {
  dx *= texels;
  dy *= texels;
  return 0.5 * log2(max(max(dot(dx, dx), dot(dy, dy)), 1e-30));
}

// A cell of a view map, the neighbours along x and y with which it blends, and their weights.
struct NookMaterialCell {
  ivec2 cell, x, y;
  float weight_x, weight_y;
};

// Finds the neighbours and weights for a view in a cell. `neighbours` stores step + 1 in two bits for each
// half of the cell. sdk/src/material/view_cells.h has the same function.
NookMaterialCell nook_material_blend(vec2 place, ivec2 cell, int neighbours) {
  vec2 at = place - vec2(cell) - 0.5;
  int x = (neighbours >> (at.x > 0.0 ? 2 : 0) & 3) - 1, y = (neighbours >> (at.y > 0.0 ? 6 : 4) & 3) - 1;
  return NookMaterialCell(cell, cell + ivec2(x, 0), cell + ivec2(0, y), at.x * float(x), at.y * float(y));
}

vec4 nook_material_blended(highp sampler2DArray coefficients, NookMaterialCell c, int layer) {
  return texelFetch(coefficients, ivec3(c.cell, layer), 0) * (1.0 - c.weight_x - c.weight_y) +
         texelFetch(coefficients, ivec3(c.x, layer), 0) * c.weight_x +
         texelFetch(coefficients, ivec3(c.y, layer), 0) * c.weight_y;
}

// Stores the cell of a view in a tensor, and the cluster indices of its terms. `clusters` contains the four
// indices that are currently evaluated. `last` contains the last four values, which include the code of the
// cell's neighbours.
struct NookMaterialTerms {
  NookMaterialCell cell;
  uvec4 clusters, last;
};
