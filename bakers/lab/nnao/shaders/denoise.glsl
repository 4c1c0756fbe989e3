// XeGTAO's edge-aware denoiser (F. Strugar, S. Mccalla, Intel XeGTAO, 2021): a weighted mean over 3 x 3
// pixels. An edge value is the weight of one of the four nearest neighbours. Two paths of two edges lead to a
// diagonal neighbour. The weight of a path is the product of its edges, and the weight of the diagonal
// neighbour is the sum over both paths.
#include "bakers/lab/nnao/shaders/edges.glsl"

uniform float own_weight;  // weight of the pixel itself: 1.2 in the last pass, 0.24 in earlier ones
uniform float scale;       // factor applied to the result

// The edges of a pixel and of its nearest neighbours. The components of each vector are left, right, below,
// above.
struct Edges {
  vec4 centre, left, right, below, above;
};

// `side` has the AO of the left, right, lower and upper neighbour. `corner` has the AO of the neighbours at
// the lower left, lower right, upper left and upper right.
float denoised(Edges edges, float centre, vec4 side, vec4 corner) {
  // There is an edge between two pixels if either of them has found it.
  vec4 near = edges.centre * vec4(edges.left.y, edges.right.x, edges.below.w, edges.above.z);
  // If a pixel has edges on three or four sides, its neighbours still get a small weight.
  float leak = 0.5 * clamp((1.5 - dot(near, vec4(1.0))) / 1.5, 0.0, 1.0);
  near = min(near + leak, 1.0);
  vec4 diagonal = 0.425 * vec4(near.x * edges.left.z + near.z * edges.below.x, near.y * edges.right.z + near.z * edges.below.y,
                               near.x * edges.left.w + near.w * edges.above.x, near.y * edges.right.w + near.w * edges.above.y);
  float total = own_weight + dot(near, vec4(1.0)) + dot(diagonal, vec4(1.0));
  return scale * (own_weight * centre + dot(near, side) + dot(diagonal, corner)) / total;
}
