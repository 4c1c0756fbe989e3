/* Screen-space ambient occlusion by a small neural network: from a depth buffer, and normals if there are any, to AO in a
 * texture, or multiplied into an image of the host. One parameter matters: the radius.
 *
 * After D. Holden, J. Saito, T. Komura, Neural Network Ambient Occlusion (2016): with x what the pixels around one pixel
 * look like from it, AO = L3(L2(L1(L0(x)))), Ln(x) = PReLU(Wn x + bn), PReLU(x) = b max(x, 0) + a min(x, 0).
 * The embedded network reads x along directions on the screen (the horizon form); the paper's own, which reads it over a
 * 31 x 31 grid, can be loaded instead. What is learned is the cosine-weighted visibility of the hemisphere round the normal,
 * to the distance of the radius.
 *
 * Each frame, after depth is drawn and before lighting:
 *     nook_nnao_frame_desc frame;
 *     nook_nnao_frame_desc_init(&frame, sizeof frame, NOOK_VERSION);
 *     frame.depth_texture = depth;  frame.width = width;  frame.height = height;
 *     memcpy(frame.projection, projection, sizeof frame.projection);
 *     frame.radius = 0.5f;
 *     nook_nnao_render(pass, &frame);
 * and in the shader that lights, times the ambient term (not the direct light):
 *     float ao = texelFetch(nook_ao, ivec2(gl_FragCoord.xy), 0).r;
 *
 * What the host wrote to an input by image stores needs its own glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT) before the call.
 * The result is drawn, whatever the path: reading it needs no barrier.
 *
 * View space is OpenGL's: x right, y up, the camera looks along -z, metres. Images count from their lower left corner.
 * Every function that takes a nook_gl or a nook_nnao, except nook_nnao_describe, belongs to the context thread, and makes
 * OpenGL calls unless it says otherwise; nook_gl.h says what of OpenGL's state is touched and what may not be active. */
#ifndef NOOK_NNAO_H
#define NOOK_NNAO_H

#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_nnao_s* nook_nnao;

/* How the network's stage runs; the others are draws in any case. Both paths give the same AO, on Mesa's llvmpipe the same
 * bits. There compute takes 0.87 to 0.99 of a frame's processor time by fragments (docs/nnao.md); no GPU was measured. */
enum {
  NOOK_NNAO_PATH_AUTOMATIC = 0, /* compute where it can be had, else fragment */
  NOOK_NNAO_PATH_FRAGMENT = 1,  /* a draw; OpenGL 3.3 */
  NOOK_NNAO_PATH_COMPUTE = 2    /* a dispatch; OpenGL 4.3, glBindImageTexture and no lower max_tier in nook_gl_desc */
};
typedef int32_t nook_nnao_path;

typedef struct nook_nnao_desc {
  uint32_t struct_size;    /* set by nook_nnao_desc_init */
  uint32_t header_version; /* set by nook_nnao_desc_init */
  const void* next;        /* NULL */
  int32_t max_width;       /* pixels, 1 to 16384; required. Frames of any size up to it allocate nothing */
  int32_t max_height;
  int32_t taps;            /* pixels looked at: 16, 32, 64 (default), 128 or 256 */
  int32_t half_resolution; /* 1: AO at half width and height, then a joint-bilateral upsample. Default 0 */
  int32_t blur;            /* 1 (default): bilateral blur over 7 x 7 pixels, by depth and normal */
  float blur_sharpness;    /* the blur ends at 1 / blur_sharpness radii off the pixel's plane; above 0, default 16 */
  int32_t timers;          /* 1: each stage is timed, see nook_nnao_read_timings. Default 0 */
  nook_nnao_path path;     /* default NOOK_NNAO_PATH_AUTOMATIC */
  const void* network;     /* a .nook file of `nook train nnao`, of either form; NULL (default): the embedded network */
  size_t network_size;     /* bytes */
} nook_nnao_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_nnao_desc_init(nook_nnao_desc* desc, size_t size, uint32_t header_version);

