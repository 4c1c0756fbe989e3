/* Radiance transfer draws compressed materials on static shapes. The light can be any distant light, and each
 * shape shadows itself. `nook bake transfer` bakes the visibility of a shape. At run time, you can use any
 * material on the shape.
 *
 * Light is represented by lobes: spherical Gaussians with the same sharpness, distributed evenly over the
 * sphere. At run time, Nook computes a vector for each vertex p, with an entry for each channel c and light
 * mode a of the material:
 *     r_p[c, a] = sum over lobes j of amplitude_j[c] share_p,j response[c, a](direction of lobe j at p)
 * Here share_p,j is a byte of the file: the cosine-weighted fraction of lobe j that no triangle hides from
 * vertex p. The response is the integral of the lobe times the material's light basis over the upper
 * hemisphere. If you bake with `--bounces`, the vector includes light that the shape reflects onto itself,
 * computed with the mean reflectance of the material. A pixel's radiance is sum_a L_a r[c, a], with the light
 * modes L_a of nook_material_decode and r interpolated between vertices.
 *
 * When the light changes or the shape rotates, call
 *     nook_transfer_light_project(light, lobe_count, NULL, amplitudes, NULL);
 *     nook_transfer_read_vectors(response, &desc, vectors, vertex_count, 0);
 * where `desc` contains the transfer and the amplitudes. When only the camera moves, you need not call
 * anything. Files in the paper's form (`--form paper`) contain matrices from lobes to the light modes of one
 * material, instead of shares. You use them with the same calls.
 *
 * Directions are in the space of the baked vertices. Frames have x in the direction of increasing u, z along
 * the normal, and y = handedness * cross(normal, tangent) in the direction of increasing v. The vectors of a
 * vertex are 3 x light_modes floats: the modes of red, then of green, then of blue. The least-squares fit of
 * the lobes rings around bright sources, so light and vectors can be slightly negative;
 * nook_transfer_projection_info gives the negative share.
 *
 * nook_gl_upload_transfer keeps vectors in a buffer, and nook_gl_upload_describe gives the GLSL. The paper's
 * form is the method in section 6.3 of Y.-T. Tsai and Z.-C. Shih, K-Clustered Tensor Approximation, TOG 2012.
 * The default form differs from the paper: it separates transfer and material. */
#ifndef NOOK_TRANSFER_H
#define NOOK_TRANSFER_H

#include "../nook_material.h"
#include "../nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_transfer_s* nook_transfer;
typedef struct nook_transfer_light_s* nook_transfer_light;
typedef struct nook_transfer_response_s* nook_transfer_response;

/* ---- Baked shapes: immutable, shared by threads ---- */

/* Loads baked transfer from the bytes of a .nook file, which you may free afterwards. The library validates
 * everything, so you can load files that you do not trust. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_load(nook_context context, const void* bytes, size_t size,
                                        nook_transfer* out);

/* Releases your reference and sets *transfer to NULL.
 * Any thread. */
NOOK_API void nook_transfer_destroy(nook_transfer* transfer);

typedef struct nook_transfer_info {
  uint32_t struct_size;
  /* The number of vertices of the baked file, over all primitives in file order. */
  uint32_t vertex_count;
  /* The number of lobes. Their axes form H. Vogel's spiral, so they depend only on this number: lobe i has z
   * = 1 - (2 i + 1) / lobe_count and the azimuth i * pi * (3 - sqrt(5)) from +x towards +y. */
  uint32_t lobe_count;
  /* The sharpness of every lobe, 0.35 * lobe_count. */
  float sharpness;
  /* Bytes of shares in memory, vertex_count * lobe_count. */
  uint64_t share_bytes;
  /* The number of light bounces between parts of the shape that the vectors include, 0 to 2. */
  uint32_t bounces;
  /* 1: the bake let light through the holes of a material's VOTF; see nook_transfer_check. */
  int32_t has_holes;
  /* Bytes of the reflected light (bounces) in memory, vertex_count * bounces * 18. */
  uint64_t indirect_bytes;
  /* NOOK_FORM_DEFAULT has a share for each vertex and lobe, and works with any material. NOOK_FORM_PAPER has
   * matrices from lobes to the light modes of one material, compressed by CTA. When the light changes, the
   * paper's form takes less work to update. */
  nook_form form;
  /* For the paper's form, the number of light modes of the material that it was baked with; otherwise 0. */
  uint32_t light_modes;
  /* For the paper's form, the bytes of its compressed matrices, in memory and in the file; otherwise 0. */
  uint64_t paper_bytes;
} nook_transfer_info;

