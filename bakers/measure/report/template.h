// The templates of this folder's templates/, which are embedded at build.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "bakers/measure/report/html.h"

namespace nook::report {

struct Template {
  const char* name;  // the file's
  const char* text;
};
const Template* templates_begin();
const Template* templates_end();

// Replaces each {{name}} of a template by its value. Values are not looked at, so that a value with braces
// stays what it is. Throws Failure(INTERNAL) for a template or a name that is not there.
Html fill(std::string_view template_name, const std::vector<std::pair<std::string_view, Html>>& values);

}  // namespace nook::report
