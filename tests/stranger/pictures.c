/* The screen and world passes on OpenGL 3.3, as docs/nnao.md and docs/guide/world.md have them, without a
 * display. */
#include <math.h>
#include <nook/experimental/nook_trace.h>
#include <nook/nook_gl.h>
#include <nook/nook_nnao.h>
#include <nook/nook_world.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "samples/offscreen/offscreen.h"
#include "tests/stranger/stranger.h"

enum { width = 320, height = 240, floor_corners = 4 };

static const char vertex_text[] =
    "#version 330 core\n"
    "layout(location = 0) in vec3 position; layout(location = 1) in float ao;\n"
    "uniform mat4 view, projection; out float vertex_ao;\n"
    "void main() { vertex_ao = ao; gl_Position = projection * view * vec4(position, 1.0); }\n";
/* The mask of docs/guide/world.md: AO of characters in red and 1 elsewhere, 1 on characters in green. */
static const char fragment_text[] =
    "#version 330 core\n"
    "in float vertex_ao; uniform bool is_character; out vec4 mask;\n"
    "void main() { mask = is_character ? vec4(vertex_ao, 1.0, 0.0, 1.0) : vec4(1.0, 0.0, 0.0, 1.0); }\n";

typedef struct pictures {
  GLuint program, body_array, body_buffer, index_buffer, floor_array, floor_buffer, depth, mask, framebuffer;
  float view[16], projection[16];
  nook_gl gl;
  nook_nnao nnao;
  nook_world world;
} pictures;

static const float near_m = 0.1F, far_m = 40.0F;
static const float eye[3] = {0, 2.2F, 4.0F}; /* the camera looks down by asin(0.4) */

static void place_camera(pictures* p) {
  const float s = 0.4F, c = sqrtf(1 - s * s), scale = 1.6F;
  const float view[16] = {
      1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, -c * eye[1] + s * eye[2], -s * eye[1] - c * eye[2], 1};
  memcpy(p->view, view, sizeof view);
  p->projection[0] = scale * height / width;
  p->projection[5] = scale;
  p->projection[10] = (far_m + near_m) / (near_m - far_m);
  p->projection[11] = -1;
  p->projection[14] = 2 * far_m * near_m / (near_m - far_m);
}

static GLuint make_array(GLuint* buffer, const float* positions, size_t vertices) {
  GLuint out;
  glGenVertexArrays(1, &out);
  glBindVertexArray(out);
  glGenBuffers(1, buffer);
  glBindBuffer(GL_ARRAY_BUFFER, *buffer);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(3 * vertices * sizeof *positions), positions, GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
  glEnableVertexAttribArray(0);
  return out;
}

static int start_engine(stranger* s, pictures* p) {
  static const float floor[3 * floor_corners] = {-8, 0, -8, -8, 0, 8, 8, 0, -8, 8, 0, 8};
  const engine* const e = &s->engine;
  uint32_t* const indices = engine_memory(sizeof *indices * e->index_count);
  memset(p, 0, sizeof *p);
  p->program = offscreen_program(vertex_text, fragment_text);
  p->floor_array = make_array(&p->floor_buffer, floor, floor_corners);
  float* const none = engine_memory(3 * sizeof *none * e->vertex_count);
  p->body_array = make_array(&p->body_buffer, none, e->vertex_count);
  free(none);
  engine_indices(e, indices);
  for (uint32_t i = 0; i < e->index_count; ++i) indices[i] = stranger_file_vertex(s, indices[i]);
  glGenBuffers(1, &p->index_buffer);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, p->index_buffer);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(sizeof *indices * e->index_count), indices,
               GL_STATIC_DRAW);
  free(indices);
  p->depth = offscreen_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height);
  p->mask = offscreen_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
  p->framebuffer = offscreen_framebuffer(p->mask, p->depth);
  place_camera(p);
  return p->program && p->framebuffer;
}

