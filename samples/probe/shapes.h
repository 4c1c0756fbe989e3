/* Makes the shapes that the probe lights: a sphere and a posed character. */
#ifndef SHAPES_H
#define SHAPES_H

#include <nook/nook_probe.h>

/* A triangle mesh in world space. Each vertex has three floats; positions are in metres. */
typedef struct Shape {
  float* position;
  float* normal;
  float* occlusion; /* directional AO, RGB; NULL if the shape is fully open */
  unsigned* index;
  int vertex_count, index_count;
} Shape;

/* Makes a sphere of unit radius around the origin. Returns 0 if memory runs out. */
int sphere_make(Shape* shape);
/* Makes a character in the middle of its file's first clip, on the ground plane y = 0, with the directional
 * occlusion that its model gives under the lobes. Returns 0 on failure and prints the reason to stderr. */
int character_make(Shape* shape, nook_context context, const char* glb_path, const char* model_path,
                   const nook_lobe* lobes, unsigned lobe_count);
void shape_free(Shape* shape);

/* Reads a whole file, which the caller frees. Returns NULL on failure and prints the reason to stderr. */
unsigned char* read_bytes(const char* path, size_t* size);

#endif
