/* A crowd that plays baked clips, beside two heroes whose poses are live, without a display.
 *
 *   clips CHARACTER.glb MODEL.nook CLIPS.nook OUT.png
 *
 * `nook bake character` makes MODEL.nook and `nook bake clips` makes CLIPS.nook. On the left, the picture has
 * no AO. On the right, the vertex shader decodes the crowd's own AO from the clips, and multiplies it by the
 * AO of the neighbours and the ground. An engine needs the marked regions. */
#include <math.h>
#include <nook/nook_clips.h>
#include <nook/nook_gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "platform/standard_streams.h"
#include "samples/clips/body.h"
#include "samples/offscreen/offscreen.h"
#include "samples/offscreen/picture.h"

enum { panel_width = 640, panel_height = 400, panels = 2 };
/* The picture is drawn twice as large and averaged. */
enum { samples_across = 2 };
enum { heroes = 2, rows = 4, columns = 5, members = heroes + rows * columns, ground_member = members };

static const char version_text[] = "#version 330 core\n";
/* The GLSL of the clips is inserted before this text. */
static const char vertex_text[] =
    "layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in uvec4 joints; layout(location = 3) in vec4 weights;\n"
    "layout(location = 4) in float scene_ao;\n"
    "uniform samplerBuffer bones; uniform int first_bone; uniform bool has_clip, with_ao;\n"
    "uniform ivec2 frames; uniform float share;\n"
    "const vec3 eye = vec3(0.0, 2.3, 6.2), up = vec3(0.0, 0.974, -0.2266);\n"
    "const vec3 forward = vec3(0.0, -0.2266, -0.974); const vec2 scale = vec2(2.375, 3.8);\n"
    "out vec3 from_eye, normal_ws; out float ao;\n"
    "void main() {\n"
    "  vec4 rows[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)), p = vec4(position, 1.0);\n"
    "  for (int j = 0; j < 4; ++j)\n"
    "    for (int i = 0; i < 3; ++i)\n"
    "      rows[i] += weights[j] * texelFetch(bones, 3 * (first_bone + int(joints[j])) + i);\n"
    "  vec3 d = vec3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)) - eye;\n"
    "  normal_ws = vec3(dot(rows[0].xyz, normal), dot(rows[1].xyz, normal), dot(rows[2].xyz, normal));\n"
    /* For a live pose, the scene's buffer holds the complete AO. For a clip, it holds only the AO that other
     * bodies and the ground cause. */
    "  ao = scene_ao;\n"
    "  if (has_clip) ao *= nook_clip_ao(gl_VertexID, frames, share);\n"
    "  if (!with_ao) ao = 1.0;\n"
    "  float depth = dot(d, forward); from_eye = d;\n"
    "  gl_Position = vec4(scale * vec2(d.x, dot(d, up)), 1.002 * depth - 0.2, depth);\n"
    "}\n";
static const char fragment_text[] =
    "#version 330 core\n"
    "in vec3 from_eye, normal_ws; in float ao; out vec4 pixel;\n"
    "uniform vec3 albedo;\n"
    "void main() {\n"
    "  vec3 sky = vec3(0.62, 0.72, 0.82);\n"
    "  vec3 light = mix(vec3(0.4, 0.37, 0.34), vec3(1.0, 1.0, 1.05), 0.5 + 0.5 * normalize(normal_ws).y);\n"
    "  float haze = 1.0 - exp(-0.003 * pow(max(length(from_eye) - 9.0, 0.0), 2.0));\n"
    "  pixel = vec4(pow(mix(albedo * light * ao, sky, haze), vec3(1.0 / 2.2)), 1.0);\n"
    "}\n";
/* For the comparison with the CPU: draws each vertex as a point on its own texel. */
static const char point_text[] =
    "uniform ivec2 frames, size; uniform float share; flat out float ao;\n"
    "void main() {\n"
    "  ao = nook_clip_ao(gl_VertexID, frames, share);\n"
    "  vec2 texel = vec2(gl_VertexID % size.x, gl_VertexID / size.x) + 0.5;\n"
    "  gl_Position = vec4(2.0 * texel / vec2(size) - 1.0, 0.0, 1.0);\n"
    "}\n";
