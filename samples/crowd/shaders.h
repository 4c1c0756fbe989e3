// The sample's own shaders, OpenGL 3.3 core.
#pragma once

namespace crowd {

// Characters: linear blend skinning with bones in a texture buffer, three texels a bone. ao is Nook's value.
extern const char* const kCharacterVertex;
// One big quad on y = 0, made from gl_VertexID.
extern const char* const kGroundVertex;
// Hemisphere ambient times AO, and a key light with a soft shadow map. Writes linear light to an sRGB target.
extern const char* const kLitFragment;
// Depth from the key light; draws characters only.
extern const char* const kShadowFragment;

}  // namespace crowd
