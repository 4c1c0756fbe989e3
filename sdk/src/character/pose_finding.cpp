#include "sdk/src/character/pose_finding.h"

#include <cstdarg>
#include <cstdio>

namespace nook {

void say(PoseFinding& finding, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(finding.text, sizeof finding.text, format, arguments);
  va_end(arguments);
}

}  // namespace nook
