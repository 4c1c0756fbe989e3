// Reads the coordinate texture of a plane in a host's shader. Before this text,
// sdk/src/gl/material/material_textures.cpp writes the sizes. sdk/src/synthesis/coordinates.cpp has the same
// function.
uniform highp usampler2DArray nook_synthesis_texels;

// Returns the material's texture coordinates at the point uv of the plane. Both are in units of the
// material's tile. The result is not continuous, so compute derivatives and the mipmap level from uv instead.
vec2 nook_synthesis_material_uv(vec2 uv) {
  vec2 texels = uv * NOOK_SYNTHESIS_MATERIAL_TEXELS;
  vec2 whole = floor(texels);
  vec2 turn = whole - NOOK_SYNTHESIS_SIDE * floor(whole / NOOK_SYNTHESIS_SIDE);
  ivec2 at = clamp(ivec2(turn), ivec2(0), ivec2(int(NOOK_SYNTHESIS_SIDE) - 1));
  uvec2 cell = texelFetch(nook_synthesis_texels, ivec3(at, 0), 0).xy;
  return (vec2(cell) + texels - whole) / NOOK_SYNTHESIS_MATERIAL_TEXELS;
}
