/* What the probe lights: a sphere and a posed character. */
#ifndef SHAPES_H
#define SHAPES_H

#include <nook/nook_probe.h>

/* Corner points, three floats each; occlusion NULL: fully open. World space, metres. */
typedef struct Shape {
  float* position;
  float* normal;
  float* occlusion; /* what the light is multiplied with, RGB */
  unsigned* index;
  int vertex_count, index_count;
} Shape;

/* Unit radius round the origin. 0: out of memory. */
int sphere_make(Shape* shape);
/* The first clip of a character's file at its middle, on a ground plane y = 0, with the directional occlusion
 * that its model has under the lobes. 0: failed, and a line on stderr says why. */
int character_make(Shape* shape, nook_context context, const char* glb_path, const char* model_path,
                   const nook_probe_lobe* lobes, unsigned lobe_count);
void shape_free(Shape* shape);

/* The bytes of a file, which the caller frees. NULL: failed, and a line on stderr says why. */
unsigned char* read_bytes(const char* path, size_t* size);

#endif