static const char point_fragment_text[] =
    "#version 330 core\nflat in float ao; out vec4 value;\nvoid main() { value = vec4(ao); }\n";

typedef struct Member {
  nook_instance_id id;
  float place[12]; /* 3x4, row-major: where the member stands */
  float albedo[3];
  int live;
  nook_clip_time time;
} Member;

typedef struct App {
  Body body;
  nook_context context;
  nook_gl gl;
  nook_model model;
  nook_clips clips;
  nook_gl_upload uploaded;
  nook_gl_upload_info shader;
  nook_scene scene;
  nook_clips_info info;
  Member member[members];
  float* bones; /* the drawing matrices of all members, and one of the ground */
} App;

/* ---- Once: the model, the clips and their textures ---- */
static nook_result start(App* a, const void* model, size_t model_size, const void* clips, size_t clips_size) {
  nook_context_desc context_desc;
  nook_gl_desc gl_desc;
  nook_result r = nook_context_desc_init(&context_desc);
  if (!r) r = nook_context_create(&context_desc, &a->context);
  if (!r) r = nook_gl_desc_init(&gl_desc);
  gl_desc.get_proc = offscreen_proc;
  if (!r) r = nook_gl_create(a->context, &gl_desc, &a->gl);
  if (!r) r = nook_model_load(a->context, model, model_size, &a->model);
  if (!r) r = nook_clips_load(a->context, a->model, clips, clips_size, &a->clips);
  a->info.struct_size = sizeof a->info;
  if (!r) r = nook_clips_describe(a->clips, &a->info);
  if (!r) r = nook_gl_upload_clips(a->gl, a->clips, &a->uploaded);
  a->shader.struct_size = sizeof a->shader;
  if (!r) r = nook_gl_upload_describe(a->uploaded, &a->shader);
  return r;
}

/* Places a member at x and z, rotated by `yaw` and scaled to human height. */
static void stand(const App* a, Member* m, float x, float z, float yaw) {
  const float low = a->body.info.bounds_min[1], s = 1.75F / (a->body.info.bounds_max[1] - low);
  const float place[12] = {s * cosf(yaw),  0, s * sinf(yaw), x, 0, s, 0, -s * low,
                           -s * sinf(yaw), 0, s * cosf(yaw), z};
  memcpy(m->place, place, sizeof place);
}

static void choose(const App* a, Member* m, int i) {
  static const float hero[3] = {0.75F, 0.3F, 0.08F},
                     crowd[2][3] = {{0.38F, 0.45F, 0.55F}, {0.36F, 0.5F, 0.42F}};
  const int n = i - heroes, row = n / columns, column = n % columns;
  m->live = i < heroes;
  memcpy(m->albedo, m->live ? hero : crowd[(row + column) % 2], sizeof m->albedo);
  if (m->live) {
    stand(a, m, 1.4F * (float)i - 0.7F, 1, 0.5F - (float)i);
    return;
  }
  stand(a, m, 0.9F * ((float)column - 0.5F * (columns - 1)) + 0.3F * (float)(row % 2), -0.9F * (float)row,
        0.7F * sinf(2.1F * (float)n));
  m->time.clip = (uint32_t)n % a->info.clip_count;
  m->time.wrap = NOOK_CLIP_LOOP;
  m->time.seconds = 0.37 * n;
}

/* ---- Once: heroes and crowd share a scene, so that they darken each other ---- */
static nook_result fill_scene(App* a) {
  const float ground[4] = {0, 1, 0, 0};
  nook_scene_desc desc;
  nook_result r = nook_scene_desc_init(&desc);
  if (!r) r = nook_scene_create(a->context, &desc, &a->scene);
  for (int i = 0; i < members && !r; ++i) {
    Member* const m = &a->member[i];
    choose(a, m, i);
    r = nook_scene_add_instance(a->scene, a->model, &m->id);
    if (!r) r = nook_scene_set_ground(a->scene, m->id, ground);
  }
  if (!r) r = nook_scene_link_nearest(a->scene, 6, 3);
  return r;
}

