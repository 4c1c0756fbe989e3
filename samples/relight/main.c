/* A room that is relit while its sun moves, without a display.
 *
 *   relight OUT.png [FRAMES]
 *
 * In each frame the sun moves, and two of 24 probes take a new cube map of the room. The cube map is drawn in
 * the light of all probes, so that light from the window spreads from wall to wall. FRAMES, 240 by default,
 * is the length of the day. The picture shows four times of the day. An engine needs the marked regions. */
#include <math.h>
#include <nook/experimental/nook_capture.h>
#include <nook/nook_gl.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "platform/standard_streams.h"
#include "samples/offscreen/offscreen.h"
#include "samples/offscreen/picture.h"
#include "samples/relight/lit_room.h"

enum { panel_width = 640, panel_height = 400, samples_across = 2 };
enum { face_size = 32, shadow_size = 2048, probes_a_frame = 2, panels = 4 };

static const char vertex_text[] =
    "#version 330 core\n"
    "layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in vec3 colour; layout(location = 3) in vec2 gloss;\n"
    "uniform mat4 camera; out vec3 position_ws, normal_ws, albedo; out vec2 roughness_reflectance;\n"
    "void main() {\n"
    "  position_ws = position; normal_ws = normal; albedo = colour; roughness_reflectance = gloss;\n"
    "  gl_Position = camera * vec4(position, 1.0);\n"
    "}\n";
static const char shadow_text[] = "#version 330 core\nvoid main() {}\n";
static const char fragment_begin[] = "#version 330 core\n";
/* `exposure` is 0 when a cube map is drawn. Then the shader outputs radiance, and treats glossy surfaces as
 * matt. */
static const char fragment_end[] =
    "in vec3 position_ws, normal_ws, albedo; in vec2 roughness_reflectance; out vec4 pixel;\n"
    "uniform vec3 eye_ws, sun_direction, sun_irradiance; uniform mat4 sun_camera;\n"
    "uniform sampler2DShadow sun_depth; uniform float exposure;\n"
    "float lit(vec3 n) {\n"
    "  vec3 place = 0.5 * (sun_camera * vec4(position_ws + 0.02 * n, 1.0)).xyz + 0.5;\n"
    /* The ground outside has no shadow. */
    "  if (any(greaterThan(abs(place - 0.5), vec3(0.5)))) return 1.0;\n"
    "  float sum = 0.0;\n"
    "  for (int i = 0; i < 9; ++i)\n"
    "    sum += texture(sun_depth, place + vec3(vec2(i % 3 - 1, i / 3 - 1) / 2048.0, -5e-4));\n"
    "  return sum / 9.0;\n"
    "}\n"
    "void main() {\n"
    "  vec3 n = normalize(normal_ws), v = normalize(eye_ws - position_ws);\n"
    "  vec3 irradiance = nook_grid_irradiance(position_ws, n);\n"
    "  float cosine = max(dot(n, sun_direction), 0.0);\n"
    "  if (cosine > 0.0) irradiance += sun_irradiance * (cosine * lit(n));\n"
    "  float roughness = roughness_reflectance.x, reflectance = roughness_reflectance.y;\n"
    "  bool glossy = exposure > 0.0 && reflectance > 0.0;\n"
    "  vec3 matt = glossy && reflectance > 0.5 ? vec3(0.0) : albedo;\n"
    "  vec3 light = nook_probe_ambient(matt, irradiance, vec3(1.0));\n"
    "  if (glossy) {\n"
    "    NookProbeSurface s = NookProbeSurface(normalize(n + max(0.02 - dot(n, v), 0.0) * v), v,\n"
    "        vec3(1.0, 0.0, 0.0), vec2(roughness * roughness), reflectance);\n"
    "    light += nook_probe_specular_anisotropic(nook_probe_place(position_ws), s);\n"
    "  }\n"
    "  if (exposure > 0.0) light = pow(1.0 - exp(-exposure * light), vec3(1.0 / 2.2));\n"
    "  pixel = vec4(light, 1.0);\n"
    "}\n";

typedef struct Engine {
  GLuint room, shadow, vertex_array, buffer, sun_depth, shadow_framebuffer;
  GLuint cube, cube_depth, cube_framebuffer, colour, depth, framebuffer;
  int vertex_count;
} Engine;

