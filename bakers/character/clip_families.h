// Which clips are parts of one motion, as far as their names tell.
#pragma once

#include <string>
#include <string_view>

namespace nook::bake {

// The family of a clip: the first word of its name in lower case. A word ends at anything that is not a
// letter and before a capital that begins another: Jump_Land, JumpStart, jump.002 and JUMP 3 are all of
// "jump". What stands before the last | or : is the name of an armature or of a namespace and does not count.
// Names without a letter say nothing, so that all of them are one family, whose name is empty.
std::string clip_family(std::string_view name);

}  // namespace nook::bake
