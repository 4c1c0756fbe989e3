// Evaluations that measure other methods beside Nook's. `nook` adds none; `nook-lab` adds the methods of
// bakers/lab.
#pragma once

#include <span>

#include "bakers/measure/character/character_report.h"

namespace nook::tool {

class Command;

void add_evaluate_character(Command evaluate, std::span<const measure::CharacterPeer> peers = {});

}  // namespace nook::tool