/* docs/guide: once for each OpenGL context. */
static void start_passes(stranger* s, pictures* p) {
  nook_gl_desc gl_desc;
  nook_nnao_desc nnao_settings;
  nook_world_desc world_settings;
  stranger_need(nook_gl_desc_init(&gl_desc), "OpenGL");
  gl_desc.get_proc = offscreen_proc;
  stranger_need(nook_gl_create(s->context, &gl_desc, &p->gl), "OpenGL");
  stranger_need(nook_nnao_desc_init(&nnao_settings), "the screen pass");
  nnao_settings.preset = NOOK_NNAO_PRESET_DEFAULT;
  nnao_settings.max_width = width;
  nnao_settings.max_height = height;
  stranger_need(nook_nnao_create(p->gl, &nnao_settings, &p->nnao), "the screen pass");
  stranger_need(nook_world_desc_init(&world_settings), "the world pass");
  world_settings.max_width = width;
  world_settings.max_height = height;
  stranger_need(nook_world_create(p->gl, &world_settings, &p->world), "the world pass");
}

/* docs/guide/character.md, Each frame on OpenGL. The AO stays in Nook's buffer. */
static void bind_ao(stranger* s, pictures* p) {
  nook_gl_view where;
  memset(&where, 0, sizeof where);
  where.struct_size = sizeof where;
  stranger_need(nook_gl_scene_update(p->gl, s->scene), "the update");
  stranger_need(nook_gl_scene_view(p->gl, s->scene, s->hero, NOOK_CHANNEL_AO, &where), "the view");
  glBindVertexArray(p->body_array);
  glBindBuffer(GL_ARRAY_BUFFER, where.buffer);
  glVertexAttribPointer(1, 1, GL_FLOAT, GL_FALSE, (GLsizei)where.stride, (const void*)(size_t)where.offset);
  glEnableVertexAttribArray(1);
}

/* Floor and body into the depth texture and the mask. */
static void draw(const stranger* s, const pictures* p, uint32_t frame) {
  const engine* const e = &s->engine;
  const size_t size = 3 * sizeof(float) * e->vertex_count;
  float* const of_file = engine_memory(size);
  float* const own = engine_memory(size);
  engine_skinned_vertices(e, frame, of_file);
  for (uint32_t v = 0; v < e->vertex_count; ++v)
    memcpy(own + 3 * (size_t)v, of_file + 3 * (size_t)stranger_file_vertex(s, v), 3 * sizeof *own);
  glBindBuffer(GL_ARRAY_BUFFER, p->body_buffer);
  glBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)size, own);
  free(of_file);
  free(own);
  glBindFramebuffer(GL_FRAMEBUFFER, p->framebuffer);
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glClearColor(1, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glUseProgram(p->program);
  glUniformMatrix4fv(glGetUniformLocation(p->program, "view"), 1, GL_FALSE, p->view);
  glUniformMatrix4fv(glGetUniformLocation(p->program, "projection"), 1, GL_FALSE, p->projection);
  glUniform1i(glGetUniformLocation(p->program, "is_character"), 1);
  glBindVertexArray(p->body_array);
  glDrawElements(GL_TRIANGLES, (GLsizei)e->index_count, GL_UNSIGNED_INT, NULL);
  glUniform1i(glGetUniformLocation(p->program, "is_character"), 0);
  glBindVertexArray(p->floor_array);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, floor_corners);
}

