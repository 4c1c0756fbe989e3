/* Matches the vertices of a mesh to a model, using triangles too. */
#ifndef NOOK_MATCH_H
#define NOOK_MATCH_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Like nook_model_match_vertices, but also distinguishes vertices by their triangles. On a sharp fold, two
 * vertices may have the same position, normal and weights, but belong to opposite sides. Call this function
 * if you reorder or remove vertices, as mesh optimisers do.
 *
 * `indices` holds three vertex indices of your mesh for each triangle, index_count in total. The triangles
 * must have the same winding as in the file. If `desc` has normals and most triangles face away from them,
 * the call reverses the winding. Vertices without a triangle are matched as in nook_model_match_vertices. The
 * call allocates. Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the model has no rest positions),
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_match_mesh(nook_model model, const nook_vertex_match_desc* desc,
                                           const uint32_t* indices, size_t index_count, uint32_t* vertices,
                                           nook_vertex_match_info* info);

#ifdef __cplusplus
}
#endif
#endif
