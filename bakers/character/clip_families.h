// Which clips are parts of one motion, as far as their names tell.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nook::bake {

// Returns the family of each clip: the first word of its name in lower case. A word ends at anything that is
// not a letter and before a capital that begins another: Jump_Land, JumpStart, jump.002 and JUMP 3 are all of
// "jump". What stands before the last | or : is the name of an armature or of a namespace and does not count,
// and neither does what all names begin with, up to a byte that is no letter: Robot_Walk and Robot_Run are of
// "walk" and "run". Names without a letter say nothing, so that all of them are one family, whose name is
// empty.
std::vector<std::string> clip_families(std::span<const std::string_view> names);

}  // namespace nook::bake
