/* Nook's screen-space pass in a Vulkan program without a window. It draws a room before and after.
 *
 *   vulkan [FOLDER] [fast|default|best] [normals] [reversed] [mean] [RADIUS]
 *
 * It writes before.png, after.png, ao.png and frame.nook. The radius is in metres and 0.5 by default.
 * `normals` gives the pass the normals of the room, `reversed` uses a reversed depth buffer, and `mean`
 * averages AO over four frames.
 *
 * An engine needs nook_vulkan.h and the marked regions. engine.h stands in for the engine. */
#include <nook/experimental/nook_recording.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "platform/standard_streams.h"
#include "samples/offscreen/picture.h"
#include "samples/offscreen/whole_file.h"
#include "samples/vulkan/engine.h"
#include "samples/vulkan/nook_vulkan.h"

enum { width = 960, height = 540, pixels = width * height, frames_of_mean = 4 };

typedef struct Settings {
  const char* folder;
  float radius_m;
  nook_nnao_preset preset;
  int normals, reversed, mean;
} Settings;

typedef struct Pass {
  nook_context context;
  nook_nnao_desc desc;
  nook_vulkan vulkan;
} Pass;

/* ---- 1. Once for each device and size ---- */
static VkResult start_pass(Pass* p, const engine* e, const Settings* s) {
  const nook_vulkan_inputs inputs = {.depth = e->depth.view, .normal = e->normal.view};
  nook_context_desc context_desc;
  nook_result r = nook_context_desc_init(&context_desc);
  if (!r) r = nook_context_create(&context_desc, &p->context);
  if (!r) r = nook_nnao_desc_init(&p->desc);
  p->desc.preset = s->preset;
  p->desc.max_history_frames = s->mean ? frames_of_mean : 0;
  p->desc.max_width = e->width;
  p->desc.max_height = e->height;
  if (r) return VK_ERROR_UNKNOWN;
  return nook_vulkan_create(e->physical, e->device, p->context, &p->desc, &inputs, &p->vulkan);
}

/* Writes the rotation from world space, the space of the normals, to view space. Column-major. */
static void rotation(const float view[16], float out[9]) {
  for (int i = 0; i < 9; ++i) out[i] = view[i / 3 * 4 + i % 3];
}

/* ---- 2. Each frame, after depth has been drawn ---- */
static VkResult record_pass(Pass* p, const engine* e, const Settings* s) {
  nook_gl_frame_desc frame;
  nook_nnao_frame_desc desc;
  if (nook_gl_frame_desc_init(&frame) || nook_nnao_frame_desc_init(&desc)) return VK_ERROR_UNKNOWN;
  frame.width = e->width;
  frame.height = e->height;
  /* [frame] */
  frame.clip_space = NOOK_CLIP_SPACE_ZERO_TO_ONE;
  memcpy(frame.projection, e->projection, sizeof frame.projection);
  desc.radius = s->radius_m;
  frame.normal_texture = s->normals ? 1 : 0; /* 0: normals that follow from depth */
  rotation(e->view, frame.normal_matrix);
  return nook_vulkan_record(&p->vulkan, e->commands, &frame, &desc);
  /* [end] */
}

/* ---- 3. At the end, when no frame is running ---- */
static void stop_pass(Pass* p) {
  nook_vulkan_destroy(&p->vulkan);
  nook_context_destroy(&p->context);
}

/* The images of a frame, the upper row first. `normals` is NULL if the frame has none. */
typedef struct Texels {
  float *depth, *normals, *ao;
} Texels;

/* ---- 4. When a picture is wrong: the frame in a file, for nook evaluate nnao --frame ---- */
static nook_result record_frame(const Pass* p, const engine* e, float radius_m, const Texels* texels,
                                void** bytes, size_t* size) {
  nook_nnao_recording_desc desc;
  nook_nnao_recording recording = NULL;
  nook_nnao_stages_info info = {.struct_size = sizeof info};
  nook_result r = nook_nnao_recording_desc_init(&desc);
  desc.width = e->width;
  desc.height = e->height;
  desc.depth = texels->depth;
  desc.normals = texels->normals;
  rotation(e->view, desc.normal_matrix);
  desc.ao = p->desc.max_history_frames ? NULL : texels->ao; /* a recording is one frame */
  desc.clip = NOOK_CLIP_SPACE_ZERO_TO_ONE;
  memcpy(desc.projection, e->projection, sizeof desc.projection);
  desc.radius = radius_m;
  if (!r) r = nook_nnao_stages_describe(p->vulkan.stages, &info);
  desc.taps = info.taps;
  desc.half_resolution = info.half_resolution;
  desc.blur = info.blur;
  desc.renderer = e->device_name;
  desc.note = "the room of samples/vulkan";
  if (!r) r = nook_nnao_recording_create(p->context, &desc, &recording);
  if (!r) r = nook_nnao_recording_save(recording, NULL, size);
  if (!r) *bytes = malloc(*size);
  if (!r && *bytes) r = nook_nnao_recording_save(recording, *bytes, size);
  nook_nnao_recording_destroy(&recording);
  return r;
}

