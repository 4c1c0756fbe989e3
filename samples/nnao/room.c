#include "samples/nnao/room.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Mesh {
  room_vertex* vertices;
  int count, room;
  float albedo[3];
  int failed;
} Mesh;

static void put(Mesh* m, float px, float py, float pz, float nx, float ny, float nz) {
  room_vertex v = {{px, py, pz}, {nx, ny, nz}, {0, 0, 0}};
  if (m->count == m->room) {
    const int room = m->room ? 2 * m->room : 4096;
    room_vertex* const more = realloc(m->vertices, (size_t)room * sizeof *more);
    if (!more) {
      m->failed = 1;
      return;
    }
    m->vertices = more;
    m->room = room;
  }
  memcpy(v.albedo, m->albedo, sizeof v.albedo);
  m->vertices[m->count++] = v;
}

/* Adds one side of a box. The normal is along the axis. The side is 0 for the low end and 1 for the high end.
 */
static void put_side(Mesh* m, const float low[3], const float high[3], int axis, int side) {
  static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  float n[3] = {0, 0, 0}, p[3];
  n[axis] = side ? 1.0F : -1.0F;
  for (int i = 0; i < 6; ++i) {
    p[axis] = side ? high[axis] : low[axis];
    p[u] = corners[i][0] ? high[u] : low[u];
    p[v] = corners[i][1] ? high[v] : low[v];
    put(m, p[0], p[1], p[2], n[0], n[1], n[2]);
  }
}

static void put_box(Mesh* m, float x, float y, float z, float width, float height, float depth) {
  const float low[3] = {x - width / 2, y, z - depth / 2},
              high[3] = {x + width / 2, y + height, z + depth / 2};
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) put_side(m, low, high, axis, side);
}

/* Adds a surface of revolution around a vertical axis, from (r[0], y[0]) to (r[1], y[1]). The normals have
 * the components nr away from the axis and ny upwards. */
static void put_ring(Mesh* m, float x, float z, const float r[2], const float y[2], const float nr[2],
                     const float ny[2]) {
  enum { sides = 48 };
  static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < sides; ++i)
    for (int c = 0; c < 6; ++c) {
      const float angle = 6.2831853F * (float)(i + corners[c][0]) / sides;
      const int e = corners[c][1];
      put(m, x + r[e] * cosf(angle), y[e], z + r[e] * sinf(angle), nr[e] * cosf(angle), ny[e],
          nr[e] * sinf(angle));
    }
}

static void put_column(Mesh* m, float x, float z, float radius, float height) {
  const float r[2] = {radius, radius}, y[2] = {0, height}, one[2] = {1, 1}, zero[2] = {0, 0};
  put_ring(m, x, z, r, y, one, zero);
  put_box(m, x, 0, z, 3 * radius, 0.12F, 3 * radius);
}

static void put_ball(Mesh* m, float x, float y, float z, float radius) {
  enum { rings = 24 };
  for (int i = 0; i < rings; ++i) {
    float r[2], h[2], nr[2], ny[2];
    for (int e = 0; e < 2; ++e) {
      const float angle = 3.1415927F * ((float)(i + e) / rings - 0.5F);
      nr[e] = cosf(angle);
      ny[e] = sinf(angle);
      r[e] = radius * nr[e];
      h[e] = y + radius * ny[e];
    }
    put_ring(m, x, z, r, h, nr, ny);
  }
}

static void paint(Mesh* m, float r, float g, float b) {
  m->albedo[0] = r;
  m->albedo[1] = g;
  m->albedo[2] = b;
}

room_vertex* room_make(int* count) {
  Mesh m = {NULL, 0, 0, {0, 0, 0}, 0};
  paint(&m, 0.72F, 0.70F, 0.66F);
  put_box(&m, 0, -0.1F, 0, 8, 0.1F, 8);
  put_box(&m, 0, 0, -2.6F, 8, 3, 0.2F);
  put_box(&m, -3.1F, 0, 0, 0.2F, 3, 8);
  paint(&m, 0.62F, 0.60F, 0.58F);
  for (int i = 0; i < 6; ++i)
    put_box(&m, 2.1F, 0, -2.3F + 0.3F * (float)(5 - i), 1.4F, 0.18F * (float)(i + 1), 0.3F);
  paint(&m, 0.80F, 0.78F, 0.74F);
  for (int i = 0; i < 3; ++i) put_column(&m, -2.2F + 1.5F * (float)i, -1.9F, 0.16F, 2.4F);
  paint(&m, 0.66F, 0.48F, 0.30F);
  put_box(&m, -2.3F, 0, -0.4F, 0.7F, 0.7F, 0.7F);
  put_box(&m, -2.35F, 0.7F, -0.45F, 0.5F, 0.5F, 0.5F);
  put_box(&m, -1.6F, 0, -0.75F, 0.5F, 0.5F, 0.5F);
  put_box(&m, 0.2F, 0.70F, -0.3F, 1.3F, 0.05F, 0.7F);
  for (int i = 0; i < 4; ++i) put_box(&m, i & 1 ? 0.8F : -0.4F, 0, i & 2 ? 0.0F : -0.6F, 0.05F, 0.70F, 0.05F);
  paint(&m, 0.35F, 0.50F, 0.65F);
  put_ball(&m, 0.1F, 0.95F, -0.3F, 0.2F);
  put_ball(&m, 0.2F, 0.25F, -0.3F, 0.25F);
  put_ball(&m, -1.0F, 0.2F, 0.4F, 0.2F);
  if (m.failed) {
    free(m.vertices);
    m.vertices = NULL;
  }
  *count = m.count;
  return m.vertices;
}

void room_view(float view[16]) {
  const float eye[3] = {1.2F, 1.9F, 3.2F}, yaw = 0.42F, pitch = -0.30F;
  const float cy = cosf(yaw), sy = sinf(yaw), cp = cosf(pitch), sp = sinf(pitch);
  const float rows[3][3] = {{cy, 0, -sy}, {sy * sp, cp, cy * sp}, {sy * cp, -sp, cy * cp}};
  memset(view, 0, 16 * sizeof *view);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      view[4 * column + row] = rows[row][column];
      view[12 + row] -= rows[row][column] * eye[column];
    }
  view[15] = 1;
}