/* Describes a baked shape.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_transfer_describe(nook_transfer transfer, nook_transfer_info* info);

/* Writes the tangent frames that the vectors refer to: for each vertex, a normal of 3 floats and a tangent of
 * 4 floats, the handedness last. Either array may be NULL. If you draw with these frames, you need no
 * tangents of your own. `vertex_count` must be the transfer's vertex count. The paper's form has no frames.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the paper's form). */
NOOK_API nook_result nook_transfer_read_frames(nook_transfer transfer, float* normals, float* tangents,
                                               uint32_t vertex_count);

/* The arrays of a mesh, in the same form as for the bake. */
typedef struct nook_transfer_mesh_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Required. */
  uint32_t vertex_count;
  /* For each vertex, `positions` and `normals` hold 3 floats, `tangents` 4 and `uvs` 2. Arrays that are NULL
   * (default) are not compared. The values must be bit-identical to the values in the bake, in the space of
   * the file's scene. */
  const float* positions;
  const float* normals;
  const float* tangents;
  const float* uvs;
} nook_transfer_mesh_desc;
static inline nook_result nook_transfer_mesh_desc_init(nook_transfer_mesh_desc* desc) {
  return nook_desc_init(NOOK_DESC_TRANSFER_MESH, desc, sizeof *desc, NOOK_VERSION);
}

/* Checks that a mesh and a material are the same as in the bake. Pass NULL for the one that you do not want
 * to check. Call this function once after loading, because nook_transfer_read_vectors does not compare
 * meshes.
 *
 * The mesh must have the same number of vertices as the baked mesh, and the same checksum of each array. For
 * the paper's form, the material must have the baked light modes. If the bake let light through holes, the
 * material must also have the VOTF of the bake. You can still draw a material with another VOTF; its shadows
 * then show the baked holes, and `nook evaluate transfer` measures the error. Reflected light adapts to any
 * material. Any thread. Errors: INVALID_ARGUMENT (the message names the first array or the part of the
 * material that differs). */
NOOK_API nook_result nook_transfer_check(nook_transfer transfer, const nook_transfer_mesh_desc* mesh,
                                         nook_material material);

/* ---- Light: immutable, shared by threads ---- */

/* The layout of a map. */
enum {
  /* Latitude and longitude: rows go from +y down to -y. The middle column looks along +x. The column a
   * quarter of the width to its right looks along +z. */
  NOOK_TRANSFER_MAP_LATLONG = 0,
  /* Six square faces, one below the other (+x, -x, +y, -y, +z, -z), each with the axes of an OpenGL cube
   * map. */
  NOOK_TRANSFER_MAP_CUBE = 1
};
typedef int32_t nook_transfer_map_layout;