/* Saves a picture of 1 or 4 bytes for each pixel, the upper row first, as images of Vulkan are. */
static int save_picture(const char* path, const unsigned char* texels, int texel_bytes) {
  unsigned char* const rgb = malloc((size_t)pixels * 3);
  int ok = rgb != NULL;
  for (int y = 0; ok && y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        rgb[((height - 1 - y) * width + x) * 3 + c] =
            texels[(y * width + x) * texel_bytes + (texel_bytes == 4 ? c : 0)];
  ok = ok && picture_write(path, rgb, width, height);
  free(rgb);
  return ok;
}

static const char* path_in(const char* folder, const char* name) {
  static char path[1000];
  return snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path ? path : "";
}

/* Draws the room in its light and saves it. */
static int save_room(engine* e, const char* path, int use_ao, unsigned char* rgba) {
  VkResult r = engine_begin(e);
  if (!r) engine_draw_colour(e, use_ao);
  if (!r) r = engine_finish(e);
  if (!r) r = engine_read(e, e->colour.image, VK_IMAGE_ASPECT_COLOR_BIT, 4, rgba);
  return !r && save_picture(path, rgba, 4);
}

/* Reads depth, and normals with four floats for each texel; keeps three of them. */
static VkResult read_texels(engine* e, Texels* texels) {
  VkResult r = engine_read(e, e->depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, 4, texels->depth);
  if (r || !texels->normals) return r;
  r = engine_read(e, e->normal.image, VK_IMAGE_ASPECT_COLOR_BIT, 16, texels->normals);
  for (int i = 0; i < 3 * pixels; ++i) texels->normals[i] = texels->normals[i / 3 * 4 + i % 3];
  return r;
}

static int save_frame(Pass* p, engine* e, const Settings* s, const unsigned char* ao) {
  float* const memory = malloc(6 * (size_t)pixels * sizeof *memory);
  Texels texels = {memory, s->normals ? memory + 2 * pixels : NULL, memory + pixels};
  void* bytes = NULL;
  size_t size = 0;
  int ok = memory && read_texels(e, &texels) == VK_SUCCESS;
  for (int i = 0; ok && i < pixels; ++i) texels.ao[i] = (float)ao[i] / 255;
  ok = ok && record_frame(p, e, s->radius_m, &texels, &bytes, &size) == NOOK_OK;
  ok = ok && bytes && whole_file_write(path_in(s->folder, "frame.nook"), bytes, size);
  free(bytes);
  free(memory);
  return ok;
}

static int save_all(Pass* p, engine* e, const Settings* s) {
  const VkImage ao = p->vulkan.images[NOOK_NNAO_IMAGE_TARGET].image;
  unsigned char* const texels = malloc((size_t)pixels * 4);
  int ok = texels && engine_read(e, ao, VK_IMAGE_ASPECT_COLOR_BIT, 1, texels) == VK_SUCCESS;
  ok = ok && save_picture(path_in(s->folder, "ao.png"), texels, 1);
  ok = ok && save_frame(p, e, s, texels);
  ok = ok && save_room(e, path_in(s->folder, "before.png"), 0, texels);
  ok = ok && save_room(e, path_in(s->folder, "after.png"), 1, texels);
  free(texels);
  return ok;
}

/* Returns 0 if an argument is unknown. */
static int read_arguments(int argc, char** argv, Settings* s) {
  static const char* const presets[3] = {"default", "fast", "best"};
  if (argc > 1) s->folder = argv[1];
  for (int i = 2; i < argc; ++i) {
    char* end = NULL;
    int known = 0;
    for (int preset = 0; preset < 3; ++preset)
      if (strcmp(argv[i], presets[preset]) == 0) s->preset = preset, known = 1;
    if (strcmp(argv[i], "normals") == 0) s->normals = known = 1;
    if (strcmp(argv[i], "reversed") == 0) s->reversed = known = 1;
    if (strcmp(argv[i], "mean") == 0) s->mean = known = 1;
    if (known) continue;
    s->radius_m = strtof(argv[i], &end);
    if (end == argv[i] || *end) return 0;
  }
  return 1;
}

/* Draws the frames; the pictures show the last one. */
static VkResult draw_frames(Pass* p, engine* e, const Settings* s) {
  VkResult r = VK_SUCCESS;
  for (int frame = 0; !r && frame < (s->mean ? frames_of_mean : 1); ++frame) {
    r = engine_begin(e);
    if (r) return r;
    engine_draw_depth(e);
    r = record_pass(p, e, s);
    if (!r) r = engine_finish(e);
  }
  return r;
}

int main(int argc, char** argv) {
  open_closed_streams();
  Settings settings = {".", 0.5F, NOOK_NNAO_PRESET_DEFAULT, 0, 0, 0};
  engine e;
  Pass pass = {0};
  int failure = 0;
  VkResult r;
  if (!read_arguments(argc, argv, &settings)) {
    fputs("usage: vulkan [FOLDER] [fast|default|best] [normals] [reversed] [mean] [RADIUS]\n", stderr);
    return 2;
  }
  r = engine_start(&e, width, height, settings.reversed);
  if (r) {
    if (r == VK_ERROR_INCOMPATIBLE_DRIVER)
      fputs("vulkan: no device with Vulkan 1.1; on Debian, mesa-vulkan-drivers has one\n", stderr);
    else
      fprintf(stderr, "vulkan: the engine does not start (%d)\n", r);
    engine_stop(&e);
    return r == VK_ERROR_INCOMPATIBLE_DRIVER ? 3 : 1;
  }
  r = start_pass(&pass, &e, &settings);
  if (!r) engine_set_ao(&e, pass.vulkan.images[NOOK_NNAO_IMAGE_TARGET].view);
  if (!r) r = draw_frames(&pass, &e, &settings);
  if (r) {
    fprintf(stderr, "vulkan: %d %s\n", r, nook_last_message());
    failure = r == VK_ERROR_UNKNOWN ? 2 : 1;
  } else if (!save_all(&pass, &e, &settings)) {
    fprintf(stderr, "vulkan: %s cannot be written; check that the folder exists\n", settings.folder);
    failure = 1;
  }
  stop_pass(&pass);
  engine_stop(&e);
  if (!failure) printf("%s, %d complaints of the validation layer\n", e.device_name, e.complaints);
  return failure ? failure : e.complaints != 0;
}
