#include "tests/stranger/engine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void* engine_memory(size_t bytes) {
  void* const out = calloc(bytes ? bytes : 1, 1);
  if (out) return out;
  fputs("stranger: out of memory\n", stderr);
  exit(1);
}

void* engine_file(const char* path, size_t* size) {
  FILE* const file = fopen(path, "rb");
  void* bytes = NULL;
  long length;
  if (!file) return NULL;
  if (fseek(file, 0, SEEK_END) == 0 && (length = ftell(file)) >= 0 && fseek(file, 0, SEEK_SET) == 0) {
    *size = (size_t)length;
    bytes = engine_memory(*size);
    if (fread(bytes, 1, *size, file) != *size) {
      free(bytes);
      bytes = NULL;
    }
  }
  fclose(file);
  return bytes;
}

/* The bytes of the file from the front. Once they run out, everything reads as 0. */
typedef struct reader {
  const unsigned char* at;
  size_t left;
  int failed;
} reader;

static void take(reader* r, void* out, size_t bytes) {
  memset(out, 0, bytes);
  if (r->failed || r->left < bytes) {
    r->failed = 1;
    return;
  }
  memcpy(out, r->at, bytes);
  r->at += bytes;
  r->left -= bytes;
}

static uint32_t take_number(reader* r) {
  uint32_t out;
  take(r, &out, sizeof out);
  return out;
}

static void* take_array(reader* r, size_t count, size_t size) {
  void* out;
  if (count > r->left / size) {
    r->failed = 1;
    return NULL;
  }
  out = engine_memory(count * size);
  take(r, out, count * size);
  return out;
}

static void read_names(engine* e, reader* r) {
  e->names = engine_memory(e->node_count * sizeof *e->names);
  for (uint32_t n = 0; n < e->node_count && !r->failed; ++n) {
    const uint32_t length = take_number(r);
    char* const text = take_array(r, length, 1);
    e->names[n] = engine_memory((size_t)length + 1);
    if (text) memcpy(e->names[n], text, length);
    free(text);
  }
}

static void read_skins(engine* e, reader* r) {
  e->skins = engine_memory(e->skin_count * sizeof *e->skins);
  for (uint32_t s = 0; s < e->skin_count && !r->failed; ++s) {
    engine_skin* const skin = &e->skins[s];
    skin->joint_count = take_number(r);
    skin->joints = take_array(r, skin->joint_count, sizeof *skin->joints);
    skin->inverse_bind = take_array(r, 16 * (size_t)skin->joint_count, sizeof *skin->inverse_bind);
  }
}

static void read_parts(engine* e, reader* r) {
  e->parts = engine_memory(e->part_count * sizeof *e->parts);
  for (uint32_t p = 0; p < e->part_count && !r->failed; ++p) {
    engine_part* const part = &e->parts[p];
    take(r, &part->node, sizeof part->node);
    take(r, &part->skin, sizeof part->skin);
    part->vertex_count = take_number(r);
    part->influences = take_number(r);
    part->index_count = take_number(r);
    const size_t pairs = (size_t)part->vertex_count * part->influences;
    part->positions = take_array(r, 3 * (size_t)part->vertex_count, sizeof *part->positions);
    if (r->failed || pairs > r->left) return;
    part->joints = engine_memory(pairs * sizeof *part->joints);
    part->weights = engine_memory(pairs * sizeof *part->weights);
    for (size_t v = 0; v < part->vertex_count; ++v) {
      take(r, part->joints + v * part->influences, part->influences * sizeof *part->joints);
      take(r, part->weights + v * part->influences, part->influences * sizeof *part->weights);
    }
    part->indices = take_array(r, part->index_count, sizeof *part->indices);
    part->first_vertex = e->vertex_count;
    e->vertex_count += part->vertex_count;
    e->index_count += part->index_count;
  }
}

