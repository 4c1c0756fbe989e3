// Numbers in the text of shaders.
#pragma once

#include <charconv>

namespace nook::gl {

struct FloatLiteral {
  char text[24];
};

// Returns the shortest literal of GLSL that is read as the same float, such as 1.5e-01. printf's %g would
// write the decimal sign of the host's locale.
inline FloatLiteral float_literal(float value) {
  FloatLiteral literal{};
  std::to_chars(literal.text, literal.text + sizeof literal.text - 1, value, std::chars_format::scientific);
  return literal;
}

}  // namespace nook::gl
