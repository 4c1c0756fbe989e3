// The host's images: 2D textures, or one layer of texture arrays.
#include "shaders/nnao/frame.glsl"
#ifdef NOOK_LAYERS
#define NOOK_HOST_IMAGE sampler2DArray
#define nook_host_texel(image, pixel) texelFetch(image, ivec3((pixel) + nook_origin, nook_array_layer), 0)
#else
#define NOOK_HOST_IMAGE sampler2D
#define nook_host_texel(image, pixel) texelFetch(image, (pixel) + nook_origin, 0)
#endif
