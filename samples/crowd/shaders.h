// The sample's own shaders, for OpenGL 3.3 core. Fragment shaders write linear light to an sRGB target.
#pragma once

namespace crowd {

// Characters: linear blend skinning with the bones in a texture buffer, three texels for each bone. The
// attribute ao is Nook's value. The attribute light_value is Nook's directional AO for kProbeLightFragment,
// and irradiance for kGivenLightFragment.
extern const char* const kCharacterVertex;
// The ground: one big quad on y = 0, made from gl_VertexID.
extern const char* const kGroundVertex;
// The surfaces that the screen-space pass reads: world normals as (n + 1) / 2, and the pass's layer. The
// layer is 1 everywhere, and its weight is 1 on characters and 0 elsewhere.
extern const char* const kSurfaceFragment;
// The first line of a fragment shader that has several texts.
extern const char* const kVersion;
// The function by which a fragment reads the result of the screen-space pass.
extern const char* const kScreenAo;
// Follows kVersion and kScreenAo: ambient light of two hemispheres times AO, and a key light with a soft
// shadow map. AO is that of the vertices. If use_screen_ao is set, it is multiplied by screen-space AO, and
// on the ground, if use_floor_ao is set, by a texture that lies on the ground.
extern const char* const kLitFragment;
// Irradiance that is given, at vertices or in a texture that lies on the ground. Bright parts are rolled off.
extern const char* const kGivenLightFragment;
// Follows kVersion, a definition of GROUND for the ground, Nook's GLSL for lights, and kScreenAo: a probe's
// irradiance times directional AO. On the ground the passes over the screen give that of soft light and the
// open share of the sun. Bright parts are rolled off.
extern const char* const kProbeLightFragment;
// The depth that the key light sees. Only characters are drawn with it.
extern const char* const kShadowFragment;

}  // namespace crowd
