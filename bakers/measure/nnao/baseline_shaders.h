// The shaders of the folder shaders/, with their includes expanded; made at build time.
#pragma once

namespace nook::measure {

struct EmbeddedShader {
  const char* path;  // relative to shaders/
  const char* text;
};
const EmbeddedShader* embedded_shaders_begin();
const EmbeddedShader* embedded_shaders_end();

}  // namespace nook::measure
