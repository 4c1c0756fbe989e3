// The text of every shader file, compiled into the library. embed_shaders.cmake makes it from shaders/ at
// build time.
#pragma once

namespace nook::gl {

struct EmbeddedShader {
  const char* path;  // below shaders/, such as "character/shadow.comp"
  const char* text;  // with expanded includes, without #version
};

const EmbeddedShader* embedded_shaders_begin();
const EmbeddedShader* embedded_shaders_end();

}  // namespace nook::gl