/* docs/guide/world.md, Together with the screen pass. Returns the texture that the lighting reads. */
static GLuint run_passes(const stranger* s, const pictures* p) {
  nook_gl_frame_desc frame;
  nook_nnao_frame_desc nnao_frame;
  nook_world_frame_desc world_frame;
  nook_nnao_info nnao_info;
  nook_world_info world_info;
  stranger_need(nook_gl_frame_desc_init(&frame), "the frame");
  stranger_need(nook_nnao_frame_desc_init(&nnao_frame), "the frame");
  stranger_need(nook_world_frame_desc_init(&world_frame), "the frame");
  frame.width = width;
  frame.height = height;
  frame.depth_texture = p->depth;
  memcpy(frame.projection, p->projection, sizeof frame.projection);
  memcpy(frame.view, p->view, sizeof frame.view);
  frame.gbuffer_ao = NOOK_GBUFFER_AO_EXCLUDE;
  frame.gbuffer_ao_texture = p->mask;
  nnao_frame.radius = 0.5F;
  stranger_need(nook_nnao_render(p->nnao, &frame, &nnao_frame), "the screen pass");
  memset(&nnao_info, 0, sizeof nnao_info);
  nnao_info.struct_size = sizeof nnao_info;
  stranger_need(nook_nnao_describe(p->nnao, &nnao_info), "the screen pass");
  world_frame.scene = s->scene;
  world_frame.ao_texture = nnao_info.texture;
  stranger_need(nook_world_render(p->world, &frame, &world_frame), "the world pass");
  memset(&world_info, 0, sizeof world_info);
  world_info.struct_size = sizeof world_info;
  stranger_need(nook_world_describe(p->world, &world_info), "the world pass");
  return world_info.texture;
}

/* The first channels of a texture's pixels, the lowest row first. */
static void read_texture(GLuint texture, GLenum channels, unsigned char* out) {
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glBindTexture(GL_TEXTURE_2D, texture);
  glGetTexImage(GL_TEXTURE_2D, 0, channels, GL_UNSIGNED_BYTE, out);
}

/* The AO in Nook's buffer equals the CPU's. Tiers may differ where a shadow gets the next code. */
static void compare_buffer(stranger* s, const pictures* p) {
  const size_t count = s->engine.vertex_count;
  float* const on_cpu = engine_memory(count * sizeof *on_cpu);
  float* const on_gpu = engine_memory(count * sizeof *on_gpu);
  nook_gl_view where;
  double sum = 0;
  memset(&where, 0, sizeof where);
  where.struct_size = sizeof where;
  stranger_read_ao(s, on_cpu);
  stranger_need(nook_gl_scene_view(p->gl, s->scene, s->hero, NOOK_CHANNEL_AO, &where), "the view");
  glBindBuffer(GL_COPY_READ_BUFFER, where.buffer);
  for (size_t v = 0; v < count; ++v)
    glGetBufferSubData(GL_COPY_READ_BUFFER, (GLintptr)(where.offset + v * where.stride), sizeof *on_gpu,
                       on_gpu + v);
  for (size_t v = 0; v < count; ++v)
    sum += ((double)on_cpu[v] - (double)on_gpu[v]) * ((double)on_cpu[v] - (double)on_gpu[v]);
  /* nook_gl_scene_update promises 2e-3 for each value. */
  stranger_expect(s, sqrt(sum / (double)count) <= 1e-3, "AO on OpenGL differs from that on the CPU by %g rms",
                  sqrt(sum / (double)count));
  free(on_cpu);
  free(on_gpu);
}

/* The place on the floor y = 0 behind a pixel. Returns 0 where there is none near the body. */
static int floor_point(const pictures* p, int x, int y, float* out) {
  const float ndc[2] = {(2 * (float)x + 1) / width - 1, (2 * (float)y + 1) / height - 1};
  const float ray_vs[3] = {ndc[0] / p->projection[0], ndc[1] / p->projection[5], -1};
  float ray[3];
  for (int i = 0; i < 3; ++i)
    ray[i] = p->view[4 * i] * ray_vs[0] + p->view[4 * i + 1] * ray_vs[1] + p->view[4 * i + 2] * ray_vs[2];
  if (ray[1] >= -0.05F) return 0;
  const float t = -eye[1] / ray[1];
  for (int i = 0; i < 3; ++i) out[i] = eye[i] + t * ray[i];
  out[1] = 0;
  return fabsf(out[0]) < 1.2F && fabsf(out[2]) < 1.2F;
}

