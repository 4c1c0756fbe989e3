// XeGTAO's edge-aware denoiser (F. Strugar, S. Mccalla, Intel XeGTAO, 2021): a weighted mean over 3 x 3
// pixels. Edges set the weights of nearest neighbours. Diagonal neighbours weigh what both ways around the
// corner let through.
#include "bakers/lab/nnao/shaders/edges.glsl"

uniform float own_weight;  // weight of the pixel itself: 1.2 in the last pass, a fifth of it before
uniform float scale;       // factor of the result

// The edges of a pixel and of its nearest neighbours. The order is left, right, below, above.
struct Edges {
  vec4 centre, left, right, below, above;
};

// side: left, right, below, above. corner: below left, below right, above left, above right.
float denoised(Edges edges, float centre, vec4 side, vec4 corner) {
  // An edge that one of two pixels sees counts for both.
  vec4 near = edges.centre * vec4(edges.left.y, edges.right.x, edges.below.w, edges.above.z);
  // A pixel with three edges or four takes a little of what is beyond them.
  float leak = 0.5 * clamp((1.5 - dot(near, vec4(1.0))) / 1.5, 0.0, 1.0);
  near = min(near + leak, 1.0);
  vec4 diagonal = 0.425 * vec4(near.x * edges.left.z + near.z * edges.below.x, near.y * edges.right.z + near.z * edges.below.y,
                               near.x * edges.left.w + near.w * edges.above.x, near.y * edges.right.w + near.w * edges.above.y);
  float total = own_weight + dot(near, vec4(1.0)) + dot(diagonal, vec4(1.0));
  return scale * (own_weight * centre + dot(near, side) + dot(diagonal, corner)) / total;
}
