// Fetches from the host's images. They are 2D textures or one layer of texture arrays, with or without
// multisampling.
#include "shaders/nnao/frame.glsl"
#ifdef NOOK_LAYERS
#define NOOK_HOST_IMAGE sampler2DArray
#define NOOK_HOST_SAMPLES sampler2DMSArray
#define nook_host_place(pixel) ivec3((pixel) + nook_origin, nook_array_layer)
#else
#define NOOK_HOST_IMAGE sampler2D
#define NOOK_HOST_SAMPLES sampler2DMS
#define nook_host_place(pixel) ((pixel) + nook_origin)
#endif
#define nook_host_texel(image, pixel) texelFetch(image, nook_host_place(pixel), 0)
#define nook_host_sample(image, pixel, number) texelFetch(image, nook_host_place(pixel), number)