typedef struct Sun {
  float direction[3], irradiance[3], sky[3], camera[16];
} Sun;

/* ---- Once: a black grid of probes, its textures, and the capture that fills them ---- */
enum { across = 4, high = 2, deep = 3, probe_count = across * high * deep };
static const float first_probe[3] = {-2.1F, 0.95F, -1.6F}, spacing[3] = {1.4F, 1.2F, 1.6F};

typedef struct Light {
  nook_context context;
  nook_gl gl;
  nook_gl_upload lobes; /* for glossy surfaces */
  nook_gl_upload grid;  /* for matt ones */
  nook_gl_capture capture;
  nook_gl_upload_info lobes_info;
  nook_gl_upload_info grid_info;
} Light;

static nook_result black_grid(nook_context context, nook_probe* out) {
  static const float black[probe_count * 12 * 3];
  nook_probe_fit_desc fit_desc;
  nook_probe_desc desc;
  nook_probe_fit functions = NULL;
  nook_result r = nook_probe_fit_desc_init(&fit_desc);
  fit_desc.lobe_count = 12;
  if (!r) r = nook_probe_fit_create(context, &fit_desc, &functions);
  if (!r) r = nook_probe_desc_init(&desc);
  if (!r) {
    desc.functions = functions;
    desc.counts[0] = across;
    desc.counts[1] = high;
    desc.counts[2] = deep;
    memcpy(desc.origin_ws, first_probe, sizeof first_probe);
    memcpy(desc.spacing_ws, spacing, sizeof spacing);
    desc.coefficients = black;
    r = nook_probe_create(context, &desc, out);
  }
  nook_probe_fit_destroy(&functions);
  return r;
}

static nook_result start_light(Light* l) {
  nook_context_desc context_desc;
  nook_gl_desc gl_desc;
  nook_gl_capture_desc capture_desc;
  nook_probe probe = NULL;
  nook_result r = nook_context_desc_init(&context_desc);
  if (!r) r = nook_context_create(&context_desc, &l->context);
  if (!r) r = nook_gl_desc_init(&gl_desc);
  gl_desc.get_proc = offscreen_proc;
  if (!r) r = nook_gl_create(l->context, &gl_desc, &l->gl);
  if (!r) r = black_grid(l->context, &probe);
  if (!r) r = nook_gl_upload_probe(l->gl, probe, NOOK_GL_PROBE_LOBES, &l->lobes);
  if (!r) r = nook_gl_upload_probe(l->gl, probe, NOOK_GL_PROBE_SH, &l->grid);
  nook_probe_destroy(&probe);
  if (!r) r = nook_gl_capture_desc_init(&capture_desc);
  if (!r) {
    capture_desc.probe = l->lobes;
    capture_desc.grid = l->grid;
    capture_desc.face_size_px = face_size;
    r = nook_gl_capture_create(l->gl, &capture_desc, &l->capture);
  }
  l->lobes_info.struct_size = sizeof l->lobes_info;
  l->grid_info.struct_size = sizeof l->grid_info;
  if (!r) r = nook_gl_upload_describe(l->lobes, &l->lobes_info);
  if (!r) r = nook_gl_upload_describe(l->grid, &l->grid_info);
  return r;
}

/* ---- At the end, in any order ---- */
static void stop_light(Light* l) {
  nook_gl_capture_destroy(&l->capture);
  nook_gl_upload_destroy(&l->grid);
  nook_gl_upload_destroy(&l->lobes);
  nook_gl_destroy(&l->gl);
  nook_context_destroy(&l->context);
}

/* ---- In each draw: both textures ---- */
static void bind_light(const Light* l, GLuint program) {
  if (nook_gl_upload_bind(l->lobes, program, 0) || nook_gl_upload_bind(l->grid, program, 1))
    fprintf(stderr, "%s\n", nook_last_message());
}

/* ---- The rest stands in for the engine ---- */

