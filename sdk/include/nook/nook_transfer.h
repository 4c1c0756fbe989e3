/* Radiance transfer: compressed materials on static shapes under any distant light, with the shapes' own
 * shadows. `nook bake transfer` bakes the visibility of a shape; any material can be put on it at run time.
 *
 * Light is held by lobes, spherical Gaussians of one sharpness that are evenly spread over the sphere. A
 * vertex p has, for channel c and light mode a of a material, the vector
 *     r_p[c, a] = sum over lobes j of amplitude_j[c] share_p,j response[c, a](direction of lobe j at p),
 * where the share, a byte of the file, is the cosine-weighted part of the lobe that no triangle hides from
 * the vertex, and the response is the integral of the lobe and the material's light basis over the upper
 * hemisphere. Light that the shape reflects onto itself, baked with `--bounces`, is added for the mean
 * reflectance of the response's material. A pixel's radiance is sum_a L_a r[c, a] with the light modes L_a of
 * nook_material_decode and the vectors interpolated between vertices.
 *
 * When the light or the shape turns, a host calls
 *     nook_transfer_fit_light(fit, light, NULL, amplitudes, lobes, NULL);
 *     nook_transfer_vectors(transfer, response, amplitudes, lobes, 0, count, vectors, 0);
 * and nothing is computed for vertices when only the view moves. The paper's form of a file, baked with
 * `--form paper`, has the matrices from lobes to the light modes of one material in place of shares; the
 * calls are the same.
 *
 * The space of directions is that of the baked vertices. Frames have x along growing u, z along the normal,
 * and y = handedness * cross(normal, tangent) along growing v. The vectors of a vertex are 3 x light_modes
 * floats: the modes of red, then of green, then of blue. Least squares rings around bright sources, so that
 * light and vectors can be slightly negative; nook_transfer_fit_quality gives the share.
 *
 * nook_gl_transfer.h keeps vectors in a buffer and has the GLSL. The method follows section 6.3 of Y.-T.
 * Tsai and Z.-C. Shih, K-Clustered Tensor Approximation, TOG 2012, in a separated form and in its
 * own. */
#ifndef NOOK_TRANSFER_H
#define NOOK_TRANSFER_H

#include "nook_material.h"
#include "nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_transfer_s* nook_transfer;
typedef struct nook_transfer_light_s* nook_transfer_light;
typedef struct nook_transfer_fit_s* nook_transfer_fit;
typedef struct nook_transfer_response_s* nook_transfer_response;

/* ---- Baked shapes: immutable, shared by threads ---- */

/* Loads baked transfer from the bytes of a .nook file; the caller may free the bytes afterwards. The library
 * validates everything, so that hostile bytes are safe. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_load(nook_context context, const void* bytes, size_t size,
                                        nook_transfer* out);

/* Releases the caller's reference and sets *transfer to NULL.
 * Any thread. */
NOOK_API void nook_transfer_destroy(nook_transfer* transfer);

/* The form of baked transfer. */
enum {
  /* A share for each vertex and lobe; takes any material. */
  NOOK_TRANSFER_FORM_SEPARATED = 0,
  /* The matrices from lobes to the light modes of one material, compressed by CTA: less work when the light
   * changes. */
  NOOK_TRANSFER_FORM_PAPER = 1
};
typedef int32_t nook_transfer_form;

typedef struct nook_transfer_info {
  /* sizeof(nook_transfer_info); the caller sets it. */
  uint32_t struct_size;
  /* Vertices of the baked file, over all primitives in its order. */
  uint32_t vertex_count;
  uint32_t lobe_count;
  /* The sharpness of every lobe, 0.35 times their number. */
  float sharpness;
  /* Bytes of shares in memory, vertex_count * lobe_count. */
  uint64_t share_bytes;
  /* Reflections of the shape onto itself that the vectors hold, 0 to 2. */
  uint32_t bounces;
  /* 1: light fell through the holes of a material's VOTF; see nook_transfer_check_material. */
  int32_t has_holes;
  /* Bytes of reflected light in memory, vertex_count * bounces * 18. */
  uint64_t indirect_bytes;
  nook_transfer_form form;
  /* Of the paper's form: the light modes of the material that it was baked with; else 0. */
  uint32_t light_modes;
  /* Of the paper's form: bytes of its compressed matrices in memory, and in the file; else 0. */
  uint64_t paper_bytes;
} nook_transfer_info;

/* Describes a baked shape.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_transfer_describe(nook_transfer transfer, nook_transfer_info* info);

/* Writes the frames that the vectors refer to: normals with 3 floats and tangents with 4, the handedness
 * last, for each vertex; either may be NULL. A host that draws with them needs no tangents of its own.
 * vertex_count must be the transfer's. The paper's form has no frames.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the paper's form). */
NOOK_API nook_result nook_transfer_read_frames(nook_transfer transfer, float* normals, float* tangents,
                                               uint32_t vertex_count);

