#include "samples/probe/shapes.h"

#include <math.h>
#include <nook/nook_bake.h>
#include <nook/nook_character.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int shape_allocate(Shape* shape, int vertices, int indices, int with_occlusion) {
  const size_t bytes = (size_t)vertices * 3 * sizeof(float);
  memset(shape, 0, sizeof *shape);
  shape->vertex_count = vertices;
  shape->index_count = indices;
  shape->position = malloc(bytes);
  shape->normal = malloc(bytes);
  shape->occlusion = with_occlusion ? malloc(bytes) : NULL;
  shape->index = malloc((size_t)indices * sizeof *shape->index);
  return shape->position && shape->normal && shape->index && (shape->occlusion || !with_occlusion);
}

void shape_free(Shape* shape) {
  free(shape->position);
  free(shape->normal);
  free(shape->occlusion);
  free(shape->index);
  memset(shape, 0, sizeof *shape);
}

int sphere_make(Shape* shape) {
  enum { columns = 96, rows = 48 };
  const float pi = 3.14159265F;
  unsigned* index;
  if (!shape_allocate(shape, (columns + 1) * (rows + 1), 6 * columns * rows, 0)) return 0;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) {
      const float polar = pi * (float)r / rows, azimuth = 2 * pi * (float)c / columns;
      float* const p = shape->position + 3 * (r * (columns + 1) + c);
      p[0] = sinf(polar) * cosf(azimuth);
      p[1] = cosf(polar);
      p[2] = sinf(polar) * sinf(azimuth);
    }
  memcpy(shape->normal, shape->position, (size_t)shape->vertex_count * 3 * sizeof(float));
  index = shape->index;
  for (unsigned r = 0; r < rows; ++r)
    for (unsigned c = 0; c < columns; ++c) {
      const unsigned a = r * (columns + 1) + c, b = a + columns + 1;
      const unsigned corners[6] = {a, a + 1, b, a + 1, b + 1, b};
      memcpy(index, corners, sizeof corners);
      index += 6;
    }
  return 1;
}

unsigned char* read_bytes(const char* path, size_t* size) {
  FILE* const file = fopen(path, "rb");
  unsigned char* bytes = NULL;
  long length = -1;
  if (file && fseek(file, 0, SEEK_END) == 0) length = ftell(file);
  if (length >= 0 && fseek(file, 0, SEEK_SET) == 0) bytes = malloc((size_t)length + 1);
  *size = bytes ? fread(bytes, 1, (size_t)length, file) : 0;
  if (file) fclose(file);
  if (bytes && *size == (size_t)length) return bytes;
  fprintf(stderr, "probe: %s cannot be read; check the path\n", path);
  free(bytes);
  return NULL;
}

/* Poses the file's vertices in the middle of its first clip, or in the rest pose if there is no clip. */
static nook_result pose_character(Shape* shape, nook_bake_character character,
                                  const nook_bake_character_info* info, float* bones) {
  float duration_s = 0;
  nook_result r = NOOK_OK;
  for (unsigned b = 0; b < info->bone_count; ++b) {
    memset(bones + 12 * b, 0, 12 * sizeof *bones);
    bones[12 * b] = bones[12 * b + 5] = bones[12 * b + 10] = 1;
  }
  if (info->clip_count > 0) {
    r = nook_bake_character_clip_duration(character, 0, &duration_s);
    if (!r) r = nook_bake_character_sample_clip(character, 0, 0.5F * duration_s, bones, info->bone_count);
  }
  if (!r)
    r = nook_bake_character_skin(character, bones, info->bone_count, shape->position, shape->normal,
                                 info->file_vertex_count);
  if (!r)
    r = nook_bake_character_read(character, NOOK_BAKE_ARRAY_TRIANGLES, shape->index, info->triangle_count, 0);
  return r;
}

/* ---- What an engine does: the light, the pose, the update ---- */
static nook_result occlude(Shape* shape, nook_context context, const void* model_bytes, size_t model_size,
                           const float* bones, unsigned bone_count, const nook_lobe* lobes,
                           unsigned lobe_count) {
  const float ground[4] = {0, 1, 0, 0};
  nook_model model = NULL;
  nook_scene scene = NULL;
  nook_scene_desc desc;
  nook_pose_desc pose;
  nook_instance_id id = 0;
  nook_result r = nook_model_load(context, model_bytes, model_size, &model);
  if (!r) r = nook_scene_desc_init(&desc);
  if (!r) r = nook_scene_create(context, &desc, &scene);
  if (!r) r = nook_scene_add_instance(scene, model, &id);
  if (!r) r = nook_scene_set_ground(scene, id, ground);
  if (!r) r = nook_scene_set_light(scene, id, lobes, lobe_count);
  if (!r) r = nook_pose_desc_init(&pose);
  if (!r) {
    pose.kind = NOOK_POSE_REST_TO_WORLD;
    pose.layout = NOOK_TRANSFORM_ROWS_3X4;
    pose.transforms = bones;
    pose.transform_count = bone_count;
    r = nook_scene_set_pose(scene, id, &pose);
  }
  if (!r) r = nook_scene_update(scene);
  if (!r)
    r = nook_scene_read(scene, id, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, shape->occlusion,
                        (unsigned)shape->vertex_count, 0);
  nook_scene_destroy(&scene);
  nook_model_destroy(&model);
  return r;
}

int character_make(Shape* shape, nook_context context, const char* glb_path, const char* model_path,
                   const nook_lobe* lobes, unsigned lobe_count) {
  size_t model_size = 0;
  unsigned char* const model_bytes = read_bytes(model_path, &model_size);
  nook_bake_source_desc source;
  nook_bake_character character = NULL;
  nook_bake_character_info info;
  float* bones = NULL;
  int made = 0;
  nook_result r;
  memset(&info, 0, sizeof info);
  memset(shape, 0, sizeof *shape);
  info.struct_size = sizeof info;
  if (!model_bytes) return 0;
  r = nook_bake_source_desc_init(&source);
  source.path = glb_path;
  if (r || nook_bake_character_create(&source, &character) ||
      nook_bake_character_describe(character, &info)) {
    fprintf(stderr, "%s\n", nook_bake_last_message());
  } else if ((bones = malloc((size_t)info.bone_count * 12 * sizeof *bones)) == NULL ||
             !shape_allocate(shape, (int)info.file_vertex_count, (int)(3 * info.triangle_count), 1)) {
    fputs("probe: out of memory\n", stderr);
  } else if (pose_character(shape, character, &info, bones)) {
    fprintf(stderr, "%s\n", nook_bake_last_message());
  } else if (occlude(shape, context, model_bytes, model_size, bones, info.bone_count, lobes, lobe_count)) {
    fprintf(stderr, "%s\n", nook_last_message());
  } else {
    made = 1;
  }
  if (!made) shape_free(shape);
  nook_bake_character_destroy(&character);
  free(bones);
  free(model_bytes);
  return made;
}
