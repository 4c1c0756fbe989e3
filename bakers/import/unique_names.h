// Names that can be looked up: never empty, never twice.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nook::bake {

// An empty name becomes `stem` and its index ("clip_0"); one that came before gets the first free suffix
// "_2", "_3", ...
std::vector<std::string> unique_names(const std::vector<std::string>& names, std::string_view stem);

}  // namespace nook::bake
