// The texts of all shader files, compiled into the library. embed_shaders.cmake generates them from shaders/
// at build time.
#pragma once

namespace nook::gl {

struct EmbeddedShader {
  const char* path;  // relative to shaders/, such as "character/shadow.comp"
  const char* text;  // with expanded includes, without #version
};

const EmbeddedShader* embedded_shaders_begin();
const EmbeddedShader* embedded_shaders_end();

}  // namespace nook::gl