/* The texture memory of a pass made from *desc: 6 bytes a pixel, 3.5 at half resolution, which at 3840 x 2160 is 50 MB
 * and 29 MB. The filters of the paper's form add 62 kB. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_nnao_memory(const nook_nnao_desc* desc, uint64_t* bytes);

/* Makes textures and shaders; the network's bytes are not needed afterwards. On failure *out is NULL and no OpenGL
 * object is left. Context thread.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (larger than this OpenGL's textures; a path that this OpenGL does not have),
 * BAD_FILE, FILE_VERSION, GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_create(nook_gl gl, const nook_nnao_desc* desc, nook_nnao* out);

/* Deletes every OpenGL object of the pass and sets *pass to NULL; NULL is fine, and so is a nook_gl that was destroyed
 * before. Context thread, with the OpenGL context of nook_gl_create current (any thread after nook_gl_context_lost). */
NOOK_API void nook_nnao_destroy(nook_nnao* pass);

enum {
  NOOK_NNAO_DEPTH_HARDWARE = 0, /* what OpenGL wrote under `projection` and glDepthRange(0, 1): a depth format, or its copy
                                   in the red channel of a 32-bit float texture */
  NOOK_NNAO_DEPTH_LINEAR = 1    /* -z of view space in metres, in the red channel of a float texture */
};
typedef int32_t nook_nnao_depth_kind;

enum {
  NOOK_NNAO_CLIP_NEGATIVE_ONE_TO_ONE = 0, /* OpenGL's default */
  NOOK_NNAO_CLIP_ZERO_TO_ONE = 1          /* glClipControl(..., GL_ZERO_TO_ONE) */
};
typedef int32_t nook_nnao_clip;

/* How the result s of the pass and a layer texture combine. c is the layer's red channel: AO of another kind, such as
 * nook_gl_scene_update's, drawn by the host (1 where it has none); w the green channel, a weight. */
enum {
  NOOK_NNAO_LAYER_NONE = 0,     /* s */
  NOOK_NNAO_LAYER_MIN = 1,      /* min(s, c): where both see the same occlusion it darkens once */
  NOOK_NNAO_LAYER_REMAINDER = 2, /* min(s, c) / c: for an image that c has darkened already; the product is min(s, c) */
  NOOK_NNAO_LAYER_REPLACE = 3   /* (1 - w) s + w c: where w is 1 the layer alone counts */
};
typedef int32_t nook_nnao_layer;

enum {
  NOOK_NNAO_TARGET_OWN = 0,        /* the red channel of the pass's own texture, see nook_nnao_info */
  NOOK_NNAO_TARGET_TEXTURE = 1,    /* level 0 of a 2D texture of the host */
  NOOK_NNAO_TARGET_FRAMEBUFFER = 2 /* the first draw buffer of a framebuffer of the host; 0 is the window. The contents of
                                      further draw buffers become undefined */
};
typedef int32_t nook_nnao_target;

enum {
  NOOK_NNAO_WRITE = 0,   /* (ao, ao, ao, 1) */
  NOOK_NNAO_MULTIPLY = 1 /* colour times ao, alpha kept; not with NOOK_NNAO_TARGET_OWN */
};
typedef int32_t nook_nnao_blend;

enum {
  NOOK_NNAO_VIEW_AO = 0,     /* the result */
  NOOK_NNAO_VIEW_RAW = 1,    /* without blur, intensity, power and layer */
  NOOK_NNAO_VIEW_BLURRED = 2, /* without intensity, power and layer */
  NOOK_NNAO_VIEW_NORMALS = 3 /* normals as used, (n + 1) / 2 in red, green and blue; not with NOOK_NNAO_TARGET_OWN */
};
typedef int32_t nook_nnao_view;

/* One frame. Textures are 2D, single-sampled, of width x height texels, level 0. They are read through samplers of the
 * pass: none of their parameters changes, and filters, wrapping and compare modes do not matter. Textures and targets are
 * asked for size and format when any name, kind or size here differs from the last call's: after a texture was made anew
 * under its old name, say so with nook_nnao_recheck. */
