// Functions for a host's shaders that use radiance transfer. Before this text, sdk/src/gl/transfer/ defines
// NOOK_LIGHT_VEC4_COUNT unless the material's text has already defined it. A vector takes 3 *
// NOOK_LIGHT_VEC4_COUNT texels: first the light modes for red, then for green, then for blue.
#include "shaders/core/texels.glsl"

uniform NOOK_TEXELS nook_transfer_texels;

#ifdef NOOK_TRANSFER_CLUSTERS
// In the paper's form, the first table contains row vectors that depend on the light:
// NOOK_TRANSFER_VERTEX_RANK for each cluster, then NOOK_TRANSFER_BANDS for reflected light. The second table
// has NOOK_TRANSFER_VERTEX_TEXELS texels for each vertex. They contain the index of the vertex's cluster, the
// weights of the cluster's row vectors, and the weights of the row vectors for reflected light.
uniform NOOK_TEXELS nook_transfer_vertices;

// Computes the vectors of a vertex as a weighted sum. Pass gl_VertexID if you draw the vertices in the baked
// order.
void nook_transfer_vectors(int vertex, out vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT]) {
  int first = vertex * NOOK_TRANSFER_VERTEX_TEXELS;
  vec4 numbers = nook_texel(nook_transfer_vertices, first);
  int of_cluster = int(numbers.x) * NOOK_TRANSFER_VERTEX_RANK;
  for (int i = 0; i < 3 * NOOK_LIGHT_VEC4_COUNT; ++i) vectors[i] = vec4(0.0);
  for (int k = 1; k <= NOOK_TRANSFER_VERTEX_RANK + NOOK_TRANSFER_BANDS; ++k) {
    if ((k & 3) == 0) numbers = nook_texel(nook_transfer_vertices, first + (k >> 2));
    int mode = k - 1;
    int row = mode < NOOK_TRANSFER_VERTEX_RANK
                  ? of_cluster + mode
                  : (NOOK_TRANSFER_CLUSTERS - 1) * NOOK_TRANSFER_VERTEX_RANK + mode;
    row *= 3 * NOOK_LIGHT_VEC4_COUNT;
    for (int i = 0; i < 3 * NOOK_LIGHT_VEC4_COUNT; ++i)
      vectors[i] += numbers[k & 3] * nook_texel(nook_transfer_texels, row + i);
  }
}

// Call this function in a fragment shader if the material has more light modes than fit into varyings. It
// interpolates the vectors of a triangle's three vertices.
void nook_transfer_mix(ivec3 vertices, vec3 weights, out vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT]) {
  vec4 corner[3 * NOOK_LIGHT_VEC4_COUNT];
  for (int i = 0; i < 3 * NOOK_LIGHT_VEC4_COUNT; ++i) vectors[i] = vec4(0.0);
  for (int k = 0; k < 3; ++k) {
    nook_transfer_vectors(vertices[k], corner);
    for (int i = 0; i < 3 * NOOK_LIGHT_VEC4_COUNT; ++i) vectors[i] += weights[k] * corner[i];
  }
}
#else
// Fetches the vectors of a vertex. Pass gl_VertexID if you draw the vertices in the baked order.
void nook_transfer_vectors(int vertex, out vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT]) {
  int first = vertex * 3 * NOOK_LIGHT_VEC4_COUNT;
  for (int i = 0; i < 3 * NOOK_LIGHT_VEC4_COUNT; ++i) vectors[i] = nook_texel(nook_transfer_texels, first + i);
}

// Call this function in a fragment shader if the material has more light modes than fit into varyings. It
// interpolates the vectors of a triangle's three vertices.
void nook_transfer_mix(ivec3 vertices, vec3 weights, out vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT]) {
  ivec3 first = vertices * (3 * NOOK_LIGHT_VEC4_COUNT);
  for (int i = 0; i < 3 * NOOK_LIGHT_VEC4_COUNT; ++i)
    vectors[i] = weights.x * nook_texel(nook_transfer_texels, first.x + i) +
                 weights.y * nook_texel(nook_transfer_texels, first.y + i) +
                 weights.z * nook_texel(nook_transfer_texels, first.z + i);
}
#endif

// Rotates a direction to the tangent space of a pixel, which is given by the interpolated normal and tangent.
// As in the bake, y points in the direction of increasing v.
vec3 nook_transfer_tangent_space(vec3 normal, vec4 tangent, vec3 direction) {
  vec3 z = normalize(normal);
  vec3 x = normalize(tangent.xyz - z * dot(z, tangent.xyz));
  vec3 y = (tangent.w < 0.0 ? -1.0 : 1.0) * cross(z, x);
  return vec3(dot(x, direction), dot(y, direction), dot(z, direction));
}

// Returns the radiance towards the view. Pass the light modes that nook_material_decode has computed.
vec3 nook_transfer_radiance(vec4 modes[NOOK_LIGHT_VEC4_COUNT], vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT]) {
  vec3 radiance = vec3(0.0);
  for (int a = 0; a < NOOK_LIGHT_VEC4_COUNT; ++a)
    radiance += vec3(dot(modes[a], vectors[a]), dot(modes[a], vectors[a + NOOK_LIGHT_VEC4_COUNT]),
                     dot(modes[a], vectors[a + 2 * NOOK_LIGHT_VEC4_COUNT]));
  return radiance;
}