/* Set exactly one source of light: a map (`rgb`), a `probe`, or a `direction`. */
typedef struct nook_transfer_light_desc {
  uint32_t struct_size, type;
  const void* next;
  /* A map of width * height linear RGB radiances, each from 0 to 1e15. Default NULL. */
  const float* rgb;
  /* 1 to 16,384; the height of a cube map is 6 times its width. */
  uint32_t width;
  uint32_t height;
  /* Default NOOK_TRANSFER_MAP_LATLONG. */
  nook_transfer_map_layout layout;
  /* 1: Nook removes suns from the map, and nook_transfer_light_read_suns lists them. Draw them yourself, with
   * shadow maps and nook_material_radiance, because lobes ring around a sun. Default 0. A sun is a texel
   * whose luminance is above 100 times the mean of the map without its suns. */
  int32_t split_suns;
  /* The probe whose light is used, at the point `position_ws`. Default NULL. */
  nook_probe probe;
  /* The point for `probe`: 3 floats, as in nook_probe_read_lobes. Default NULL. */
  const float* position_ws;
  /* The direction that the light comes from, a unit vector of 3 floats. */
  const float* direction;
  /* For `direction`: the RGB irradiance on a surface that faces the light, finite numbers up to 1e15. */
  float irradiance[3];
} nook_transfer_light_desc;
static inline nook_result nook_transfer_light_desc_init(nook_transfer_light_desc* desc) {
  return nook_desc_init(NOOK_DESC_TRANSFER_LIGHT, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates a light. Nook copies what it needs, so you may free the map and destroy the probe afterwards. On
 * failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT (also if a texel is out of range),
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_light_create(nook_context context, const nook_transfer_light_desc* desc,
                                                nook_transfer_light* out);

/* Releases your reference and sets *light to NULL.
 * Any thread. */
NOOK_API void nook_transfer_light_destroy(nook_transfer_light* light);

typedef struct nook_transfer_sun {
  /* Unit vector towards the sun, in the map's space. */
  float direction[3];
  /* RGB irradiance on a surface that faces the sun. */
  float irradiance[3];
  /* Steradians. */
  float solid_angle;
} nook_transfer_sun;

/* Writes the suns that split_suns removed, the brightest first. Set *count to the capacity of `suns`; the
 * call sets it to the number of suns. With `suns` NULL, the call only sets *count. If the capacity is too
 * small, the call fails, sets *count and writes no sun.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_transfer_light_read_suns(nook_transfer_light light, nook_transfer_sun* suns,
                                                   uint32_t* count);

/* The error of the lobes that represent a light. */
typedef struct nook_transfer_projection_info {
  uint32_t struct_size;
  /* sqrt(integral of the squared difference / integral of the squared light). */
  float relative_error;
  /* The integral of the negative part of the lobes' light, divided by the integral of its absolute value. */
  float negative_share;
} nook_transfer_projection_info;

/* Projects a light to lobes by least squares over the sphere. `amplitudes` receives lobe_count x RGB.
 * `lobe_count` is 12 to 2562, and must be the same as in the response and the transfer that you use.
 * `light_from_shape` is a rotation from the shape's space to the light's space, 9 floats row-major; NULL
 * means no rotation.
 *
 * The first call with a lobe_count factors a Gram matrix, which takes about lobe_count^3 / 6 multiply-adds.
 * The context keeps the matrix until you destroy the context. The matrix takes lobe_count^2 * 4 bytes (25 MiB
 * at 2562 lobes). Later calls with the same lobe_count only solve with this matrix. `info` may be NULL;
 * filling it takes about as long as the projection. It must be NULL for a light from a direction, because the
 * square of such a light has no integral. The call allocates with your allocator. Any thread. Errors:
 * INVALID_ARGUMENT (also if light_from_shape is not a rotation to 1e-3), OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_light_project(nook_transfer_light light, uint32_t lobe_count,
                                                 const float* light_from_shape, float* amplitudes,
                                                 nook_transfer_projection_info* info);

/* ---- Materials under lobes: immutable, shared by threads ---- */

typedef struct nook_transfer_response_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Required. You may destroy it after the call. */
  nook_material material;
  /* 12 to 2562; default 642. */
  uint32_t lobe_count;
  uint32_t reserved;
} nook_transfer_response_desc;
static inline nook_result nook_transfer_response_desc_init(nook_transfer_response_desc* desc) {
  return nook_desc_init(NOOK_DESC_TRANSFER_RESPONSE, desc, sizeof *desc, NOOK_VERSION);
}

/* Tabulates the response of a material to lobes from all directions, in about 0.2 s. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the material is neural), OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_response_create(nook_context context,
                                                   const nook_transfer_response_desc* desc,
                                                   nook_transfer_response* out);

/* Releases your reference and sets *response to NULL.
 * Any thread. */
NOOK_API void nook_transfer_response_destroy(nook_transfer_response* response);

typedef struct nook_transfer_response_info {
  uint32_t struct_size;
  uint32_t lobe_count;
  /* The number of light modes of one channel: R_l of the material, rounded up to a multiple of 4. This number
   * is 4 * NOOK_LIGHT_VEC4_COUNT in the material's GLSL. */
  uint32_t light_modes;
  /* The number of floats in the vector of a vertex, 3 * light_modes. */
  uint32_t vector_floats;
  /* The bytes of the table of responses in memory. */
  uint64_t table_bytes;
  /* The share of light that the material reflects under uniform light, RGB, 0 to 1. */
  float reflectance[3];
  /* 0. */
  uint32_t reserved;
} nook_transfer_response_info;

/* Describes a response.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_transfer_response_describe(nook_transfer_response response,
                                                     nook_transfer_response_info* info);

typedef struct nook_transfer_vectors_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The baked shape. If NULL (default), the vertices have no baked visibility and receive all light above
   * their horizon. This is enough for a small object that a probe lights. */
  nook_transfer transfer;
  /* lobe_count x RGB from nook_transfer_light_project, finite numbers whose magnitude is at most 1e22;
   * required. `lobe_count` must be the same as in the response and the transfer. */
  const float* amplitudes;
  uint32_t lobe_count;
  /* With a transfer: the first vertex to write. Default 0. */
  uint32_t first_vertex;
  /* Only without a transfer, and then required: unit normals (3 floats each) and tangents (4 floats each, the
   * handedness last). Default NULL. */
  const float* normals;
  const float* tangents;
} nook_transfer_vectors_desc;
static inline nook_result nook_transfer_vectors_desc_init(nook_transfer_vectors_desc* desc) {
  return nook_desc_init(NOOK_DESC_TRANSFER_VECTORS, desc, sizeof *desc, NOOK_VERSION);
}