/* ---- In each frame, for a hero: the matrices of your animation ---- */
static nook_result pose_hero(App* a, const Member* m, int number, float* bones) {
  const unsigned count = a->info.bone_count;
  const unsigned clip = a->body.info.clip_count - 1 - (unsigned)number % a->body.info.clip_count;
  float* const sampled = malloc(count * 12 * sizeof *sampled);
  float seconds = 0;
  nook_pose_desc pose;
  nook_result r = sampled ? nook_pose_desc_init(&pose) : NOOK_ERROR_OUT_OF_MEMORY;
  if (!r) r = nook_bake_character_clip_duration(a->body.character, clip, &seconds);
  if (!r) r = nook_bake_character_sample_clip(a->body.character, clip, 0.3F * seconds, sampled, count);
  if (!r) {
    pose.kind = NOOK_POSE_REST_TO_WORLD;
    pose.layout = NOOK_TRANSFORM_ROWS_3X4;
    pose.transforms = sampled;
    pose.transform_count = count;
    pose.place_3x4 = m->place;
    r = nook_scene_set_pose(a->scene, m->id, &pose);
    if (!r) r = nook_model_convert_pose(a->model, &pose, bones, count);
  }
  free(sampled);
  return r;
}

/* ---- In each frame, for a member of the crowd: the clip, the time and the place ---- */
static nook_result pose_crowd(App* a, const Member* m, float* bones) {
  nook_result r = nook_scene_set_clip(a->scene, m->id, a->clips, &m->time, m->place);
  /* Leave this out if your engine already keeps its animation in textures. */
  if (!r) r = nook_clips_read_pose(a->clips, &m->time, m->place, bones, a->info.bone_count);
  return r;
}

static nook_result pose_all(App* a) {
  static const float identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const size_t floats = 12 * (size_t)a->info.bone_count;
  GLuint buffer = 0, texture = 0;
  nook_result r;
  a->bones = malloc((members * floats + 12) * sizeof(float));
  r = a->bones ? NOOK_OK : NOOK_ERROR_OUT_OF_MEMORY;
  for (int i = 0; i < members && !r; ++i) {
    float* const bones = a->bones + (size_t)i * floats;
    r = a->member[i].live ? pose_hero(a, &a->member[i], i, bones) : pose_crowd(a, &a->member[i], bones);
  }
  if (r) return r;
  memcpy(a->bones + ground_member * floats, identity, sizeof identity);
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_TEXTURE_BUFFER, buffer);
  glBufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)((members * floats + 12) * sizeof(float)), a->bones,
               GL_STREAM_DRAW);
  glGenTextures(1, &texture);
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_BUFFER, texture);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer);
  return nook_gl_scene_update(a->gl, a->scene);
}

/* Sets the uniforms for the two frames of a clip around the time. */
static nook_result set_time(const App* a, GLuint program, const nook_clip_time* time) {
  uint32_t frames[2] = {0, 0};
  float share = 0;
  const nook_result r = nook_clips_frames(a->clips, time, frames, &share);
  glUniform2i(glGetUniformLocation(program, "frames"), (GLint)frames[0], (GLint)frames[1]);
  glUniform1f(glGetUniformLocation(program, "share"), share);
  return r;
}

/* ---- For each draw: the buffer of the scene as an attribute, and the time of the clip ---- */
static nook_result draw_member(const App* a, GLuint program, const Member* m) {
  nook_gl_view view;
  nook_result r;
  view.struct_size = sizeof view;
  r = nook_gl_scene_view(a->gl, a->scene, m->id, NOOK_CHANNEL_AO, &view);
  if (!r && !m->live) r = set_time(a, program, &m->time);
  if (r) return r;
  glUniform1i(glGetUniformLocation(program, "has_clip"), !m->live);
  glUniform1i(glGetUniformLocation(program, "first_bone"), (int)(m - a->member) * (int)a->info.bone_count);
  glUniform3fv(glGetUniformLocation(program, "albedo"), 1, m->albedo);
  glBindVertexArray(a->body.vertex_array);
  glBindBuffer(GL_ARRAY_BUFFER, view.buffer);
  glEnableVertexAttribArray(4);
  glVertexAttribPointer(4, 1, GL_FLOAT, GL_FALSE, (GLsizei)view.stride, (const void*)(uintptr_t)view.offset);
  glDrawElements(GL_TRIANGLES, (GLsizei)(3 * a->body.info.triangle_count), GL_UNSIGNED_INT, NULL);
  return NOOK_OK;
}

