/* The smallest program that uses radiance transfer. It bakes a knot over a floor, and draws it with a
 * material under an environment map. On the left it has its own shadows, on the right it does not.
 *
 *   transfer MATERIAL.nook OUT.png
 *
 * `nook bake material --meso fiber -o MATERIAL.nook` makes a material. The map is a sky with a window of
 * bright cloud, made here. An engine needs the marked regions. */
#include <math.h>
#include <nook/experimental/nook_bake_materials.h>
#include <nook/experimental/nook_transfer.h>
#include <nook/nook_gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "platform/standard_streams.h"
#include "samples/offscreen/offscreen.h"
#include "samples/offscreen/picture.h"
#include "samples/transfer/shape.h"

enum { width = 640, height = 480, lobes = 642, map_width = 256, map_height = 128, max_textures = 16 };
/* The picture is drawn twice as large and averaged. */
enum { across = 2 };

static const char version_text[] = "#version 330 core\n";
static const char vertex_text[] =
    "layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in vec4 tangent; layout(location = 3) in vec2 uv;\n"
    "uniform vec3 eye, right, up, forward; uniform vec2 scale;\n"
    "out vec3 position_ws, normal_ws; out vec4 tangent_ws; out vec2 place;\n"
    "out vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT];\n"
    "void main() {\n"
    "  nook_transfer_vectors(gl_VertexID, vectors);\n"
    "  position_ws = position; normal_ws = normal; tangent_ws = tangent; place = uv;\n"
    "  vec3 d = position - eye; float depth = dot(d, forward);\n"
    "  gl_Position = vec4(scale * vec2(dot(d, right), dot(d, up)), 1.02 * depth - 0.2, depth);\n"
    "}\n";
static const char fragment_text[] =
    "in vec3 position_ws, normal_ws; in vec4 tangent_ws; in vec2 place;\n"
    "in vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT];\n"
    "uniform vec3 eye; uniform float exposure; out vec4 pixel;\n"
    "void main() {\n"
    "  vec3 view = nook_transfer_tangent_space(normal_ws, tangent_ws, normalize(eye - position_ws));\n"
    "  vec4 modes[NOOK_LIGHT_VEC4_COUNT];\n"
    "  nook_material_decode(place, dFdx(place), dFdy(place), view, modes);\n"
    "  vec3 light = max(nook_transfer_radiance(modes, vectors), 0.0);\n"
    "  pixel = vec4(pow(min(exposure * light, 1.0), vec3(1.0 / 2.2)), 1.0);\n"
    "}\n";

typedef struct App {
  nook_context context;
  nook_gl gl;
  nook_material material;
  nook_gl_upload textures;
  nook_transfer transfer;
  nook_transfer_light light;
  nook_transfer_response response;
  nook_gl_upload uploaded;
  uint32_t vector_floats;
  float* amplitudes; /* lobes x RGB */
  float* vectors;    /* vertices x vector_floats */
  float* tangents;   /* 4 floats for each vertex, as the file has them */
  float* normals;
} App;

static int ok(nook_result result, const char* message) {
  if (result) fprintf(stderr, "%s (%s)\n", message, nook_result_name(result));
  return !result;
}

/* ---- Offline: `nook bake transfer` does the same from a .glb file ---- */
static int bake(const Shape* shape, nook_bake_job* job) {
  nook_bake_transfer_desc desc;
  nook_result r = nook_bake_transfer_desc_init(&desc);
  desc.positions = shape->position;
  desc.normals = shape->normal;
  desc.uvs = shape->uv;
  desc.indices = shape->index;
  desc.vertex_count = shape->vertex_count;
  desc.index_count = shape->index_count;
  desc.lobes = lobes;
  if (!r) r = nook_bake_start_transfer(&desc, job);
  if (!r) r = nook_bake_job_wait(*job);
  return ok(r, nook_bake_last_message());
}

