/* A knotted tube over a floor, with texture coordinates. Metres, y up. */
#ifndef SHAPE_H
#define SHAPE_H

#include <stdint.h>

typedef struct Shape {
  float* position; /* 3 floats for each vertex */
  float* normal;   /* 3 */
  float* uv;       /* 2, in tiles of the material */
  uint32_t* index; /* triangles, counter-clockwise from outside */
  uint32_t vertex_count, index_count;
} Shape;

/* Returns 0 if there is no memory. */
int shape_make(Shape* shape);
void shape_free(Shape* shape);

#endif