/* The arrays of a mesh in the form in which they were baked. */
typedef struct nook_transfer_mesh {
  /* sizeof(nook_transfer_mesh); the caller sets it. */
  uint32_t struct_size;
  uint32_t vertex_count;
  /* 3, 3, 4 and 2 floats for each vertex; NULL is not compared. The numbers must be equal bit for bit to
   * those of the bake, which are in the space of the file's scene. */
  const float* positions;
  const float* normals;
  const float* tangents;
  const float* uvs;
} nook_transfer_mesh;

/* Checks that a mesh is the baked one, by the number of vertices and a checksum of each array.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first array that differs). */
NOOK_API nook_result nook_transfer_check_mesh(nook_transfer transfer, const nook_transfer_mesh* mesh);

/* Checks that a material is the one that the shape was baked with, where that matters: in the paper's form
 * its light modes, and with holes its VOTF must be the same. nook_transfer_vectors refuses other light modes.
 * A material with another VOTF can be drawn nevertheless, and then the shadows are those of the baked holes;
 * `nook evaluate transfer` measures the error. Reflected light follows any material.
 * Any thread. Errors: INVALID_ARGUMENT (the message names what differs). */
NOOK_API nook_result nook_transfer_check_material(nook_transfer transfer, nook_material material);

/* ---- Light: immutable, shared by threads ---- */

/* The layout of a map. */
enum {
  /* Latitude and longitude: rows from +y down to -y; the middle column looks along +x, and the column a
   * quarter of the width to its right along +z. */
  NOOK_TRANSFER_MAP_LATLONG = 0,
  /* Six square faces below each other, +x, -x, +y, -y, +z, -z, each with the axes of an OpenGL cube map. */
  NOOK_TRANSFER_MAP_CUBE = 1
};
typedef int32_t nook_transfer_map_layout;

typedef struct nook_transfer_map_desc {
  /* nook_transfer_map_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* width * height linear RGB radiances, each 0 to 1e15; required. The call copies what it needs. */
  const float* rgb;
  /* 1 to 16,384; of a cube map the height is 6 times the width. */
  uint32_t width;
  uint32_t height;
  /* Default NOOK_TRANSFER_MAP_LATLONG. */
  nook_transfer_map_layout layout;
  /* 1: suns are taken out of the light and listed by nook_transfer_light_read_suns, for a host that draws
   * them with shadow maps and nook_material_radiance. Default 0. Suns are texels whose luminance is above 100
   * times the mean of the map without its suns. Lobes hold a sun badly: it rings. */
  int32_t split_suns;
} nook_transfer_map_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_transfer_map_desc_init(nook_transfer_map_desc* desc, size_t size,
                                                 uint32_t header_version);

/* Creates the light of a map. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also, a texel is not a number in range), VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_light_create_map(nook_context context, const nook_transfer_map_desc* desc,
                                                    nook_transfer_light* out);

/* Creates the light of a probe at a point, which is given as in nook_probe_read_lobes; the probe may be
 * destroyed afterwards. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_light_create_probe(nook_context context, nook_probe probe,
                                                      const float* position_ws, nook_transfer_light* out);

/* Releases the caller's reference and sets *light to NULL.
 * Any thread. */
NOOK_API void nook_transfer_light_destroy(nook_transfer_light* light);

typedef struct nook_transfer_sun {
  /* Unit vector towards the sun, in the map's space. */
  float direction[3];
  /* RGB, on a surface that faces the sun. */
  float irradiance[3];
  /* Steradians. */
  float solid_angle;
} nook_transfer_sun;

/* Writes the suns that split_suns took out, the brightest first. *count is the number of entries before the
 * call and the number of suns afterwards; at most the former are written. suns may be NULL if *count is 0.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_transfer_light_read_suns(nook_transfer_light light, nook_transfer_sun* suns,
                                                   uint32_t* count);

/* ---- Fits: immutable, shared by threads ---- */

/* Makes lobe_count lobes, 12 to 2562, and factors the Gram matrix of their fit once, which takes about
 * lobe_count^3 / 6 multiply-adds and lobe_count^2 * 4 bytes. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_fit_create(nook_context context, uint32_t lobe_count,
                                              nook_transfer_fit* out);

/* Releases the caller's reference and sets *fit to NULL.
 * Any thread. */
NOOK_API void nook_transfer_fit_destroy(nook_transfer_fit* fit);

/* Writes the axes of the lobes, 3 floats each. lobe_count must be the fit's.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_transfer_fit_read_axes(nook_transfer_fit fit, float* axes, uint32_t lobe_count);

/* The error of lobes that hold a light. */
typedef struct nook_transfer_fit_quality {
  /* sizeof(nook_transfer_fit_quality); the caller sets it. */
  uint32_t struct_size;
  /* The root of the integral of the squared difference, relative to that of the squared light. */
  float relative_error;
  /* The negative part of the light that the lobes hold, relative to its magnitude. */
  float negative_share;
} nook_transfer_fit_quality;

