/* The vertices of a model in the order of a host's own mesh. Engines re-index, split, strip and optimise
 * meshes; a remapped model gives AO in their order on the CPU and on every tier of OpenGL. A resampled model
 * gives AO for a mesh with other vertices, such as a level of detail. */
#ifndef NOOK_VERTICES_H
#define NOOK_VERTICES_H

#include "nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  /* Every primitive of the file. */
  NOOK_ALL_PRIMITIVES = -1
};

/* In the answer of nook_character_model_match_vertices: no vertex of the model is near enough. */
#define NOOK_NO_VERTEX 0xffffffffu

typedef struct nook_vertex_match {
  /* sizeof(nook_vertex_match); the caller sets it, and the other fields to 0 first. */
  uint32_t struct_size;
  /* The number of the host's vertices. */
  uint32_t vertex_count;
  /* Their rest positions, three floats each, position_stride bytes apart (0: 12). */
  const float* positions;
  size_t position_stride;
  /* NULL, or their normals, three floats each, normal_stride bytes apart (0: 12). They tell the two sides of
   * a card apart, which lie at one place and have AO of their own. */
  const float* normals;
  size_t normal_stride;
  /* The primitive of the file that the vertices come from, or NOOK_ALL_PRIMITIVES. */
  int32_t primitive;
  /* 0: the positions are in the space of the file's POSITION attribute. 1: they are in the model's rest
   * space, metres. */
  uint32_t in_rest_space;
  /* The largest distance of a match, as a share of the diagonal of the model's box; 0: 1e-4, which allows for
   * positions of 16 bits. */
  float tolerance;
  uint32_t reserved;
} nook_vertex_match;

/* Finds the model's vertex for each vertex of a host's mesh by rest position, and by normal among those at
 * one place. vertices takes vertex_count indices in the order of nook_scene_read_ao, NOOK_NO_VERTEX where
 * none is near enough; *unmatched, which may be NULL, takes their number. The call allocates. Any thread.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (the model has no rest positions), OUT_OF_MEMORY. */
NOOK_API nook_result nook_character_model_match_vertices(nook_character_model model,
                                                         const nook_vertex_match* match, uint32_t* vertices,
                                                         uint32_t* unmatched);

/* Makes a model whose vertices are those of a host's mesh: vertex i of the new model is vertex vertices[i] of
 * the given one. Everything else is the same, and is copied. Its primitives are the runs of vertices whose
 * meshes have the same space, which is one primitive for most files. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also for NOOK_NO_VERTEX; the message names the vertex),
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_character_model_remap(nook_character_model model, const uint32_t* vertices,
                                                uint32_t count, nook_character_model* out);

/* Makes a model for another mesh of the same body, such as a level of detail, from a bake of the full mesh:
 * vertex i of the new model is vertex i of the mesh that `mesh` describes. Its AO is what lies between the
 * three baked vertices nearest to it, in every pose: that of the full shape. `nook bake lod` fits it to the
 * shape of the other mesh instead, offline. Give normals: without them the two sides of a limb or a card mix.
 * Bones, spheres, levels and casters are those of the given model; vertices of the pose check that the mesh
 * lacks are left out. mesh->tolerance is the largest distance of a vertex from the baked vertices, as a share
 * of the diagonal of the model's box; 0: 0.05. docs/character.md has the error of meshes with 50, 25 and 10 %
 * of the triangles. The call allocates. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also for a vertex that is too far away; the message names it),
 * UNSUPPORTED (the model has no rest positions), OUT_OF_MEMORY. */
NOOK_API nook_result nook_character_model_resample(nook_character_model model, const nook_vertex_match* mesh,
                                                   nook_character_model* out);

#ifdef __cplusplus
}
#endif
#endif
