// The subcommands. main.cpp calls these functions, and each adds a command with its options to the parent.
// The command runs when the parent parses its arguments. It throws ToolError or Failure if it fails. The
// functions in peers.h add evaluations with additional methods.
#pragma once

namespace nook::tool {

class Command;

void add_bake_bent(Command bake);
void add_bake_character(Command bake);
void add_bake_clips(Command bake);
void add_bake_lod(Command bake);
void add_bake_probe(Command bake);
void add_bake_material(Command bake);
void add_bake_synthesis(Command bake);
void add_bake_transfer(Command bake);
void add_evaluate_bent(Command evaluate);
void add_evaluate_casters(Command evaluate);
void add_evaluate_character(Command evaluate);
void add_evaluate_clips(Command evaluate);
void add_evaluate_lods(Command evaluate);
void add_evaluate_material(Command evaluate);
void add_evaluate_nnao(Command evaluate);
void add_evaluate_probe(Command evaluate);
void add_evaluate_transfer(Command evaluate);
void add_evaluate_world(Command evaluate);
void add_train_bent(Command train);
void add_train_nnao(Command train);
void add_train_specular(Command train);
void add_export_casters(Command export_command);
void add_plan(Command tool);
void add_build(Command tool);
void add_task(Command tool);
void add_inspect(Command tool);
void add_report(Command tool);

}  // namespace nook::tool