/* ---- Once: the material, the baked shape, the response ---- */
static int start(App* a, const void* material, size_t material_size, const void* baked, size_t baked_size) {
  nook_context_desc context_desc;
  nook_gl_desc gl_desc;
  nook_transfer_response_desc response_desc;
  nook_transfer_response_info info;
  nook_transfer_info shape;
  nook_result r = nook_context_desc_init(&context_desc);
  memset(&info, 0, sizeof info);
  memset(&shape, 0, sizeof shape);
  info.struct_size = sizeof info;
  shape.struct_size = sizeof shape;
  if (!r) r = nook_context_create(&context_desc, &a->context);
  if (!r) r = nook_gl_desc_init(&gl_desc);
  gl_desc.get_proc = offscreen_proc;
  if (!r) r = nook_gl_create(a->context, &gl_desc, &a->gl);
  if (!r) r = nook_material_load(a->context, material, material_size, NULL, &a->material);
  if (!r) r = nook_gl_upload_material(a->gl, a->material, &a->textures);
  if (!r) r = nook_transfer_load(a->context, baked, baked_size, &a->transfer);
  if (!r) r = nook_transfer_describe(a->transfer, &shape);
  if (!r) r = nook_transfer_response_desc_init(&response_desc);
  response_desc.material = a->material;
  response_desc.lobe_count = lobes;
  if (!r) r = nook_transfer_response_create(a->context, &response_desc, &a->response);
  if (!r) r = nook_transfer_response_describe(a->response, &info);
  a->vector_floats = info.vector_floats;
  if (!r) r = nook_gl_upload_transfer(a->gl, NULL, a->response, shape.vertex_count, &a->uploaded);
  a->amplitudes = malloc(3 * lobes * sizeof *a->amplitudes);
  a->vectors = malloc((size_t)shape.vertex_count * info.vector_floats * sizeof *a->vectors);
  a->normals = malloc(3 * (size_t)shape.vertex_count * sizeof *a->normals);
  a->tangents = malloc(4 * (size_t)shape.vertex_count * sizeof *a->tangents);
  if (!a->amplitudes || !a->vectors || !a->normals || !a->tangents) r = NOOK_ERROR_OUT_OF_MEMORY;
  if (!r) r = nook_transfer_read_frames(a->transfer, a->normals, a->tangents, shape.vertex_count);
  return ok(r, nook_last_message());
}

/* ---- When the light or the shape rotates ---- */
static int relight(App* a, uint32_t vertex_count, int with_shadows) {
  const size_t floats = (size_t)vertex_count * a->vector_floats;
  nook_transfer_vectors_desc desc;
  nook_result r = nook_transfer_light_project(a->light, lobes, NULL, a->amplitudes, NULL);
  if (!r) r = nook_transfer_vectors_desc_init(&desc);
  desc.amplitudes = a->amplitudes;
  desc.lobe_count = lobes;
  if (with_shadows) {
    desc.transfer = a->transfer;
  } else {
    desc.normals = a->normals;
    desc.tangents = a->tangents;
  }
  if (!r) r = nook_transfer_read_vectors(a->response, &desc, a->vectors, vertex_count, 0);
  if (!r) r = nook_gl_update_transfer(a->uploaded, a->vectors, floats);
  return ok(r, nook_last_message());
}

/* ---- At the end, in any order ---- */
static void stop(App* a) {
  nook_gl_upload_destroy(&a->uploaded);
  nook_transfer_response_destroy(&a->response);
  nook_transfer_light_destroy(&a->light);
  nook_transfer_destroy(&a->transfer);
  nook_gl_upload_destroy(&a->textures);
  nook_material_destroy(&a->material);
  nook_gl_destroy(&a->gl);
  nook_context_destroy(&a->context);
  free(a->amplitudes);
  free(a->vectors);
  free(a->normals);
  free(a->tangents);
}