static void draw_ground(const App* a, GLuint program) {
  static const float corners[12] = {-90, 0, 20, 90, 0, 20, -90, 0, -90, 90, 0, -90};
  GLuint array = 0, buffer = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
  glVertexAttrib3f(1, 0, 1, 0);
  glVertexAttribI4ui(2, 0, 0, 0, 0);
  glVertexAttrib4f(3, 1, 0, 0, 0);
  glVertexAttrib1f(4, 1);
  glUniform1i(glGetUniformLocation(program, "has_clip"), 0);
  glUniform1i(glGetUniformLocation(program, "first_bone"), ground_member * (int)a->info.bone_count);
  glUniform3f(glGetUniformLocation(program, "albedo"), 0.42F, 0.4F, 0.37F);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

static nook_result draw_panel(const App* a, GLuint program, int panel) {
  const int width = panel_width * samples_across;
  nook_result r = nook_gl_upload_bind(a->uploaded, program, 0); /* units 0 and 1 */
  glViewport(panel * width, 0, width, panel_height * samples_across);
  glUniform1i(glGetUniformLocation(program, "bones"), 2);
  glUniform1i(glGetUniformLocation(program, "with_ao"), panel);
  draw_ground(a, program);
  for (int i = 0; i < members && !r; ++i) r = draw_member(a, program, &a->member[i]);
  return r;
}

/* Returns a program with a vertex shader that decodes the AO of the clips. */
static GLuint program_of(const App* a, const char* vertex, const char* fragment) {
  const size_t size = sizeof version_text + strlen(a->shader.glsl) + strlen(vertex);
  char* const text = malloc(size);
  GLuint program = 0;
  if (!text) return 0;
  snprintf(text, size, "%s%s%s", version_text, a->shader.glsl, vertex);
  program = offscreen_program(text, fragment);
  free(text);
  return program;
}

/* ---- Not for an engine: prints the largest difference between the AO of a member's clip on the CPU and in a
 * vertex shader ---- */
static nook_result compare(const App* a, const Member* m) {
  const int count = (int)a->info.file_vertex_count, width = 1024, height = (count + width - 1) / width;
  float* const cpu = calloc((size_t)(2 * width * height), sizeof *cpu);
  float worst = 0;
  const GLuint target = offscreen_texture(GL_R32F, GL_RED, GL_FLOAT, width, height);
  const GLuint program = program_of(a, point_text, point_fragment_text);
  nook_clip_info clip;
  nook_result r = cpu && program && offscreen_framebuffer(target, 0) ? NOOK_OK : NOOK_ERROR_OUT_OF_MEMORY;
  clip.struct_size = sizeof clip;
  if (!r) r = nook_clips_describe_clip(a->clips, m->time.clip, &clip);
  if (!r) r = nook_gl_upload_bind(a->uploaded, program, 0);
  if (!r) r = set_time(a, program, &m->time);
  if (!r) r = nook_clips_read_ao(a->clips, &m->time, NOOK_FORMAT_FLOAT, cpu, (uint32_t)count, 0);
  if (!r) {
    glUniform2i(glGetUniformLocation(program, "size"), width, height);
    glBindVertexArray(a->body.vertex_array);
    glViewport(0, 0, width, height);
    glDrawArrays(GL_POINTS, 0, count);
    float* const gpu = cpu + width * height;
    glReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, gpu);
    for (int i = 0; i < count; ++i) worst = fmaxf(worst, fabsf(cpu[i] - gpu[i]));
    printf("%s at %.2f s: the AO of CPU and GPU differs by at most %.5f\n", clip.name,
           fmod(m->time.seconds, clip.duration_s > 0 ? clip.duration_s : 1), worst);
  }
  free(cpu);
  return r;
}

