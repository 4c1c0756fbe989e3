// Checks the types of those members of a glTF document that affect shapes and poses.
#pragma once

#include <nlohmann/json.hpp>

namespace nook::bake {

// Fails with BAD_FILE if a member has a wrong type, for example if a scale is a string. The message names the
// member. The parser would silently ignore such a member, and the shape or pose would be wrong. A member that
// is null is treated as missing. glTF 2.0 allows integers to be written with a decimal point (1.0). The
// function converts these to integers, and returns true if it found any. It does not check other members. The
// time is linear in the document.
bool require_member_types(nlohmann::json& document);

}  // namespace nook::bake