/* The traced AO of points on the floor under the body. */
static void trace_floor(const stranger* s, uint32_t frame, const float* points, uint32_t count, float* ao) {
  const engine* const e = &s->engine;
  float* const positions = engine_memory(3 * sizeof *positions * e->vertex_count);
  float* const normals = engine_memory(3 * sizeof *normals * count);
  uint32_t* const indices = engine_memory(sizeof *indices * e->index_count);
  nook_bake_occluder_mesh mesh;
  nook_bake_trace_desc trace;
  engine_skinned_vertices(e, frame, positions);
  engine_indices(e, indices);
  for (uint32_t i = 0; i < count; ++i) normals[3 * i + 1] = 1;
  mesh.positions = positions;
  mesh.indices = indices;
  mesh.vertex_count = e->vertex_count;
  mesh.index_count = e->index_count;
  if (nook_bake_trace_desc_init(&trace)) exit(1);
  trace.meshes = &mesh;
  trace.mesh_count = 1;
  trace.positions = points;
  trace.normals = normals;
  trace.point_count = count;
  trace.rays = 256;
  trace.threads = 1;
  if (nook_bake_trace_ao(&trace, ao, count)) {
    fprintf(stderr, "stranger: the trace: %s\n", nook_bake_last_message());
    exit(1);
  }
  free(positions);
  free(normals);
  free(indices);
}

/* On the floor the texture is nearer to ray tracing than no darkening: the casters of a quick bake leave up
 * to a third of that error. On the body the texture is the mask's red, but for rounding. */
static void compare_picture(stranger* s, const pictures* p, uint32_t frame, GLuint texture) {
  unsigned char* const mask = engine_memory(4 * width * height);
  unsigned char* const ao = engine_memory(width * height);
  float* const points = engine_memory(3 * sizeof *points * width * height);
  float* const truth = engine_memory(sizeof *truth * width * height);
  int* const pixel = engine_memory(sizeof *pixel * width * height);
  uint32_t count = 0, body = 0, wrong = 0;
  double error = 0, undarkened = 0;
  read_texture(p->mask, GL_RGBA, mask);
  read_texture(texture, GL_RED, ao);
  for (int i = 0; i < width * height; ++i) {
    if (mask[4 * i + 1] == 255) {
      ++body;
      wrong += abs((int)ao[i] - (int)mask[4 * i]) > 1;
    } else if (floor_point(p, i % width, i / width, points + 3 * (size_t)count)) {
      pixel[count++] = i;
    }
  }
  trace_floor(s, frame, points, count, truth);
  for (uint32_t i = 0; i < count; ++i) {
    const double right = (double)truth[i], got = ao[pixel[i]] / 255.0;
    error += (got - right) * (got - right);
    undarkened += (1 - right) * (1 - right);
  }
  printf("frame %u: %u pixels of the body, %u of the floor with %.3f of the error of no darkening\n",
         (unsigned)frame, (unsigned)body, (unsigned)count, error / undarkened);
  stranger_expect(s, body > 500 && wrong == 0, "%u of %u pixels of the body are not what the mask has",
                  (unsigned)wrong, (unsigned)body);
  stranger_expect(s, count > 1000 && error <= 0.25 * undarkened,
                  "the floor has %g of the error of no darkening", error / undarkened);
  free(mask);
  free(ao);
  free(points);
  free(truth);
  free(pixel);
}

void stranger_run_pictures(stranger* s) {
  const float ground[4] = {0, 1, 0, 0};
  pictures p;
  if (!offscreen_start()) exit(77);
  if (!start_engine(s, &p)) {
    stranger_expect(s, 0, "the engine's own objects of OpenGL failed");
    return;
  }
  start_passes(s, &p);
  stranger_need(nook_scene_set_ground(s->scene, s->hero, ground), "the ground");
  for (uint32_t frame = 0; frame < s->engine.frame_count; ++frame) {
    stranger_set_skinning_pose(s, s->hero, frame, NOOK_TRANSFORM_COLUMNS_4X4, NULL);
    bind_ao(s, &p);
    draw(s, &p, frame);
    compare_picture(s, &p, frame, run_passes(s, &p));
    compare_buffer(s, &p);
  }
  stranger_expect(s, glGetError() == GL_NO_ERROR, "OpenGL has an error");
  nook_world_destroy(&p.world);
  nook_nnao_destroy(&p.nnao);
  nook_gl_destroy(&p.gl);
  offscreen_stop();
}
