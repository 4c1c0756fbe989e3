/* A model for another mesh of the same body, such as a level of detail. */
#ifndef NOOK_LOD_H
#define NOOK_LOD_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Makes a model for another mesh of the same body, such as a level of detail, from a bake of the full mesh.
 * Vertex i of the new model is vertex i of the mesh that desc describes. In every pose, its AO is
 * interpolated from the three nearest baked vertices, so it shows the full shape. `nook bake lod` fits it to
 * the shape of the other mesh instead, offline. Joints and weights are ignored. Give normals: without them
 * the two sides of a limb or a card mix. The new model takes bones, spheres, levels and casters from the
 * given model. It leaves out vertices of the pose check that the mesh lacks. desc->tolerance is the largest
 * distance of a vertex from the baked vertices, as a share of the diagonal of the model's box; 0: 0.05.
 * docs/character.md has the error of meshes with 50, 25 and 10 % of the triangles. The call allocates. On
 * failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT (also for a vertex that is too far away; the
 * message names it), UNSUPPORTED (the model has no rest positions), OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_resample(nook_model model, const nook_vertex_match_desc* desc,
                                         nook_model* out);

#ifdef __cplusplus
}
#endif
#endif
