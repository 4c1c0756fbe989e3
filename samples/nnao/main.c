/* The smallest program that uses the screen-space pass. It draws a room before and after, without a display.
 *
 *   nnao [FOLDER] [RADIUS]
 *
 * It writes before.png, after.png, ao.png and frame.nook. The radius is in metres and 0.5 by default.
 *
 * An engine needs the first three marked regions, and the fourth for reports of wrong pictures. The rest of
 * this file, room.c and samples/offscreen stand in for the engine. */
#include <math.h>
#include <nook/experimental/nook_recording.h>
#include <nook/nook_nnao.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "platform/standard_streams.h"
#include "samples/nnao/room.h"
#include "samples/offscreen/offscreen.h"
#include "samples/offscreen/picture.h"
#include "samples/offscreen/whole_file.h"

enum { width = 960, height = 540 };

static const char vertex_text[] =
    "#version 330 core\n"
    "layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal; layout(location = 2) in "
    "vec3 albedo;\n"
    "uniform mat4 view, projection; out vec3 normal_ws, colour;\n"
    "void main() { normal_ws = normal; colour = albedo; gl_Position = projection * view * vec4(position, "
    "1.0); }\n";
/* Ambient light comes from everywhere and is multiplied by AO. AO does not touch the one lamp. */
static const char fragment_text[] =
    "#version 330 core\n"
    "in vec3 normal_ws, colour; uniform sampler2D ao; uniform bool use_ao; out vec4 pixel;\n"
    "void main() {\n"
    "  float open = use_ao ? texelFetch(ao, ivec2(gl_FragCoord.xy), 0).r : 1.0;\n"
    "  float lamp = max(dot(normalize(normal_ws), normalize(vec3(0.5, 0.8, 0.6))), 0.0);\n"
    "  pixel = vec4(pow(colour * (0.75 * open + 0.25 * lamp), vec3(1.0 / 2.2)), 1.0);\n"
    "}\n";

typedef struct Engine {
  GLuint program, vertex_array, buffer, depth, colour, depth_framebuffer, framebuffer;
  int vertex_count;
  float view[16], projection[16];
} Engine;

/* Matrices are column-major. */
static void place_camera(Engine* e) {
  const float near_m = 0.1F, far_m = 50.0F, scale = 1.0F / tanf(0.5F * 1.05F);
  room_view(e->view);
  memset(e->projection, 0, sizeof e->projection);
  e->projection[0] = scale * height / width;
  e->projection[5] = scale;
  e->projection[10] = (far_m + near_m) / (near_m - far_m);
  e->projection[11] = -1;
  e->projection[14] = 2 * far_m * near_m / (near_m - far_m);
}

static int start_engine(Engine* e) {
  room_vertex* vertices;
  const GLint offsets[3] = {offsetof(room_vertex, position), offsetof(room_vertex, normal),
                            offsetof(room_vertex, albedo)};
  if (!offscreen_start()) return 0;
  vertices = room_make(&e->vertex_count);
  e->program = offscreen_program(vertex_text, fragment_text);
  if (!vertices || !e->program) return 0;
  glGenVertexArrays(1, &e->vertex_array);
  glBindVertexArray(e->vertex_array);
  glGenBuffers(1, &e->buffer);
  glBindBuffer(GL_ARRAY_BUFFER, e->buffer);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)e->vertex_count * sizeof *vertices), vertices,
               GL_STATIC_DRAW);
  free(vertices);
  for (GLuint slot = 0; slot < 3; ++slot) {
    glEnableVertexAttribArray(slot);
    glVertexAttribPointer(slot, 3, GL_FLOAT, GL_FALSE, sizeof(room_vertex),
                          (const void*)(size_t)offsets[slot]);
  }
  e->depth = offscreen_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height);
  e->colour = offscreen_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
  e->depth_framebuffer = offscreen_framebuffer(0, e->depth);
  e->framebuffer = offscreen_framebuffer(e->colour, e->depth);
  place_camera(e);
  return e->depth_framebuffer && e->framebuffer;
}

/* Draws the room. If ao is 0, it is drawn without AO. */
static void draw_room(const Engine* e, GLuint framebuffer, GLuint ao) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glClearColor(0.55F, 0.65F, 0.8F, 1);
  glClear(GL_COLOR_BUFFER_BIT | (framebuffer == e->depth_framebuffer ? GL_DEPTH_BUFFER_BIT : 0));
  glUseProgram(e->program);
  glUniformMatrix4fv(glGetUniformLocation(e->program, "view"), 1, GL_FALSE, e->view);
  glUniformMatrix4fv(glGetUniformLocation(e->program, "projection"), 1, GL_FALSE, e->projection);
  glUniform1i(glGetUniformLocation(e->program, "use_ao"), ao != 0);
  glBindTexture(GL_TEXTURE_2D, ao);
  glBindVertexArray(e->vertex_array);
  glDrawArrays(GL_TRIANGLES, 0, e->vertex_count);
}

static int save(const char* folder, const char* name) {
  char path[1024];
  unsigned char* const rgb = malloc((size_t)width * height * 3);
  int ok = rgb && snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path;
  if (ok) {
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    ok = picture_write(path, rgb, width, height);
    if (!ok) fprintf(stderr, "nnao: %s cannot be written; check that its folder exists\n", path);
  }
  free(rgb);
  return ok;
}

typedef struct Pass {
  nook_context context;
  nook_gl gl;
  nook_nnao nnao;
} Pass;

