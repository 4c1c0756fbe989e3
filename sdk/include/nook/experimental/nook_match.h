/* Finds the vertices of a mesh in a model by its triangles too. */
#ifndef NOOK_MATCH_H
#define NOOK_MATCH_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Does what nook_model_match_vertices does, and tells vertices apart by their triangles. On a sharp fold, two
 * vertices may have the same place, normal and weights, and look to opposite sides. Call this function if you
 * shuffle or strip vertices, as mesh optimisers do.
 *
 * indices holds three vertices of your mesh for each triangle, index_count numbers in all. The triangles wind
 * as they do in the file. If desc has normals and most triangles look away from them, the call
 * reverses the winding. Vertices without a triangle are matched as nook_model_match_vertices matches them.
 * The call allocates. Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the model has no rest positions),
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_match_mesh(nook_model model, const nook_vertex_match_desc* desc,
                                           const uint32_t* indices, size_t index_count, uint32_t* vertices,
                                           nook_vertex_match_info* info);

#ifdef __cplusplus
}
#endif
#endif
