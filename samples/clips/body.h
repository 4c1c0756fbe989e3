/* The body that crowd and heroes share: its mesh in OpenGL, and its .glb file for live poses. */
#ifndef CLIPS_BODY_H
#define CLIPS_BODY_H

#include <nook/nook_bake.h>

#include "samples/offscreen/offscreen.h"

/* In the vertex array, location 0 is the rest position, 1 the rest normal, 2 four joints and 3 their weights.
 * Vertices are in file order, which is also the order of AO. */
typedef struct Body {
  nook_bake_character character;
  nook_bake_character_info info;
  GLuint vertex_array;
} Body;

/* Reads a .glb file. Returns 0 on failure and prints the reason to stderr. */
int body_load(Body* body, const char* glb_path);
void body_free(Body* body);

/* Reads a whole file, which the caller frees. Returns NULL on failure and prints the reason to stderr. */
unsigned char* read_bytes(const char* path, size_t* size);

#endif