/* Fits the lobes to a light by least squares over the sphere. light_from_shape is a rotation, 9 floats
 * row-major, from the shape's space to the light's; NULL is none. amplitudes gets lobe_count x RGB. quality
 * may be NULL; it takes about as long as the fit. The call allocates from the host's allocator. Any thread.
 * Errors: INVALID_ARGUMENT (also, light_from_shape is no rotation to 1e-3), OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_fit_light(nook_transfer_fit fit, nook_transfer_light light,
                                             const float* light_from_shape, float* amplitudes,
                                             uint32_t lobe_count, nook_transfer_fit_quality* quality);

/* Fits the lobes to light from one direction, a unit vector in the shape's space towards the light.
 * irradiance is RGB on a surface that faces it. The sharpest that lobes can hold is one lobe, which is 5
 * degrees wide at 642 lobes, and they ring; nook_material_radiance with a shadow map is exact. Any thread.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_fit_directional(nook_transfer_fit fit, const float* direction,
                                                   const float* irradiance, float* amplitudes,
                                                   uint32_t lobe_count);

/* ---- Materials under lobes: immutable, shared by threads ---- */

typedef struct nook_transfer_response_desc {
  /* nook_transfer_response_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Required; it may be destroyed after the call. */
  nook_material material;
  /* 12 to 2562; default 642. */
  uint32_t lobe_count;
  /* Default NOOK_ISA_AUTO. An instruction set that the processor lacks fails with UNSUPPORTED. */
  nook_isa isa;
} nook_transfer_response_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_transfer_response_desc_init(nook_transfer_response_desc* desc, size_t size,
                                                      uint32_t header_version);

/* Tabulates the response of a material to lobes from all directions, in about 0.2 s. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION, UNSUPPORTED, OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_response_create(nook_context context,
                                                   const nook_transfer_response_desc* desc,
                                                   nook_transfer_response* out);

/* Releases the caller's reference and sets *response to NULL.
 * Any thread. */
NOOK_API void nook_transfer_response_destroy(nook_transfer_response* response);

typedef struct nook_transfer_response_info {
  /* sizeof(nook_transfer_response_info); the caller sets it. */
  uint32_t struct_size;
  uint32_t lobe_count;
  /* The modes of one channel, R_l of the material rounded up to a multiple of 4; NOOK_LIGHT_VEC4_COUNT of its
   * GLSL is a quarter of it. */
  uint32_t light_modes;
  /* Floats of a vertex, 3 * light_modes. */
  uint32_t vector_floats;
  /* Memory of the table. */
  uint64_t table_bytes;
  /* The share of light that the material reflects under even light, RGB, 0 to 1. */
  float reflectance[3];
  /* 0. */
  uint32_t reserved;
} nook_transfer_response_info;

/* Describes a response.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_transfer_response_describe(nook_transfer_response response,
                                                     nook_transfer_response_info* info);

/* Writes the vectors of vertices first_vertex to first_vertex + vertex_count of a baked shape. amplitudes has
 * lobe_count x RGB, finite numbers whose magnitude is at most 1e22; lobe_count must be that of the response
 * and of the transfer. stride_floats is the number of floats between the vectors of two vertices, 0 for
 * vector_floats. The work goes through the context's parallel_for if there is one, and the result does not
 * depend on it. The call allocates 16 bytes for a lobe, and in the paper's form 3 * light_modes * vertex rank
 * floats for a cluster, 2.2 KiB at 16 modes. Any thread. Errors: INVALID_ARGUMENT (also, in the paper's form,
 * the response is of another material), OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_vectors(nook_transfer transfer, nook_transfer_response response,
                                           const float* amplitudes, uint32_t lobe_count,
                                           uint32_t first_vertex, uint32_t vertex_count, float* vectors,
                                           uint32_t stride_floats);

/* Writes the vectors of vertices without baked visibility, from unit normals (3 floats each) and tangents (4
 * floats each, the handedness last): all light above their horizon reaches them. A prop under a probe needs
 * no more than this. Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_open_vectors(nook_transfer_response response, const float* amplitudes,
                                                uint32_t lobe_count, const float* normals,
                                                const float* tangents, uint32_t vertex_count, float* vectors,
                                                uint32_t stride_floats);

/* Computes the radiance, linear RGB, of material samples from vectors of vector_floats floats each, one for
 * each sample; the light of a sample is not read. This is the reference of the GLSL of nook_gl_transfer.h.
 * Any thread. Errors: INVALID_ARGUMENT (also, vector_floats is not that of the material, or a number is not
 * finite). */
NOOK_API nook_result nook_transfer_shade(nook_material material, const nook_material_sample* samples,
                                         const float* vectors, uint32_t vector_floats, uint32_t count,
                                         float* radiance);

#ifdef __cplusplus
}
#endif
#endif
