// Copies texels as the bits of their floats. Every OpenGL can read back these integers exactly. OpenGL ES
// cannot read back depth or floats.
uniform sampler2D nook_image;
uniform ivec2 nook_first;  // the texel that is copied to the lower left pixel of the target

out uvec4 nook_out;

void main() {
  nook_out = floatBitsToUint(texelFetch(nook_image, ivec2(gl_FragCoord.xy) + nook_first, 0));
}