/* A sky that is brighter at its top, a brown ground, and a bright window. */
static int make_light(App* a) {
  float* const rgb = malloc(3 * (size_t)map_width * map_height * sizeof *rgb);
  nook_transfer_light_desc desc;
  nook_result r = nook_transfer_light_desc_init(&desc);
  if (!rgb) return 0;
  for (int row = 0; row < map_height; ++row)
    for (int column = 0; column < map_width; ++column) {
      const float y = cosf(3.14159265F * ((float)row + 0.5F) / map_height);
      const float turn = (float)column / map_width;
      float* const texel = rgb + 3 * (row * map_width + column);
      const int window = turn > 0.52F && turn < 0.62F && y > 0.45F && y < 0.8F;
      texel[0] = y < 0 ? 0.12F : 0.25F + 0.2F * y;
      texel[1] = y < 0 ? 0.1F : 0.32F + 0.25F * y;
      texel[2] = y < 0 ? 0.08F : 0.45F + 0.35F * y;
      for (int c = 0; window && c < 3; ++c) texel[c] = 24.0F - 3.0F * (float)c;
    }
  desc.rgb = rgb;
  desc.width = map_width;
  desc.height = map_height;
  if (!r) r = nook_transfer_light_create(a->context, &desc, &a->light);
  free(rgb);
  return ok(r, nook_last_message());
}

static void upload(const void* values, size_t bytes, GLuint slot, GLint components) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)bytes, values, GL_STATIC_DRAW);
  glEnableVertexAttribArray(slot);
  glVertexAttribPointer(slot, components, GL_FLOAT, GL_FALSE, 0, NULL);
}

static GLuint drawable(const App* a, const Shape* s) {
  const size_t v = s->vertex_count * sizeof(float);
  GLuint array = 0, indices = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  upload(s->position, 3 * v, 0, 3);
  upload(a->normals, 3 * v, 1, 3);
  upload(a->tangents, 4 * v, 2, 4);
  upload(s->uv, 2 * v, 3, 2);
  glGenBuffers(1, &indices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(s->index_count * sizeof *s->index), s->index,
               GL_STATIC_DRAW);
  return array;
}

static char* joined(const char* a, const char* b, const char* c, const char* d) {
  const size_t size = strlen(a) + strlen(b) + strlen(c) + strlen(d) + 1;
  char* const text = malloc(size);
  if (text) snprintf(text, size, "%s%s%s%s", a, b, c, d);
  return text;
}

/* Makes the program, binds its textures and sets its camera. */
static GLuint make_program(const App* a) {
  static const float eye[3] = {0.85F, 1.35F, 1.75F}, centre[3] = {0, 0.04F, 0};
  const float tall = 1 / tanf(0.5F * 0.75F);
  nook_gl_upload_info material = {0}, transfer = {0};
  char *vertex, *fragment;
  GLuint program;
  float forward[3], right[3], up[3], size = 0, flat;
  material.struct_size = transfer.struct_size = sizeof material;
  if (nook_gl_upload_describe(a->textures, &material) || nook_gl_upload_describe(a->uploaded, &transfer))
    return 0;
  vertex = joined(version_text, transfer.glsl, vertex_text, "");
  fragment = joined(version_text, material.glsl, transfer.glsl, fragment_text);
  program = vertex && fragment ? offscreen_program(vertex, fragment) : 0;
  free(vertex);
  free(fragment);
  if (!program) return 0;
  if (nook_gl_upload_bind(a->textures, program, 0) ||
      nook_gl_upload_bind(a->uploaded, program, material.texture_count))
    return 0;
  for (int i = 0; i < 3; ++i) {
    forward[i] = centre[i] - eye[i];
    size += forward[i] * forward[i];
  }
  for (int i = 0; i < 3; ++i) forward[i] /= sqrtf(size);
  flat = sqrtf(forward[0] * forward[0] + forward[2] * forward[2]);
  right[0] = -forward[2] / flat;
  right[1] = 0;
  right[2] = forward[0] / flat;
  up[0] = right[1] * forward[2] - right[2] * forward[1];
  up[1] = right[2] * forward[0] - right[0] * forward[2];
  up[2] = right[0] * forward[1] - right[1] * forward[0];
  glUniform3fv(glGetUniformLocation(program, "eye"), 1, eye);
  glUniform3fv(glGetUniformLocation(program, "forward"), 1, forward);
  glUniform3fv(glGetUniformLocation(program, "right"), 1, right);
  glUniform3fv(glGetUniformLocation(program, "up"), 1, up);
  glUniform2f(glGetUniformLocation(program, "scale"), tall * height / width, tall);
  glUniform1f(glGetUniformLocation(program, "exposure"), 1.3F);
  return program;
}

