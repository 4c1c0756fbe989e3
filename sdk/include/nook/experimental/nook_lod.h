/* Makes a model for another mesh of the same body, such as a level of detail. */
#ifndef NOOK_LOD_H
#define NOOK_LOD_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Makes a model for another mesh of the same body, such as a level of detail, from the baked model of the
 * full mesh. Vertex i of the new model is vertex i of the mesh that desc describes. In every pose, the AO of
 * a vertex is interpolated from the three nearest baked vertices, so it is the AO of the full mesh. `nook
 * bake lod` is an alternative: it fits AO to the shape of the other mesh, offline. The call ignores joints
 * and weights. Pass normals; without them, the call mixes the two sides of a card or a thin limb. The new
 * model gets the bones, spheres, levels and casters of the given model. The new model keeps those check
 * vertices (nook_model_check_pose) that the other mesh contains too. desc->tolerance is the largest distance
 * of a vertex from the baked vertices, as a fraction of the diagonal of the model's bounding box; 0 means
 * 0.05. docs/character.md lists the error for meshes with 50, 25 and 10 % of the triangles. The call
 * allocates. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also for a vertex that is too far away; the message names it),
 * UNSUPPORTED (the model has no rest positions), OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_resample(nook_model model, const nook_vertex_match_desc* desc,
                                         nook_model* out);

#ifdef __cplusplus
}
#endif
#endif
