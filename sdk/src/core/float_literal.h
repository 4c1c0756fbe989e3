// Numbers in the text of shaders.
#pragma once

namespace nook {

// Holds the longest text, -1.17549435e-38, and the zero at its end.
struct FloatLiteral {
  char text[16];
};

// Returns the shortest literal of GLSL that is read as the same float, such as 1.5e-01: the text of
// std::to_chars in its scientific format. libc++ 13 has no std::to_chars for floats, and printf writes the
// decimal sign of the host's locale. The value must be finite.
FloatLiteral float_literal(float value);

}  // namespace nook
