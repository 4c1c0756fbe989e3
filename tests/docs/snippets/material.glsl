// The sizes of a material, as sdk/src/gl/material/material_glsl.cpp writes them.
#define NOOK_LIGHT_VEC4_COUNT 4
#define NOOK_MATERIAL_MAX_FETCHES 8
#define NOOK_BTF_TERMS 3
#define NOOK_BTF_VIEW_VEC4_COUNT 1
#define NOOK_BTF_CLUSTERS 20
#define NOOK_BTF_SIDE 64
#define NOOK_BTF_BLENDED 1
#define NOOK_BTF_TEXELS vec2(96.0, 96.0)
#define NOOK_VOTF_TERMS 3
#define NOOK_VOTF_VIEW_VEC4_COUNT 1
#define NOOK_VOTF_CLUSTERS 20
#define NOOK_VOTF_SIDE 64
#define NOOK_VOTF_BLENDED 1
#define NOOK_VOTF_TEXELS vec2(96.0, 96.0)
uniform sampler2DArray nook_btf_coefficients, nook_votf_coefficients, nook_light_map;
uniform usampler2DArray nook_btf_membership, nook_votf_membership;
uniform vec2 nook_visibility_mapping;
vec4 nook_btf_mode(int cluster, int mode, vec2 uv, float level);
vec4 nook_votf_mode(int cluster, int mode, vec2 uv, float level);
#include "shaders/material/base/host.glsl"

vec4 nook_btf_mean(int cluster, int mode, NookMaterialFetches at);
NookMaterialTerms nook_btf_terms(vec2 place, ivec2 cell);
int nook_btf_cluster(inout NookMaterialTerms terms, int k);
vec4 nook_btf_weights(NookMaterialTerms terms, int k, int b);
vec4 nook_votf_mean(int cluster, int mode, NookMaterialFetches at);
NookMaterialTerms nook_votf_terms(vec2 place, ivec2 cell);
int nook_votf_cluster(inout NookMaterialTerms terms, int k);
vec4 nook_votf_weights(NookMaterialTerms terms, int k, int b);
#include "shaders/material/host.glsl"