int engine_read(engine* e, const char* path) {
  const uint32_t mark = 0x54534b4e;
  size_t size = 0;
  void* const bytes = engine_file(path, &size);
  reader r;
  memset(e, 0, sizeof *e);
  r.at = bytes;
  r.left = size;
  r.failed = !bytes;
  if (take_number(&r) != mark) r.failed = 1;
  e->node_count = take_number(&r);
  e->skin_count = take_number(&r);
  e->part_count = take_number(&r);
  e->frame_count = take_number(&r);
  if (!r.failed) read_names(e, &r);
  if (!r.failed) read_skins(e, &r);
  if (!r.failed) read_parts(e, &r);
  if (!r.failed) e->worlds = take_array(&r, 16 * (size_t)e->frame_count * e->node_count, sizeof *e->worlds);
  free(bytes);
  if (!r.failed && r.left == 0) return 1;
  fprintf(stderr, "stranger: %s is not a file of flatten.py\n", path);
  return 0;
}

void engine_free(engine* e) {
  for (uint32_t n = 0; n < e->node_count; ++n) free(e->names[n]);
  for (uint32_t s = 0; s < e->skin_count; ++s) {
    free(e->skins[s].joints);
    free(e->skins[s].inverse_bind);
  }
  for (uint32_t p = 0; p < e->part_count; ++p) {
    free(e->parts[p].positions);
    free(e->parts[p].joints);
    free(e->parts[p].weights);
    free(e->parts[p].indices);
  }
  free(e->names);
  free(e->skins);
  free(e->parts);
  free(e->worlds);
  memset(e, 0, sizeof *e);
}

void matrix_product(const float* a, const float* b, float* out) {
  float product[16];
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      double sum = 0;
      for (int k = 0; k < 4; ++k) sum += (double)a[4 * k + row] * (double)b[4 * column + k];
      product[4 * column + row] = (float)sum;
    }
  memcpy(out, product, sizeof product);
}

void matrix_inverse(const float* m, float* out) {
  float inverse[16] = {0};
  double determinant = 0, cofactor[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      cofactor[i][j] =
          (double)m[4 * a + c] * (double)m[4 * b + d] - (double)m[4 * a + d] * (double)m[4 * b + c];
    }
  for (int i = 0; i < 3; ++i) determinant += (double)m[i] * cofactor[0][i];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse[4 * j + i] = (float)(cofactor[i][j] / determinant);
  for (int row = 0; row < 3; ++row) {
    double moved = 0;
    for (int k = 0; k < 3; ++k) moved -= cofactor[row][k] / determinant * (double)m[12 + k];
    inverse[12 + row] = (float)moved;
  }
  inverse[15] = 1;
  memcpy(out, inverse, sizeof inverse);
}

void matrix_rows(const float* m, float* out) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) out[4 * row + column] = m[4 * column + row];
}

void matrix_transpose(const float* m, float* out) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) out[4 * row + column] = m[4 * column + row];
}

void matrix_move(const float* m, const float* point, float* out) {
  float moved[3];
  for (int row = 0; row < 3; ++row)
    moved[row] = m[row] * point[0] + m[4 + row] * point[1] + m[8 + row] * point[2] + m[12 + row];
  memcpy(out, moved, sizeof moved);
}

const float* engine_world(const engine* e, uint32_t frame, uint32_t node) {
  return e->worlds + 16 * ((size_t)frame * e->node_count + node);
}

void engine_skinning_matrices(const engine* e, uint32_t frame, uint32_t skin, float* out) {
  for (uint32_t j = 0; j < e->skins[skin].joint_count; ++j)
    matrix_product(engine_world(e, frame, e->skins[skin].joints[j]),
                   e->skins[skin].inverse_bind + 16 * (size_t)j, out + 16 * (size_t)j);
}

