// The subcommands. Each adds itself, with its options, to its parent and runs when the parent is parsed; it
// ends by returning or by throwing ToolError or Failure.
#pragma once

namespace CLI {
class App;
}

namespace nook::tool {

void add_bake_bent(CLI::App& bake);
void add_bake_character(CLI::App& bake);
void add_bake_clips(CLI::App& bake);
void add_bake_lod(CLI::App& bake);
void add_bake_probe(CLI::App& bake);
void add_bake_material(CLI::App& bake);
void add_bake_synthesis(CLI::App& bake);
void add_bake_transfer(CLI::App& bake);
void add_evaluate_bent(CLI::App& evaluate);
void add_evaluate_character(CLI::App& evaluate);
void add_evaluate_casters(CLI::App& evaluate);
void add_evaluate_clips(CLI::App& evaluate);
void add_evaluate_lods(CLI::App& evaluate);
void add_evaluate_nnao(CLI::App& evaluate);
void add_evaluate_grid(CLI::App& evaluate);
void add_evaluate_probe(CLI::App& evaluate);
void add_evaluate_material(CLI::App& evaluate);
void add_evaluate_transfer(CLI::App& evaluate);
void add_evaluate_world(CLI::App& evaluate);
void add_train_bent(CLI::App& train);
void add_train_nnao(CLI::App& train);
void add_train_specular(CLI::App& train);
void add_export_casters(CLI::App& export_command);
void add_inspect(CLI::App& tool);
void add_report(CLI::App& tool);

}  // namespace nook::tool
