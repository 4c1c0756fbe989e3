// The types of the members of a glTF document that decide shapes and poses.
#pragma once

#include <nlohmann/json.hpp>

namespace nook::bake {

// Fails with BAD_FILE on a member of a wrong type, such as a scale that is a string, and names it. The parser
// would leave such a member out without a word, so that the file would show something else. null counts as
// absent. Whole numbers that are written as fractions (1.0), which glTF 2.0 allows, become integers; returns
// whether there were some. Other members stay unchecked. The time is linear in the document.
bool require_member_types(nlohmann::json& document);

}  // namespace nook::bake
