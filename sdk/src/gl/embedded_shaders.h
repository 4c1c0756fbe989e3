// The text of every shader file, compiled into the library; made from shaders/ at build by
// embed_shaders.cmake.
#pragma once

namespace nook::gl {

struct EmbeddedShader {
  const char* path;  // below shaders/, such as "character/shadow.comp"
  const char* text;  // includes expanded, without #version
};

const EmbeddedShader* embedded_shaders_begin();
const EmbeddedShader* embedded_shaders_end();

}  // namespace nook::gl