static float dot3(const float a[3], const float b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Sets the rotation and translation of a view. The three axes are the rows of the matrix, which is stored by
 * columns, as in OpenGL. */
static void view_of(const float right[3], const float up[3], const float back[3], const float eye[3],
                    float m[16]) {
  const float* const rows[3] = {right, up, back};
  memset(m, 0, 16 * sizeof *m);
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 3; ++i) m[4 * i + row] = rows[row][i];
    m[12 + row] = -dot3(rows[row], eye);
  }
  m[15] = 1;
}

/* Scales a view by a perspective projection from 0.05 to 100 m. */
static void project(float m[16], float wide, float tall) {
  const float n = 0.05F, f = 100;
  for (int i = 0; i < 4; ++i) {
    const float z = m[4 * i + 2], w = m[4 * i + 3];
    m[4 * i] *= wide;
    m[4 * i + 1] *= tall;
    m[4 * i + 2] = -(f + n) / (f - n) * z - 2 * f * n / (f - n) * w;
    m[4 * i + 3] = -z;
  }
}

static void camera_towards(const float eye[3], const float target[3], float tall, float wide, float m[16]) {
  float back[3], right[3], up[3], length;
  for (int i = 0; i < 3; ++i) back[i] = eye[i] - target[i];
  length = sqrtf(dot3(back, back));
  for (int i = 0; i < 3; ++i) back[i] /= length;
  length = sqrtf(back[0] * back[0] + back[2] * back[2]);
  right[0] = back[2] / length;
  right[1] = 0;
  right[2] = -back[0] / length;
  up[0] = back[1] * right[2] - back[2] * right[1];
  up[1] = back[2] * right[0] - back[0] * right[2];
  up[2] = back[0] * right[1] - back[1] * right[0];
  view_of(right, up, back, eye, m);
  if (tall > 0) project(m, wide, tall);
}

/* Returns the sun at a time of day from 0 to 1. It is low and warm at both ends, and passes the window from
 * left to right. */
static Sun sun_at(float day) {
  Sun sun;
  const float azimuth = 1.1F * (2 * day - 1), height = 0.25F + 0.4F * sinf(3.14159265F * day);
  const float warm = 1 - sinf(3.14159265F * day), middle[3] = {0, 1, 0};
  float eye[3];
  sun.direction[0] = cosf(height) * cosf(azimuth);
  sun.direction[1] = sinf(height);
  sun.direction[2] = cosf(height) * sinf(azimuth);
  for (int i = 0; i < 3; ++i) {
    const float colour[3] = {1, 0.93F - 0.35F * warm, 0.85F - 0.6F * warm}, blue[3] = {0.55F, 0.75F, 1};
    sun.irradiance[i] = (9 - 4 * warm) * colour[i];
    sun.sky[i] = (1 - 0.55F * warm) * blue[i];
    eye[i] = middle[i] + 20 * sun.direction[i];
  }
  camera_towards(eye, middle, 0, 0, sun.camera);
  for (int i = 0; i < 4; ++i) { /* a box of 9 x 9 x 60 m */
    sun.camera[4 * i] /= 4.5F;
    sun.camera[4 * i + 1] /= 4.5F;
    sun.camera[4 * i + 2] /= -30;
  }
  sun.camera[14] -= 1;
  return sun;
}

static void draw_shadow(const Engine* e, const Sun* sun) {
  glBindFramebuffer(GL_FRAMEBUFFER, e->shadow_framebuffer);
  glViewport(0, 0, shadow_size, shadow_size);
  glClear(GL_DEPTH_BUFFER_BIT);
  glUseProgram(e->shadow);
  glUniformMatrix4fv(glGetUniformLocation(e->shadow, "camera"), 1, GL_FALSE, sun->camera);
  glDrawArrays(GL_TRIANGLES, 0, e->vertex_count);
}

