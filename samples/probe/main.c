/* The smallest program that uses a probe. It draws spheres from glossy to rough, and a character, in the
 * light of a probe.
 *
 *   probe PROBE.nook OUT.png [CHARACTER.glb MODEL.nook]
 *
 * `nook bake probe MAP.hdr -o PROBE.nook` makes PROBE.nook from any map; the probe must have lobes, which is
 * the default. The upper spheres are metal, and the lower spheres are plastic. Their roughness
 * grows from left to right. The character has the directional occlusion that its model gives under the same
 * lobes. An engine needs the marked regions, here and in shapes.c. */
#include <math.h>
#include <nook/experimental/nook_sg.h>
#include <nook/nook_gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "platform/standard_streams.h"
#include "samples/offscreen/offscreen.h"
#include "samples/offscreen/picture.h"
#include "samples/probe/shapes.h"

/* The picture is drawn twice as large and averaged. */
enum { width = 1280, height = 540, samples_across = 2 };

static const char vertex_text[] =
    "#version 330 core\n"
    "layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal; layout(location = 2) in "
    "vec3 occlusion;\n"
    "uniform vec4 place; uniform vec2 scale; uniform vec3 eye_ws;\n"
    "out vec3 position_ws, normal_ws, open;\n"
    "void main() {\n"
    "  position_ws = place.xyz + place.w * position; normal_ws = normal; open = occlusion;\n"
    "  vec3 d = position_ws - eye_ws;\n"
    "  gl_Position = vec4(scale * d.xy, 2e-3 * -d.z - 0.1, -d.z);\n"
    "}\n";
static const char fragment_begin[] = "#version 330 core\n";
static const char fragment_end[] =
    "in vec3 position_ws, normal_ws, open; out vec4 pixel;\n"
    "uniform vec3 eye_ws, albedo; uniform float roughness, reflectance, exposure; uniform bool sky;\n"
    "void main() {\n"
    "  NookProbePlace probe = nook_probe_place(position_ws);\n"
    "  vec3 v = normalize(eye_ws - position_ws), n = normalize(normal_ws), light;\n"
    /* At silhouettes, interpolated normals may face away from the eye, and the surface would reflect
     * nothing. */
    "  n = normalize(n + max(0.02 - dot(n, v), 0.0) * v);\n"
    "  if (sky) light = max(nook_probe_radiance(probe, -v), 0.0);\n"
    "  else {\n"
    "    float alpha = roughness * roughness, ao = dot(open, vec3(1.0 / 3.0));\n"
    "    NookProbeSurface surface = NookProbeSurface(n, v, vec3(1.0, 0.0, 0.0), vec2(alpha), reflectance);\n"
    "    light = nook_probe_ambient(albedo, nook_probe_irradiance(probe, n), open);\n"
    "    light += nook_probe_specular_anisotropic(probe, surface) *\n"
    "             nook_probe_specular_occlusion(ao, max(dot(n, v), 0.0), roughness);\n"
    "  }\n"
    "  pixel = vec4(pow(1.0 - exp(-exposure * light), vec3(1.0 / 2.2)), 1.0);\n"
    "}\n";

typedef struct Light {
  nook_context context;
  nook_gl gl;
  nook_probe probe;
  nook_gl_upload uploaded;
  nook_gl_upload_info info;
  nook_lobe lobes[NOOK_PROBE_MAX_FUNCTIONS];
  unsigned lobe_count;
} Light;

/* ---- Once: the probe, its lobes, its texture ---- */
static nook_result start_light(Light* l, const void* bytes, size_t size) {
  nook_context_desc context_desc;
  nook_gl_desc gl_desc;
  nook_probe_info info;
  nook_result r = nook_context_desc_init(&context_desc);
  if (!r) r = nook_context_create(&context_desc, &l->context);
  if (!r) r = nook_gl_desc_init(&gl_desc);
  gl_desc.get_proc = offscreen_proc;
  if (!r) r = nook_gl_create(l->context, &gl_desc, &l->gl);
  if (!r) r = nook_probe_load(l->context, bytes, size, &l->probe);
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  if (!r) r = nook_probe_describe(l->probe, &info);
  if (!r) r = nook_probe_read_lobes(l->probe, NULL, l->lobes, info.function_count);
  l->lobe_count = info.function_count;
  if (!r) r = nook_gl_upload_probe(l->gl, l->probe, NOOK_GL_PROBE_LOBES, &l->uploaded);
  l->info.struct_size = sizeof l->info;
  if (!r) r = nook_gl_upload_describe(l->uploaded, &l->info);
  return r;
}

