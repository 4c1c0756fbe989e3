/* The engine of the stranger: what a program has that loaded a rigged glTF file by itself. It knows nothing
 * of Nook. flatten.py reads the glTF file. Matrices are sixteen floats, column-major. */
#ifndef STRANGER_ENGINE_H
#define STRANGER_ENGINE_H

#include <stddef.h>
#include <stdint.h>

typedef struct engine_skin {
  uint32_t joint_count;
  uint32_t* joints; /* nodes */
  float* inverse_bind;
} engine_skin;

/* A primitive in the order of the file's nodes. */
typedef struct engine_part {
  int32_t node, skin; /* skin -1: the mesh is rigid */
  uint32_t first_vertex, vertex_count, influences, index_count;
  float* positions;
  uint32_t* joints;
  float* weights;
  uint32_t* indices; /* from 0 */
} engine_part;

typedef struct engine {
  uint32_t node_count, skin_count, part_count, frame_count, vertex_count, index_count;
  char** names; /* of nodes */
  engine_skin* skins;
  engine_part* parts;
  float* worlds; /* frame by frame the world matrix of each node; frame 0 is the default pose */
} engine;

/* Reads the file of flatten.py. Returns 0 on failure and prints the reason to stderr. */
int engine_read(engine* e, const char* path);
void engine_free(engine* e);

/* Allocates, or ends the program. */
void* engine_memory(size_t bytes);
/* Reads a whole file, or returns NULL. */
void* engine_file(const char* path, size_t* size);

void matrix_product(const float* a, const float* b, float* out);
/* The inverse of an affine matrix. */
void matrix_inverse(const float* m, float* out);
/* A column-major matrix as three rows of four, or as four rows. */
void matrix_rows(const float* m, float* out);
void matrix_transpose(const float* m, float* out);
void matrix_move(const float* m, const float* point, float* out);

const float* engine_world(const engine* e, uint32_t frame, uint32_t node);
/* World matrix times inverse bind matrix, for each joint of a skin: what a vertex shader takes. */
void engine_skinning_matrices(const engine* e, uint32_t frame, uint32_t skin, float* out);
/* Skins one vertex, counted over all parts, or all of them. */
void engine_skinned_vertex(const engine* e, uint32_t frame, uint32_t vertex, float* out);
void engine_skinned_vertices(const engine* e, uint32_t frame, float* out);
/* Area-weighted unit normals of such vertices. */
void engine_normals(const engine* e, const float* positions, float* out);
/* The triangles of all parts, counted over all parts, counter-clockwise from outside. */
void engine_indices(const engine* e, uint32_t* out);

#endif