/* Draws into the bound framebuffer. */
static void draw_room(const Engine* e, const Light* l, const Sun* sun, const float camera[16],
                      const float eye[3], float exposure) {
  const GLuint p = e->room;
  float sky[3];
  for (int i = 0; i < 3; ++i)
    sky[i] = exposure > 0 ? powf(1 - expf(-exposure * sun->sky[i]), 1 / 2.2F) : sun->sky[i];
  glClearColor(sky[0], sky[1], sky[2], 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glUseProgram(p);
  glUniformMatrix4fv(glGetUniformLocation(p, "camera"), 1, GL_FALSE, camera);
  glUniformMatrix4fv(glGetUniformLocation(p, "sun_camera"), 1, GL_FALSE, sun->camera);
  glUniform3fv(glGetUniformLocation(p, "eye_ws"), 1, eye);
  glUniform3fv(glGetUniformLocation(p, "sun_direction"), 1, sun->direction);
  glUniform3fv(glGetUniformLocation(p, "sun_irradiance"), 1, sun->irradiance);
  glUniform1f(glGetUniformLocation(p, "exposure"), exposure);
  bind_light(l, p);
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, e->sun_depth);
  glUniform1i(glGetUniformLocation(p, "sun_depth"), 2);
  glDrawArrays(GL_TRIANGLES, 0, e->vertex_count);
}

/* ---- In each frame, for a few probes: six faces, and the call ---- */
static nook_result relight_probe(const Engine* e, const Light* l, const Sun* sun, unsigned index) {
  /* The axes of OpenGL's faces point right, up and backwards in the picture. */
  static const float axes[6][3][3] = {
      {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}},
      {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
      {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}};
  const unsigned place[3] = {index % across, index / across % high, index / (across * high)};
  float eye[3], camera[16];
  for (int i = 0; i < 3; ++i) eye[i] = first_probe[i] + spacing[i] * (float)place[i];
  glBindFramebuffer(GL_FRAMEBUFFER, e->cube_framebuffer);
  glViewport(0, 0, face_size, face_size);
  for (unsigned face = 0; face < 6; ++face) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_CUBE_MAP_POSITIVE_X + face,
                           e->cube, 0);
    view_of(axes[face][0], axes[face][1], axes[face][2], eye, camera);
    project(camera, 1, 1);
    draw_room(e, l, sun, camera, eye, 0);
  }
  return nook_gl_capture_add(l->capture, index, e->cube, 0);
}

static GLuint program_of(const Light* l) {
  const size_t size =
      strlen(l->lobes_info.glsl) + strlen(l->grid_info.glsl) + sizeof fragment_begin + sizeof fragment_end;
  char* const text = malloc(size);
  GLuint program = 0;
  if (!text) return 0;
  snprintf(text, size, "%s%s%s%s", fragment_begin, l->lobes_info.glsl, l->grid_info.glsl, fragment_end);
  program = offscreen_program(vertex_text, text);
  free(text);
  return program;
}

static int make_room(Engine* e) {
  room_vertex* const vertices = room_make(&e->vertex_count);
  static const struct {
    int size;
    size_t offset;
  } fields[4] = {{3, offsetof(room_vertex, position)},
                 {3, offsetof(room_vertex, normal)},
                 {3, offsetof(room_vertex, albedo)},
                 {2, offsetof(room_vertex, roughness)}};
  if (!vertices) return 0;
  glGenVertexArrays(1, &e->vertex_array);
  glBindVertexArray(e->vertex_array);
  glGenBuffers(1, &e->buffer);
  glBindBuffer(GL_ARRAY_BUFFER, e->buffer);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)e->vertex_count * sizeof *vertices), vertices,
               GL_STATIC_DRAW);
  for (GLuint i = 0; i < 4; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, fields[i].size, GL_FLOAT, GL_FALSE, sizeof *vertices,
                          (const void*)fields[i].offset);
  }
  free(vertices);
  return 1;
}

static int make_targets(Engine* e) {
  const int width = panel_width * samples_across, height = panel_height * samples_across;
  e->sun_depth =
      offscreen_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, shadow_size, shadow_size);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  e->shadow_framebuffer = offscreen_framebuffer(0, e->sun_depth);
  e->colour = offscreen_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
  e->depth = offscreen_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height);
  e->framebuffer = offscreen_framebuffer(e->colour, e->depth);
  glGenTextures(1, &e->cube);
  glBindTexture(GL_TEXTURE_CUBE_MAP, e->cube);
  for (unsigned face = 0; face < 6; ++face)
    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA16F, face_size, face_size, 0, GL_RGBA,
                 GL_FLOAT, NULL);
  e->cube_depth =
      offscreen_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, face_size, face_size);
  e->cube_framebuffer = offscreen_framebuffer(0, e->cube_depth);
  return e->framebuffer && glGetError() == GL_NO_ERROR;
}

