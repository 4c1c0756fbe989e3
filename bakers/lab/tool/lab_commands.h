// Declares the subcommands of nook-lab, in the same way as bakers/tool/commands.h.
#pragma once

namespace nook::tool {
class Command;
}

namespace nook::lab {

void add_evaluate_grid(tool::Command evaluate);
void add_evaluate_material(tool::Command evaluate);
void add_evaluate_nnao(tool::Command evaluate);
void add_evaluate_probe(tool::Command evaluate);

}  // namespace nook::lab