/* Writes the vectors of `vertex_count` vertices under a light. Call this function when the light changes or
 * the shape rotates. `stride_floats` is the number of floats from one vertex to the next; 0 means
 * vector_floats of nook_transfer_response_info. The call uses the context's parallel_for if you set one; the
 * result does not depend on it. The call allocates 16 bytes per lobe. In the paper's form, it also allocates
 * 3 * light_modes * vertex rank floats per cluster (2.2 KiB at 16 modes). Without a transfer, it also
 * allocates the frames of the vertices. Any thread. Errors: INVALID_ARGUMENT (also if in the paper's form the
 * response belongs to another material), OUT_OF_MEMORY. */
NOOK_API nook_result nook_transfer_read_vectors(nook_transfer_response response,
                                                const nook_transfer_vectors_desc* desc, float* vectors,
                                                uint32_t vertex_count, uint32_t stride_floats);

/* Computes the radiance (linear RGB) of material pixels from one vector of `vector_floats` floats per pixel.
 * The call ignores the field `light` of a pixel, and decodes with one fetch. Use it to check your shader; it
 * gives the reference values for the GLSL of nook_gl_upload_transfer. Any thread. Errors: INVALID_ARGUMENT
 * (also if vector_floats does not fit the material, or a number is not finite). */
NOOK_API nook_result nook_transfer_shade(nook_material material, const nook_material_pixel* pixels,
                                         const float* vectors, uint32_t vector_floats, uint32_t count,
                                         float* radiance);

/* ---- In shaders ----
 *
 * An upload (nook_gl.h) stores the vectors of a shape's vertices. Its GLSL lights a material with them.
 *
 * Call nook_gl_upload_transfer once for a shape, and nook_gl_update_transfer when the light changes or the
 * shape rotates. Put the GLSL of nook_gl_upload_describe after the #version line of the vertex shader, and
 * after the material's GLSL in the fragment shader. For each draw, call nook_gl_upload_bind. The vertex
 * shader:
 *     out vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT];
 *     nook_transfer_vectors(gl_VertexID, vectors);
 * The fragment shader:
 *     vec3 view = nook_transfer_tangent_space(normal, tangent, normalize(eye - position));
 *     vec4 modes[NOOK_LIGHT_VEC4_COUNT];
 *     nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);
 *     colour = max(nook_transfer_radiance(modes, vectors), 0.0);
 * With 16 light modes, the vectors take 12 of the 15 varyings that every OpenGL 3.3 supports. For a material
 * with more light modes, use nook_transfer_mix in the fragment shader instead. You can also upload the floats
 * of nook_transfer_read_vectors as your own vertex attributes, and call the same nook_transfer_radiance. */

/* Creates an upload for a transfer and a response. It is black until you call nook_gl_update_transfer. With a
 * transfer in the default form, or with `transfer` NULL and `vertex_count` vertices of your own, the upload
 * holds vectors. With a transfer in the paper's form, the upload holds the compressed data of the vertices,
 * and the GLSL function nook_transfer_vectors mixes the matrices of their clusters. `vertex_count` is read
 * only if `transfer` is NULL. You may destroy transfer and response afterwards. The GLSL depends only on the
 * number of light modes; in the paper's form, also on the numbers of clusters, ranks and bounces. On failure
 * *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT (also if light modes or lobes of the paper's form and of the
 * response differ), UNSUPPORTED (a table exceeds the texture buffer of this OpenGL, which has at least 65,536
 * texels; vectors take vertex_count * vector_floats / 4 texels), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_upload_transfer(nook_gl gl, nook_transfer transfer,
                                             nook_transfer_response response, uint32_t vertex_count,
                                             nook_gl_upload* out);

/* Sets the light of an upload of nook_gl_upload_transfer. If the upload holds vectors, pass vertex_count x
 * vector_floats without gaps, as nook_transfer_read_vectors writes them. In the paper's form, pass the
 * amplitudes of the lobes, lobe_count x RGB; the CPU computes the matrices of the clusters from them, using
 * the context's parallel_for. Draws that you issued before the call still use the old light. The call does
 * not wait for the GPU.
 * Context thread. Errors: INVALID_ARGUMENT (also if float_count does not fit the upload), GL,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_update_transfer(nook_gl_upload upload, const float* values,
                                             uint64_t float_count);

#ifdef __cplusplus
}
#endif
#endif