/* Draws both pictures side by side. */
static int draw(App* a, const Shape* shape) {
  const GLuint array = drawable(a, shape);
  if (!make_program(a)) return 0;
  glEnable(GL_DEPTH_TEST);
  glClearColor(0.16F, 0.18F, 0.2F, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  for (int side = 0; side < 2; ++side) {
    if (!relight(a, shape->vertex_count, side == 0)) return 0;
    glViewport(side * width * across, 0, width * across, height * across);
    glBindVertexArray(array);
    glDrawElements(GL_TRIANGLES, (GLsizei)shape->index_count, GL_UNSIGNED_INT, NULL);
  }
  return glGetError() == GL_NO_ERROR;
}

/* Writes the picture, in which each pixel is the mean of its block of samples. */
static int save(const char* path) {
  enum { w = 2 * width, h = height };
  unsigned char* const large = malloc((size_t)w * across * h * across * 3);
  unsigned char* const rgb = malloc((size_t)w * h * 3);
  int written = large && rgb;
  if (written) {
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, w * across, h * across, GL_RGB, GL_UNSIGNED_BYTE, large);
    for (int y = 0; y < h; ++y)
      for (int i = 0; i < 3 * w; ++i) {
        const size_t row = (size_t)3 * w * across;
        const unsigned char* const at =
            large + (size_t)(y * across) * row + (size_t)((i / 3) * 3 * across + i % 3);
        rgb[(size_t)y * (3 * w) + (size_t)i] =
            (unsigned char)((at[0] + at[3] + at[row] + at[row + 3] + 2) / 4);
      }
    written = picture_write(path, rgb, w, h);
    if (!written) fprintf(stderr, "transfer: %s cannot be written; check that its folder exists\n", path);
  }
  free(rgb);
  free(large);
  return written;
}

static unsigned char* read_file(const char* path, size_t* size) {
  FILE* const file = fopen(path, "rb");
  unsigned char* bytes = NULL;
  long end = -1;
  if (file && fseek(file, 0, SEEK_END) == 0) end = ftell(file);
  if (end > 0 && fseek(file, 0, SEEK_SET) == 0) bytes = malloc((size_t)end);
  if (bytes && fread(bytes, 1, (size_t)end, file) != (size_t)end) {
    free(bytes);
    bytes = NULL;
  }
  if (file) fclose(file);
  if (!bytes) fprintf(stderr, "transfer: %s cannot be read\n", path);
  *size = end > 0 ? (size_t)end : 0;
  return bytes;
}

int main(int argc, char** argv) {
  open_closed_streams();
  App app;
  Shape shape;
  nook_bake_job job = NULL;
  const void* baked = NULL;
  size_t size = 0, baked_size = 0;
  unsigned char* bytes;
  int done = 0;
  memset(&app, 0, sizeof app);
  memset(&shape, 0, sizeof shape);
  if (argc != 3) {
    fputs("usage: transfer MATERIAL.nook OUT.png\n", stderr);
    return 2;
  }
  bytes = read_file(argv[1], &size);
  if (!bytes) return 3;
  if (!offscreen_start()) {
    free(bytes);
    return 1;
  }
  if (shape_make(&shape) && bake(&shape, &job) && !nook_bake_job_file(job, &baked, &baked_size) &&
      start(&app, bytes, size, baked, baked_size) && make_light(&app)) {
    const GLuint colour =
        offscreen_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 2 * width * across, height * across);
    const GLuint depth = offscreen_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                                           2 * width * across, height * across);
    done = offscreen_framebuffer(colour, depth) && draw(&app, &shape) && save(argv[2]);
  }
  nook_bake_job_destroy(&job);
  stop(&app);
  shape_free(&shape);
  free(bytes);
  offscreen_stop();
  return done ? 0 : 1;
}