/* ---- At the end, in any order ---- */
static void stop_light(Light* l) {
  nook_gl_upload_destroy(&l->uploaded);
  nook_probe_destroy(&l->probe);
  nook_gl_destroy(&l->gl);
  nook_context_destroy(&l->context);
}

/* The exposure at which a white surface in constant light of the probe's mean radiance has three quarters of
 * full brightness. */
static float exposure_for(const Light* l) {
  float sum = 0;
  for (unsigned i = 0; i < l->lobe_count; ++i) {
    float rgb[3] = {0, 0, 0};
    nook_sg_integral(&l->lobes[i], rgb);
    sum += (rgb[0] + rgb[1] + rgb[2]) / (3 * 4 * 3.14159265F);
  }
  return sum > 0 ? 1.4F / sum : 1;
}

static GLuint program_of(const Light* l) {
  const size_t size = strlen(l->info.glsl) + sizeof fragment_begin + sizeof fragment_end;
  char* const text = malloc(size);
  GLuint program = 0;
  if (!text) return 0;
  snprintf(text, size, "%s%s%s", fragment_begin, l->info.glsl, fragment_end);
  program = offscreen_program(vertex_text, text);
  free(text);
  return program;
}

static GLuint upload(const float* values, int count, GLuint slot) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)count * 3 * sizeof *values), values, GL_STATIC_DRAW);
  glEnableVertexAttribArray(slot);
  glVertexAttribPointer(slot, 3, GL_FLOAT, GL_FALSE, 0, NULL);
  return buffer;
}

/* The vertex array that draws a shape. */
static GLuint drawable(const Shape* shape) {
  GLuint array = 0, indices = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  upload(shape->position, shape->vertex_count, 0);
  upload(shape->normal, shape->vertex_count, 1);
  if (shape->occlusion) upload(shape->occlusion, shape->vertex_count, 2);
  glGenBuffers(1, &indices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)shape->index_count * sizeof *shape->index),
               shape->index, GL_STATIC_DRAW);
  return array;
}

typedef struct Material {
  float albedo[3], roughness, reflectance;
  int sky;
} Material;

static void draw(GLuint program, GLuint array, const Shape* shape, const float place[4], const Material* m) {
  glUniform4fv(glGetUniformLocation(program, "place"), 1, place);
  glUniform3fv(glGetUniformLocation(program, "albedo"), 1, m->albedo);
  glUniform1f(glGetUniformLocation(program, "roughness"), m->roughness);
  glUniform1f(glGetUniformLocation(program, "reflectance"), m->reflectance);
  glUniform1i(glGetUniformLocation(program, "sky"), m->sky);
  glBindVertexArray(array);
  glVertexAttrib3f(2, 1, 1, 1);
  glDrawElements(GL_TRIANGLES, shape->index_count, GL_UNSIGNED_INT, NULL);
}