/* Draws the view into panel `panel` of the picture. Each pixel of the picture is the mean of a block of
 * samples. */
static void draw_panel(const Engine* e, const Light* l, const Sun* sun, int panel, unsigned char* picture) {
  const float eye[3] = {-2.7F, 1.6F, 2.25F}, target[3] = {1.2F, 1.05F, -0.95F};
  const int s = samples_across, row = 3 * panel_width * s;
  unsigned char* const large = malloc((size_t)row * (size_t)(panel_height * s));
  float camera[16];
  if (!large) return;
  camera_towards(eye, target, 1.35F, 1.35F * panel_height / panel_width, camera);
  glBindFramebuffer(GL_FRAMEBUFFER, e->framebuffer);
  glViewport(0, 0, panel_width * s, panel_height * s);
  draw_room(e, l, sun, camera, eye, 2.2F);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, panel_width * s, panel_height * s, GL_RGB, GL_UNSIGNED_BYTE, large);
  for (int y = 0; y < panel_height; ++y)
    for (int i = 0; i < 3 * panel_width; ++i) {
      const unsigned char* const at = large + y * s * row + i / 3 * 3 * s + i % 3;
      /* The first panel is above, and rows go upwards. */
      const int line = y + (panel < 2 ? panel_height : 0), column = i + panel % 2 * 3 * panel_width;
      picture[line * 6 * panel_width + column] =
          (unsigned char)((at[0] + at[3] + at[row] + at[row + 3] + 2) / 4);
    }
  free(large);
}

/* Runs a day of `frames` frames. Before it, the probes are filled three times under the morning sun, so that
 * they hold light after three reflections. */
static nook_result pass_day(const Engine* e, const Light* l, int frames, unsigned char* picture) {
  const int before = 3 * probe_count / probes_a_frame;
  unsigned next = 0;
  int panel = 0;
  for (int frame = -before; frame < frames; ++frame) {
    const float day = frame < 0 ? 0 : (float)frame / (float)(frames - 1);
    const Sun sun = sun_at(day);
    nook_result r = NOOK_OK;
    draw_shadow(e, &sun);
    for (int i = 0; i < probes_a_frame && !r; ++i, next = (next + 1) % probe_count)
      r = relight_probe(e, l, &sun, next);
    if (r) return r;
    if (frame >= 0 && frame >= panel * (frames - 1) / (panels - 1)) draw_panel(e, l, &sun, panel++, picture);
  }
  return NOOK_OK;
}

int main(int argc, char** argv) {
  open_closed_streams();
  const int frames = argc > 2 ? atoi(argv[2]) : 240;
  unsigned char* const picture = calloc((size_t)panel_width * panel_height * panels, 3);
  Light light;
  Engine engine;
  nook_result result;
  int saved = 0;
  memset(&light, 0, sizeof light);
  memset(&engine, 0, sizeof engine);
  if (argc < 2 || argc > 3 || frames < panels || frames > 100000 || !picture) {
    fputs("usage: relight OUT.png [FRAMES], 4 to 100000\n", stderr);
    free(picture);
    return 2;
  }
  if (!offscreen_start()) return 1;
  glEnable(GL_DEPTH_TEST);
  result = start_light(&light);
  if (!result && make_room(&engine) && make_targets(&engine)) {
    engine.room = program_of(&light);
    engine.shadow = offscreen_program(vertex_text, shadow_text);
    if (engine.room && engine.shadow) {
      result = pass_day(&engine, &light, frames, picture);
      saved = !result && picture_write(argv[1], picture, 2 * panel_width, 2 * panel_height);
      if (!result && !saved)
        fprintf(stderr,
                "relight: %s cannot be written; check that its folder exists and that it is not a folder "
                "itself\n",
                argv[1]);
    }
  }
  if (result) fprintf(stderr, "%s (%s)\n", nook_last_message(), nook_result_name(result));
  stop_light(&light);
  offscreen_stop();
  free(picture);
  return saved ? 0 : 1;
}
