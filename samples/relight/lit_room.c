#include "samples/relight/lit_room.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Mesh {
  room_vertex* vertices;
  int count, space, failed;
  room_vertex paint; /* has the colour and gloss of the vertices that are added next */
} Mesh;

static void paint(Mesh* m, float red, float green, float blue, float roughness, float reflectance) {
  m->paint.albedo[0] = red;
  m->paint.albedo[1] = green;
  m->paint.albedo[2] = blue;
  m->paint.roughness = roughness;
  m->paint.reflectance = reflectance;
}

static void put(Mesh* m, const float position[3], const float normal[3]) {
  room_vertex v = m->paint;
  if (m->count == m->space) {
    const int space = m->space ? 2 * m->space : 4096;
    room_vertex* const more = realloc(m->vertices, (size_t)space * sizeof *more);
    if (!more) {
      m->failed = 1;
      return;
    }
    m->vertices = more;
    m->space = space;
  }
  memcpy(v.position, position, sizeof v.position);
  memcpy(v.normal, normal, sizeof v.normal);
  m->vertices[m->count++] = v;
}

static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};

static void put_box(Mesh* m, float x0, float y0, float z0, float x1, float y1, float z1) {
  const float low[3] = {x0, y0, z0}, high[3] = {x1, y1, z1};
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    float n[3] = {0, 0, 0}, p[3];
    n[axis] = side % 2 ? 1.0F : -1.0F;
    for (int i = 0; i < 6; ++i) {
      p[axis] = side % 2 ? high[axis] : low[axis];
      p[u] = corners[i][0] ? high[u] : low[u];
      p[v] = corners[i][1] ? high[v] : low[v];
      put(m, p, n);
    }
  }
}

static void put_sphere(Mesh* m, float x, float y, float z, float radius) {
  enum { rings = 32, sides = 64 };
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side)
      for (int i = 0; i < 6; ++i) {
        const float down = 3.14159265F * (float)(ring + corners[i][0]) / rings,
                    turn = 6.2831853F * (float)(side + corners[i][1]) / sides;
        const float n[3] = {sinf(down) * cosf(turn), cosf(down), sinf(down) * sinf(turn)};
        const float p[3] = {x + radius * n[0], y + radius * n[1], z + radius * n[2]};
        put(m, p, n);
      }
}

static void put_walls(Mesh* m) {
  const float t = 0.2F; /* thickness of the walls, metres */
  paint(m, 0.55F, 0.42F, 0.3F, 1, 0);
  put_box(m, -3, -t, -2.5F, 3, 0, 2.5F);
  paint(m, 0.8F, 0.8F, 0.78F, 1, 0);
  put_box(m, -3 - t, 3, -2.5F - t, 3 + t, 3 + t, 2.5F + t);
  put_box(m, -3 - t, -t, 2.5F, 3 + t, 3, 2.5F + t);
  put_box(m, -3 - t, -t, -2.5F, -3, 3, 2.5F);
  paint(m, 0.75F, 0.2F, 0.12F, 1, 0);
  put_box(m, -3 - t, -t, -2.5F - t, 3 + t, 3, -2.5F);
  /* The wall around the window. */
  paint(m, 0.8F, 0.8F, 0.78F, 1, 0);
  put_box(m, 3, -t, -2.5F, 3 + t, 0.7F, 2.5F);
  put_box(m, 3, 2.5F, -2.5F, 3 + t, 3, 2.5F);
  put_box(m, 3, 0.7F, -2.5F, 3 + t, 2.5F, -1.5F);
  put_box(m, 3, 0.7F, 1.5F, 3 + t, 2.5F, 2.5F);
}

static void put_furniture(Mesh* m) {
  paint(m, 0.35F, 0.24F, 0.15F, 1, 0);
  put_box(m, -1.1F, 0.68F, -0.9F, 0.9F, 0.74F, 0.1F);
  for (int i = 0; i < 4; ++i) {
    const float x = i % 2 ? 0.8F : -1.05F, z = i / 2 ? 0 : -0.85F;
    put_box(m, x, 0, z, x + 0.06F, 0.68F, z + 0.06F);
  }
  paint(m, 0.2F, 0.35F, 0.55F, 1, 0);
  put_box(m, 1.6F, 0, -2.5F, 2.6F, 1.2F, -1.9F);
  paint(m, 0.95F, 0.93F, 0.88F, 0.3F, 0.9F);
  put_sphere(m, -0.75F, 1, -0.4F, 0.26F);
  paint(m, 0.95F, 0.93F, 0.88F, 0.6F, 0.9F);
  put_sphere(m, -0.1F, 1, -0.4F, 0.26F);
  paint(m, 0.7F, 0.7F, 0.7F, 0.25F, 0.04F);
  put_sphere(m, 0.55F, 1, -0.4F, 0.26F);
  paint(m, 0.7F, 0.7F, 0.7F, 1, 0);
  put_sphere(m, 1.5F, 0.35F, 0.9F, 0.35F);
}

room_vertex* room_make(int* count) {
  Mesh m;
  memset(&m, 0, sizeof m);
  put_walls(&m);
  put_furniture(&m);
  /* The ground outside. */
  paint(&m, 0.3F, 0.33F, 0.2F, 1, 0);
  put_box(&m, 3.2F, -1, -40, 60, -0.5F, 40);
  *count = m.failed ? 0 : m.count;
  if (!m.failed) return m.vertices;
  free(m.vertices);
  return NULL;
}
