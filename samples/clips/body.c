#include "samples/clips/body.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

unsigned char* read_bytes(const char* path, size_t* size) {
  FILE* const file = fopen(path, "rb");
  unsigned char* bytes = NULL;
  long length = -1;
  if (file && fseek(file, 0, SEEK_END) == 0) length = ftell(file);
  if (length >= 0 && fseek(file, 0, SEEK_SET) == 0) bytes = malloc((size_t)length + 1);
  *size = bytes ? fread(bytes, 1, (size_t)length, file) : 0;
  if (file) fclose(file);
  if (bytes && *size == (size_t)length) return bytes;
  fprintf(stderr, "clips: %s cannot be read; check the path\n", path);
  free(bytes);
  return NULL;
}

/* Copies an array of the character to the buffer that is bound to the target. */
static nook_result upload(const Body* body, GLenum target, nook_bake_array array, unsigned count,
                          size_t element) {
  void* const values = malloc(count * element);
  GLuint buffer = 0;
  nook_result r = NOOK_ERROR_OUT_OF_MEMORY;
  if (!values) return r;
  r = nook_bake_character_read(body->character, array, values, count, 0);
  glGenBuffers(1, &buffer);
  glBindBuffer(target, buffer);
  glBufferData(target, (GLsizeiptr)(count * element), values, GL_STATIC_DRAW);
  free(values);
  return r;
}

static nook_result make_vertex_array(Body* body) {
  static const struct {
    nook_bake_array array;
    int size;
  } fields[4] = {{NOOK_BAKE_ARRAY_POSITIONS, 3},
                 {NOOK_BAKE_ARRAY_NORMALS, 3},
                 {NOOK_BAKE_ARRAY_JOINTS, 4},
                 {NOOK_BAKE_ARRAY_WEIGHTS, 4}};
  nook_result r = NOOK_OK;
  glGenVertexArrays(1, &body->vertex_array);
  glBindVertexArray(body->vertex_array);
  for (GLuint i = 0; i < 4 && !r; ++i) {
    const int joints = fields[i].array == NOOK_BAKE_ARRAY_JOINTS;
    r = upload(body, GL_ARRAY_BUFFER, fields[i].array, body->info.file_vertex_count,
               (size_t)fields[i].size * (joints ? sizeof(uint16_t) : sizeof(float)));
    glEnableVertexAttribArray(i);
    if (joints)
      glVertexAttribIPointer(i, fields[i].size, GL_UNSIGNED_SHORT, 0, NULL);
    else
      glVertexAttribPointer(i, fields[i].size, GL_FLOAT, GL_FALSE, 0, NULL);
  }
  if (!r)
    r = upload(body, GL_ELEMENT_ARRAY_BUFFER, NOOK_BAKE_ARRAY_TRIANGLES, body->info.triangle_count,
               3 * sizeof(uint32_t));
  return r;
}

int body_load(Body* body, const char* glb_path) {
  nook_bake_source_desc source;
  nook_result r = nook_bake_source_desc_init(&source);
  source.path = glb_path;
  body->info.struct_size = sizeof body->info;
  if (!r) r = nook_bake_character_create(&source, &body->character);
  if (!r) r = nook_bake_character_describe(body->character, &body->info);
  if (!r) r = make_vertex_array(body);
  if (r) fprintf(stderr, "%s (%s)\n", nook_bake_last_message(), nook_result_name(r));
  return !r;
}

void body_free(Body* body) {
  nook_bake_character_destroy(&body->character);
}
