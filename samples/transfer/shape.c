#include "samples/transfer/shape.h"

#include <math.h>
#include <stdlib.h>

enum { along = 301, around = 25, floor_side = 61 };
static const float pi = 3.14159265F;

static void knot_point(float a, float p[3]) {
  const float radius = 0.3F * (1 + 0.45F * cosf(3 * a));
  p[0] = radius * cosf(2 * a);
  p[1] = 0.25F + 0.135F * sinf(3 * a);
  p[2] = radius * sinf(2 * a);
}

static void unit(float v[3]) {
  const float size = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (int i = 0; i < 3; ++i) v[i] /= size;
}

static void cross(const float a[3], const float b[3], float out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

static void add_vertex(Shape* s, const float position[3], const float normal[3], float u, float v) {
  const uint32_t at = s->vertex_count++;
  for (int i = 0; i < 3; ++i) {
    s->position[3 * at + (uint32_t)i] = position[i];
    s->normal[3 * at + (uint32_t)i] = normal[i];
  }
  s->uv[2 * at] = u;
  s->uv[2 * at + 1] = v;
}

/* Adds two triangles for each cell of a grid of vertices. Rows follow each other. */
static void add_grid(Shape* s, uint32_t first, uint32_t columns, uint32_t rows) {
  for (uint32_t r = 0; r + 1 < rows; ++r)
    for (uint32_t c = 0; c + 1 < columns; ++c) {
      const uint32_t at = first + r * columns + c;
      const uint32_t corners[6] = {at, at + 1, at + columns, at + 1, at + columns + 1, at + columns};
      for (int i = 0; i < 6; ++i) s->index[s->index_count++] = corners[i];
    }
}

static void add_knot(Shape* s) {
  const float up[3] = {0, 1, 0}, tube = 0.085F;
  const uint32_t first = s->vertex_count;
  for (int k = 0; k < around; ++k)
    for (int i = 0; i < along; ++i) {
      const float a = 2 * pi * (float)(i % (along - 1)) / (float)(along - 1);
      const float b = 2 * pi * (float)(k % (around - 1)) / (float)(around - 1);
      float before[3], after[3], forward[3], side[3], high[3], normal[3], position[3];
      knot_point(a - 1e-3F, before);
      knot_point(a + 1e-3F, after);
      for (int c = 0; c < 3; ++c) forward[c] = after[c] - before[c];
      unit(forward);
      cross(forward, up, side);
      unit(side);
      cross(side, forward, high);
      for (int c = 0; c < 3; ++c) normal[c] = side[c] * cosf(b) + high[c] * sinf(b);
      unit(normal);
      knot_point(a, position);
      for (int c = 0; c < 3; ++c) position[c] += tube * normal[c];
      add_vertex(s, position, normal, 24 * (float)i / (float)(along - 1), 3 * (float)k / (float)(around - 1));
    }
  add_grid(s, first, along, around);
}

static void add_floor(Shape* s) {
  const float up[3] = {0, 1, 0};
  const uint32_t first = s->vertex_count;
  for (int r = 0; r < floor_side; ++r)
    for (int c = 0; c < floor_side; ++c) {
      const float x = (float)c / (float)(floor_side - 1), y = (float)r / (float)(floor_side - 1);
      const float position[3] = {1.5F * (x - 0.5F), 0, 1.5F * (0.5F - y)};
      add_vertex(s, position, up, 8 * x, 8 * y);
    }
  add_grid(s, first, floor_side, floor_side);
}

int shape_make(Shape* s) {
  const size_t vertices = (size_t)along * around + (size_t)floor_side * floor_side;
  const size_t indices =
      6 * ((size_t)(along - 1) * (around - 1) + (size_t)(floor_side - 1) * (floor_side - 1));
  s->position = malloc(3 * vertices * sizeof *s->position);
  s->normal = malloc(3 * vertices * sizeof *s->normal);
  s->uv = malloc(2 * vertices * sizeof *s->uv);
  s->index = malloc(indices * sizeof *s->index);
  s->vertex_count = s->index_count = 0;
  if (!s->position || !s->normal || !s->uv || !s->index) return 0;
  add_knot(s);
  add_floor(s);
  return 1;
}

void shape_free(Shape* s) {
  free(s->position);
  free(s->normal);
  free(s->uv);
  free(s->index);
}