typedef struct nook_nnao_frame_desc {
  uint32_t struct_size;            /* set by nook_nnao_frame_desc_init */
  uint32_t header_version;         /* set by nook_nnao_frame_desc_init */
  const void* next;                /* NULL */
  int32_t width, height;           /* of every texture here; at most the pass's maximum; required */
  int32_t viewport[4];             /* x, y, width, height of the part that `projection` fills; all 0 (default): everything.
                                      Nothing is read or written outside it */
  uint32_t depth_texture;          /* required */
  nook_nnao_depth_kind depth_kind; /* default NOOK_NNAO_DEPTH_HARDWARE */
  float sky_depth;                 /* linear depth only: metres; from here on is sky. 0 (default): none. Depths that are not
                                      finite, or not positive in a perspective, are sky as well, and so is the far
                                      plane of hardware depth. AO of sky is exactly 1 */
  uint32_t normal_texture;         /* 0 (default): normals are rebuilt from depth */
  float normal_scale, normal_bias; /* normal = normal_matrix (texel normal_scale + normal_bias), then made unit; default 1
                                      and 0; for normals stored as (n + 1) / 2 give 2 and -1 */
  float normal_matrix[9];          /* column-major, to view space; the identity by default */
  float projection[16];            /* column-major, as OpenGL takes it; required. Perspective, off-centre, orthographic,
                                      reversed depth and infinite far plane are all read from it */
  nook_nnao_clip clip;             /* hardware depth only; default NOOK_NNAO_CLIP_NEGATIVE_ONE_TO_ONE */
  float radius;                    /* metres; what is farther away occludes nothing. Above 0; required */
  float max_radius_px;             /* the radius covers at most so many pixels; near the camera it shrinks. 0 (default):
                                      a quarter of the viewport's height */
  float intensity, power;          /* AO becomes max(0, 1 - intensity (1 - AO)) ^ power; intensity 0 to 16, power
                                      above 0 to 16; default 1 and 1 */
  nook_nnao_layer layer;           /* default NOOK_NNAO_LAYER_NONE */
  uint32_t layer_texture;          /* required with another layer */
  nook_nnao_target target;         /* default NOOK_NNAO_TARGET_OWN */
  uint32_t target_name;            /* of the host's texture or framebuffer; pixel (x, y) goes to pixel (x, y). Formats with
                                      sRGB are written and multiplied in linear light */
  nook_nnao_blend blend;           /* default NOOK_NNAO_WRITE */
  nook_nnao_view view;             /* default NOOK_NNAO_VIEW_AO */
} nook_nnao_frame_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_nnao_frame_desc_init(nook_nnao_frame_desc* desc, size_t size, uint32_t header_version);

/* Draws the AO of a frame. Allocates nothing, reads nothing back, never waits for the GPU. On failure no OpenGL error is
 * left, no state is changed and nothing is drawn. Context thread.
 * Errors: INVALID_ARGUMENT (the message names the field, what came and what is needed: a size above the maximum or that
 * is not a texture's, a format of another kind, an input that is the target, a matrix that is not finite, singular or
 * no projection, a radius not above 0), GL (the context was lost). */
NOOK_API nook_result nook_nnao_render(nook_nnao pass, const nook_nnao_frame_desc* frame);

/* The next nook_nnao_render asks OpenGL about every texture again. Makes no OpenGL call. Context thread.
 * Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_recheck(nook_nnao pass);

typedef struct nook_nnao_info {
  uint32_t struct_size;   /* sizeof(nook_nnao_info), set by the caller */
  uint32_t texture;       /* the pass's own texture: GL_R8, max_width x max_height, AO of pixel (x, y) in texel (x, y). Owned
                             by Nook: read it, never write or delete it. 1 everywhere before the first frame; later frames
                             write their viewport alone, those with another target something undefined */
  uint64_t texture_bytes; /* of all textures of the pass */
  int32_t taps;
  int32_t horizon_form;   /* 1: the network has the horizon form; 0: the paper's */
  nook_nnao_path path;    /* what runs: NOOK_NNAO_PATH_FRAGMENT or NOOK_NNAO_PATH_COMPUTE */
  int32_t reserved;       /* 0 */
} nook_nnao_info;
/* Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_describe(nook_nnao pass, nook_nnao_info* info);

/* Milliseconds that the GPU took for each stage of the newest frame that is finished. */
typedef struct nook_nnao_timings {
  uint32_t struct_size; /* sizeof(nook_nnao_timings), set by the caller */
  int32_t valid;        /* 0: no frame is finished yet, or the pass was made without timers; the rest is 0 then */
  float normals;        /* reading or rebuilding normals; the smaller buffers of half resolution */
  float occlusion;      /* the network */
  float blur;           /* 0 without blur; its second half counts as resolve at full resolution */
  float resolve;        /* upsample, layer, target */
  float total;
} nook_nnao_timings;
/* Never waits. Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_nnao_read_timings(nook_nnao pass, nook_nnao_timings* timings);

#ifdef __cplusplus
}
#endif
#endif