static void draw_all(GLuint program, const Light* l, const Shape* sphere, const Shape* character) {
  const float eye[3] = {0, 1, 7.2F}, far_sphere[4] = {0, 1, 7.2F, 40};
  const float tall = 1 / tanf(0.5F * 0.3F);
  const Material sky = {{0, 0, 0}, 1, 0, 1};
  const GLuint sphere_array = drawable(sphere);
  if (nook_gl_upload_bind(l->uploaded, program, 0)) fprintf(stderr, "%s\n", nook_last_message());
  glUniform2f(glGetUniformLocation(program, "scale"), tall * height / width, tall);
  glUniform3fv(glGetUniformLocation(program, "eye_ws"), 1, eye);
  glUniform1f(glGetUniformLocation(program, "exposure"), exposure_for(l));
  draw(program, sphere_array, sphere, far_sphere, &sky);
  glEnable(GL_DEPTH_TEST);
  for (int i = 0; i < 6; ++i) {
    const float x = (character->vertex_count ? -1.95F : -1.5F) + 0.6F * (float)i;
    const float upper[4] = {x, 1.34F, 0, 0.27F}, lower[4] = {x, 0.68F, 0, 0.27F};
    const float roughness = 0.12F + 0.145F * (float)i;
    const Material metal = {{0, 0, 0}, roughness, 0.92F, 0},
                   plastic = {{0.6F, 0.6F, 0.6F}, roughness, 0.04F, 0};
    draw(program, sphere_array, sphere, upper, &metal);
    draw(program, sphere_array, sphere, lower, &plastic);
  }
  if (character->vertex_count) {
    const float stand[4] = {1.75F, 0.07F, 0, 1};
    const Material clay = {{0.6F, 0.57F, 0.53F}, 0.6F, 0.04F, 0};
    draw(program, drawable(character), character, stand, &clay);
  }
}

/* Writes the picture, in which each pixel is the mean of its block of samples. */
static int save(const char* path) {
  const int s = samples_across;
  unsigned char* const large = malloc((size_t)(width * s) * (size_t)(height * s) * 3);
  unsigned char* const rgb = malloc((size_t)width * height * 3);
  int ok = large && rgb;
  if (ok) {
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width * s, height * s, GL_RGB, GL_UNSIGNED_BYTE, large);
    for (int y = 0; y < height; ++y)
      for (int i = 0; i < 3 * width; ++i) {
        const unsigned char* const at =
            large + (size_t)(y * s) * (size_t)(3 * width * s) + (i / 3) * 3 * s + i % 3;
        const size_t row = (size_t)(3 * width * s);
        rgb[(size_t)y * (3 * width) + (size_t)i] =
            (unsigned char)((at[0] + at[3] + at[row] + at[row + 3] + 2) / 4);
      }
    ok = picture_write(path, rgb, width, height);
    if (!ok) fprintf(stderr, "probe: %s cannot be written; check that its folder exists\n", path);
  }
  free(rgb);
  free(large);
  return ok;
}

int main(int argc, char** argv) {
  open_closed_streams();
  Light light;
  Shape sphere, character;
  unsigned char* bytes;
  size_t size = 0;
  GLuint program = 0, colour, depth;
  int saved = 0;
  nook_result result;
  memset(&light, 0, sizeof light);
  memset(&sphere, 0, sizeof sphere);
  memset(&character, 0, sizeof character);
  if (argc != 3 && argc != 5) {
    fputs("usage: probe PROBE.nook OUT.png [CHARACTER.glb MODEL.nook]\n", stderr);
    return 2;
  }
  bytes = read_bytes(argv[1], &size);
  if (!bytes) return 3;
  if (!offscreen_start()) return 1;
  result = start_light(&light, bytes, size);
  free(bytes);
  if (result) fprintf(stderr, "%s (%s)\n", nook_last_message(), nook_result_name(result));
  colour =
      offscreen_texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width * samples_across, height * samples_across);
  depth = offscreen_texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width * samples_across,
                            height * samples_across);
  if (!result && sphere_make(&sphere) &&
      (argc == 3 ||
       character_make(&character, light.context, argv[3], argv[4], light.lobes, light.lobe_count)) &&
      offscreen_framebuffer(colour, depth))
    program = program_of(&light);
  if (program) {
    glViewport(0, 0, width * samples_across, height * samples_across);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_all(program, &light, &sphere, &character);
    saved = save(argv[2]);
  }
  shape_free(&sphere);
  shape_free(&character);
  stop_light(&light);
  offscreen_stop();
  if (result) return result == NOOK_ERROR_BAD_FILE || result == NOOK_ERROR_FILE_VERSION ? 3 : 1;
  return saved ? 0 : 1;
}
