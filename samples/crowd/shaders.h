// The sample's own shaders, OpenGL 3.3 core.
#pragma once

namespace crowd {

// Characters: linear blend skinning with bones in a texture buffer, three texels a bone. ao is Nook's value;
// light_value is irradiance for kGivenLightFragment, Nook's directional AO for kProbeLightFragment.
extern const char* const kCharacterVertex;
// One big quad on y = 0, made from gl_VertexID.
extern const char* const kGroundVertex;
// Ahead of the lighting, for the screen-space pass: world normals as (n + 1) / 2, and its layer, which is 1
// everywhere with a weight that is 1 on characters alone.
extern const char* const kSurfaceFragment;
// The first line of a fragment shader of several texts.
extern const char* const kVersion;
// What fragments read of the screen-space pass, for the two that follow.
extern const char* const kScreenAo;
// Behind #version and kScreenAo: hemisphere ambient times AO, and a key light with a soft shadow map. Writes
// linear light to an sRGB target. AO is that of the vertices, where use_screen_ao is set times that of the
// screen-space pass, and on the ground where use_floor_ao is set times that of a texture laid on it.
extern const char* const kLitFragment;
// Irradiance that is given, at vertices or in a texture laid on the ground, and nothing else; linear light to
// an sRGB target, bright parts rolled off.
extern const char* const kGivenLightFragment;
// Behind #version, GROUND for the ground, Nook's GLSL for lights, and kScreenAo: a probe's irradiance times
// directional AO, which the ground has in a texture laid on it and from the screen-space pass; linear light
// to an sRGB target, bright parts rolled off.
extern const char* const kProbeLightFragment;
// Depth from the key light; draws characters only.
extern const char* const kShadowFragment;

}  // namespace crowd