/* Writes the picture, in which each pixel is the mean of its block of samples. */
static int save(GLuint large, const char* path) {
  const int width = panels * panel_width, height = panel_height;
  unsigned char* const rgb = malloc((size_t)(3 * width * height));
  const GLuint small =
      offscreen_framebuffer(offscreen_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height), 0);
  int ok = rgb && small;
  if (ok) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, large);
    glBlitFramebuffer(0, 0, width * samples_across, height * samples_across, 0, 0, width, height,
                      GL_COLOR_BUFFER_BIT, GL_LINEAR);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, small);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    ok = picture_write(path, rgb, width, height);
    if (!ok) fprintf(stderr, "clips: %s cannot be written; check that its folder exists\n", path);
  }
  free(rgb);
  return ok;
}

static nook_result draw(App* a, GLuint* framebuffer) {
  const int width = panels * panel_width * samples_across, height = panel_height * samples_across;
  const GLuint colour = offscreen_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
  const GLuint depth =
      offscreen_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height);
  const GLuint program = program_of(a, vertex_text, fragment_text);
  nook_result r = NOOK_OK;
  *framebuffer = offscreen_framebuffer(colour, depth);
  if (!program || !*framebuffer) return NOOK_ERROR_GL;
  glEnable(GL_DEPTH_TEST);
  glClearColor(0.805F, 0.861F, 0.914F, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  for (int panel = 0; panel < panels && !r; ++panel) r = draw_panel(a, program, panel);
  return r;
}

/* ---- At the end, in any order ---- */
static void stop(App* a) {
  nook_gl_upload_destroy(&a->uploaded);
  nook_scene_destroy(&a->scene);
  nook_clips_destroy(&a->clips);
  nook_model_destroy(&a->model);
  nook_gl_destroy(&a->gl);
  nook_context_destroy(&a->context);
  body_free(&a->body);
  free(a->bones);
}

/* Checks that model and clips belong to the character of the mesh. */
static int same_character(const App* a) {
  const nook_bake_character_info* const body = &a->body.info;
  const int same = body->file_vertex_count == a->info.file_vertex_count &&
                   body->bone_count == a->info.bone_count && body->clip_count > 0;
  if (!same)
    fputs("clips: the clips were baked from another .glb file; pass the file that you baked\n", stderr);
  return same;
}

static nook_result make_picture(App* a, GLuint* framebuffer) {
  nook_result r = fill_scene(a);
  printf("%d members play %u clips of %u frames and %u modes: %llu bytes\n", rows * columns,
         a->info.clip_count, a->info.frame_count, a->info.mode_count,
         (unsigned long long)a->info.memory_bytes);
  if (!r) r = pose_all(a);
  if (!r) r = compare(a, &a->member[heroes]);
  if (!r) r = draw(a, framebuffer);
  return r;
}

/* Returns the exit code: 2 for bad arguments, 3 for bad files, 1 for other faults. */
static int run(App* a, char** argv) {
  size_t model_size = 0, clips_size = 0;
  unsigned char* const model = read_bytes(argv[2], &model_size);
  unsigned char* const clips = model ? read_bytes(argv[3], &clips_size) : NULL;
  GLuint framebuffer = 0;
  int code = 3;
  if (clips && body_load(&a->body, argv[1])) {
    nook_result r = start(a, model, model_size, clips, clips_size);
    if (r != NOOK_ERROR_BAD_FILE && r != NOOK_ERROR_FILE_VERSION && (r || same_character(a))) {
      if (!r) r = make_picture(a, &framebuffer);
      code = !r && save(framebuffer, argv[4]) ? 0 : 1;
    }
    if (r) fprintf(stderr, "%s (%s)\n", nook_last_message(), nook_result_name(r));
  }
  free(clips);
  free(model);
  return code;
}

int main(int argc, char** argv) {
  open_closed_streams();
  App app;
  int code;
  memset(&app, 0, sizeof app);
  if (argc != 5) {
    fputs("usage: clips CHARACTER.glb MODEL.nook CLIPS.nook OUT.png\n", stderr);
    return 2;
  }
  if (!offscreen_start()) return 1;
  code = run(&app, argv);
  stop(&app);
  offscreen_stop();
  return code_after_output(code);
}