/* Skins a vertex by the skinning matrices of the skin of its part. */
static void skin_vertex(const engine* e, uint32_t frame, const engine_part* part, const float* matrices,
                        size_t v, float* out) {
  const float* const position = part->positions + 3 * v;
  double sum[3] = {0, 0, 0}, total = 0;
  if (part->skin < 0) {
    matrix_move(engine_world(e, frame, (uint32_t)part->node), position, out);
    return;
  }
  for (size_t k = v * part->influences; k < (v + 1) * part->influences; ++k) {
    float moved[3];
    if (part->weights[k] <= 0) continue;
    matrix_move(matrices + 16 * (size_t)part->joints[k], position, moved);
    for (int i = 0; i < 3; ++i) sum[i] += (double)part->weights[k] * (double)moved[i];
    total += (double)part->weights[k];
  }
  for (int i = 0; i < 3; ++i) out[i] = (float)(sum[i] / total);
}

static float* matrices_of(const engine* e, uint32_t frame, const engine_part* part) {
  float* out;
  if (part->skin < 0) return NULL;
  out = engine_memory(16 * sizeof *out * e->skins[part->skin].joint_count);
  engine_skinning_matrices(e, frame, (uint32_t)part->skin, out);
  return out;
}

void engine_skinned_vertex(const engine* e, uint32_t frame, uint32_t vertex, float* out) {
  for (uint32_t p = 0; p < e->part_count; ++p) {
    const engine_part* const part = &e->parts[p];
    if (vertex - part->first_vertex >= part->vertex_count) continue;
    float* const matrices = matrices_of(e, frame, part);
    skin_vertex(e, frame, part, matrices, vertex - part->first_vertex, out);
    free(matrices);
    return;
  }
}

void engine_skinned_vertices(const engine* e, uint32_t frame, float* out) {
  for (uint32_t p = 0; p < e->part_count; ++p) {
    const engine_part* const part = &e->parts[p];
    float* const matrices = matrices_of(e, frame, part);
    for (size_t v = 0; v < part->vertex_count; ++v)
      skin_vertex(e, frame, part, matrices, v, out + 3 * (part->first_vertex + v));
    free(matrices);
  }
}

/* The sign of the determinant of a part's first matrix in the default pose: a mirrored mesh has its triangles
 * the other way round, as glTF says. */
static int is_mirrored(const engine* e, const engine_part* part) {
  float m[16];
  double determinant = 0;
  memcpy(m, engine_world(e, 0, (uint32_t)part->node), sizeof m);
  if (part->skin >= 0)
    matrix_product(engine_world(e, 0, e->skins[part->skin].joints[0]), e->skins[part->skin].inverse_bind, m);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += (double)m[i] * ((double)m[4 + j] * (double)m[8 + k] - (double)m[4 + k] * (double)m[8 + j]);
  }
  return determinant < 0;
}

void engine_indices(const engine* e, uint32_t* out) {
  for (uint32_t p = 0; p < e->part_count; ++p) {
    const engine_part* const part = &e->parts[p];
    const size_t second = is_mirrored(e, part) ? 2 : 1;
    for (size_t i = 0; i + 2 < part->index_count; i += 3) {
      *out++ = part->first_vertex + part->indices[i];
      *out++ = part->first_vertex + part->indices[i + second];
      *out++ = part->first_vertex + part->indices[i + 3 - second];
    }
  }
}

void engine_normals(const engine* e, const float* positions, float* out) {
  uint32_t* const indices = engine_memory(e->index_count * sizeof *indices);
  double* const sums = engine_memory(3 * sizeof *sums * e->vertex_count);
  engine_indices(e, indices);
  for (size_t t = 0; t + 2 < e->index_count; t += 3) {
    const float *a = positions + 3 * indices[t], *b = positions + 3 * indices[t + 1],
                *c = positions + 3 * indices[t + 2];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double n =
          (double)(b[j] - a[j]) * (double)(c[k] - a[k]) - (double)(b[k] - a[k]) * (double)(c[j] - a[j]);
      for (int corner = 0; corner < 3; ++corner) sums[3 * indices[t + (size_t)corner] + (size_t)i] += n;
    }
  }
  for (size_t v = 0; v < e->vertex_count; ++v) {
    const double* const n = sums + 3 * v;
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; ++i)
      out[3 * v + (size_t)i] = length > 0 ? (float)(n[i] / length) : (float)(i == 1);
  }
  free(indices);
  free(sums);
}