/* ---- 1. Once for each OpenGL context ---- */
static nook_result start_pass(Pass* p) {
  nook_context_desc context_desc;
  nook_gl_desc gl_desc;
  nook_nnao_desc nnao_desc;
  nook_result r = nook_context_desc_init(&context_desc);
  if (!r) r = nook_context_create(&context_desc, &p->context);
  if (!r) r = nook_gl_desc_init(&gl_desc);
  gl_desc.get_proc = offscreen_proc;
  if (!r) r = nook_gl_create(p->context, &gl_desc, &p->gl);
  if (!r) r = nook_nnao_desc_init(&nnao_desc);
  nnao_desc.max_width = width;
  nnao_desc.max_height = height;
  if (!r) r = nook_nnao_create(p->gl, &nnao_desc, &p->nnao);
  return r;
}

/* ---- 2. Each frame, after depth has been drawn ---- */
static nook_result describe_frame(const Engine* e, float radius_m, nook_gl_frame_desc* frame,
                                  nook_nnao_frame_desc* desc) {
  nook_result r = nook_gl_frame_desc_init(frame);
  if (!r) r = nook_nnao_frame_desc_init(desc);
  if (r) return r;
  frame->width = width;
  frame->height = height;
  frame->depth_texture = e->depth;
  memcpy(frame->projection, e->projection, sizeof frame->projection);
  desc->radius = radius_m;
  return NOOK_OK;
}

/* Writes the texture that the lighting reads to *ao. */
static nook_result run_pass(Pass* p, const Engine* e, float radius_m, GLuint* ao) {
  nook_gl_frame_desc frame;
  nook_nnao_frame_desc desc;
  nook_nnao_info info = {0};
  nook_result r = describe_frame(e, radius_m, &frame, &desc);
  if (r) return r;
  r = nook_nnao_render(p->nnao, &frame, &desc);
  info.struct_size = sizeof info;
  if (!r) r = nook_nnao_describe(p->nnao, &info);
  *ao = info.texture;
  return r;
}

/* Overwrites the colours with the AO alone, by NOOK_TARGET_TEXTURE. */
static nook_result show_ao(Pass* p, const Engine* e, float radius_m) {
  nook_gl_frame_desc frame;
  nook_nnao_frame_desc desc;
  nook_result r = describe_frame(e, radius_m, &frame, &desc);
  if (r) return r;
  frame.target = NOOK_TARGET_TEXTURE;
  frame.target_name = e->colour;
  return nook_nnao_render(p->nnao, &frame, &desc);
}

/* ---- 3. At the end, in any order ---- */
static void stop_pass(Pass* p) {
  nook_nnao_destroy(&p->nnao);
  nook_gl_destroy(&p->gl);
  nook_context_destroy(&p->context);
}

/* ---- 4. When a picture is wrong: the frame in a file, for nook evaluate nnao --frame ---- */
static nook_result record_frame(Pass* p, const Engine* e, float radius_m, void** bytes, size_t* size) {
  nook_gl_frame_desc frame;
  nook_nnao_frame_desc desc;
  nook_nnao_recording recording = NULL;
  nook_result r = describe_frame(e, radius_m, &frame, &desc);
  if (!r) r = nook_nnao_record(p->nnao, &frame, &desc, "the room of samples/nnao", &recording);
  if (!r) r = nook_nnao_recording_save(recording, NULL, size);
  if (!r) *bytes = malloc(*size);
  if (!r && *bytes) r = nook_nnao_recording_save(recording, *bytes, size);
  nook_nnao_recording_destroy(&recording);
  return r;
}

static int save_frame(Pass* p, const Engine* e, float radius_m, const char* folder) {
  char path[1024];
  void* bytes = NULL;
  size_t size = 0;
  const int ok = record_frame(p, e, radius_m, &bytes, &size) == NOOK_OK && bytes &&
                 snprintf(path, sizeof path, "%s/frame.nook", folder) < (int)sizeof path &&
                 whole_file_write(path, bytes, size);
  if (!ok) fprintf(stderr, "nnao: %s/frame.nook cannot be written: %s\n", folder, nook_last_message());
  free(bytes);
  return ok;
}

int main(int argc, char** argv) {
  open_closed_streams();
  Engine engine = {0};
  Pass pass = {NULL, NULL, NULL};
  const char* const folder = argc > 1 ? argv[1] : ".";
  const float radius_m = argc > 2 ? strtof(argv[2], NULL) : 0.5F;
  GLuint ao = 0;
  int saved;
  nook_result result;
  if (argc > 3) {
    fputs("usage: nnao [FOLDER] [RADIUS]\n", stderr);
    return 2;
  }
  if (!start_engine(&engine)) return 1;
  draw_room(&engine, engine.depth_framebuffer, 0);
  result = start_pass(&pass);
  if (!result) result = run_pass(&pass, &engine, radius_m, &ao);
  if (result) {
    fprintf(stderr, "%s (%s)\n", nook_last_message(), nook_result_name(result));
    stop_pass(&pass);
    return result == NOOK_ERROR_INVALID_ARGUMENT ? 2 : 1;
  }
  draw_room(&engine, engine.framebuffer, 0);
  saved = save(folder, "before.png");
  draw_room(&engine, engine.framebuffer, ao);
  saved = saved && save(folder, "after.png");
  result = show_ao(&pass, &engine, radius_m);
  saved = saved && !result && save(folder, "ao.png");
  saved = saved && save_frame(&pass, &engine, radius_m, folder);
  stop_pass(&pass);
  offscreen_stop();
  return saved ? 0 : 1;
}
