// The program `nook` bakes, measures and inspects the files that the runtime loads.
#include <CLI/CLI.hpp>

#include <initializer_list>

#include "bakers/tool/bake_cache.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/command_program.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/pinned_process.h"

namespace {

void add_commands(CLI::App& tool) {
  CLI::App* bake =
      tool.add_subcommand("bake",
                          "bake .nook files from characters, environment maps, scenes, materials and shapes")
          ->require_subcommand(1);
  CLI::App* evaluate =
      tool.add_subcommand("evaluate",
                          "measure .nook files against ray tracing.\n`nook-lab evaluate` also measures other "
                          "methods, for comparison; build it with -DNOOK_LAB=ON.")
          ->require_subcommand(1);
  nook::tool::add_bake_character(nook::tool::Command(*bake));
  nook::tool::add_bake_bent(nook::tool::Command(*bake));
  nook::tool::add_bake_clips(nook::tool::Command(*bake));
  nook::tool::add_bake_lod(nook::tool::Command(*bake));
  nook::tool::add_bake_probe(nook::tool::Command(*bake));
  nook::tool::add_bake_material(nook::tool::Command(*bake));
  nook::tool::add_bake_synthesis(nook::tool::Command(*bake));
  nook::tool::add_bake_transfer(nook::tool::Command(*bake));
  nook::tool::add_evaluate_character(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_bent(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_casters(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_clips(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_lods(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_nnao(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_probe(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_material(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_transfer(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_world(nook::tool::Command(*evaluate));
  CLI::App* train =
      tool.add_subcommand("train", "train the networks and fit the constants that are built into Nook")
          ->require_subcommand(1);
  nook::tool::add_train_bent(nook::tool::Command(*train));
  nook::tool::add_train_nnao(nook::tool::Command(*train));
  nook::tool::add_train_specular(nook::tool::Command(*train));
  CLI::App* write =
      tool.add_subcommand("export", "write parts of .nook files in the formats of other engines")
          ->require_subcommand(1);
  nook::tool::add_export_casters(nook::tool::Command(*write));
  CLI::App* cache =
      tool.add_subcommand("cache",
                          "remove old results from a cache, the folder that you give to a bake with --cache")
          ->require_subcommand(1);
  nook::tool::add_cache_prune(nook::tool::Command(*cache));
  nook::tool::add_plan(nook::tool::Command(tool));
  nook::tool::add_build(nook::tool::Command(tool));
  nook::tool::add_task(nook::tool::Command(tool));
  nook::tool::add_inspect(nook::tool::Command(tool));
  nook::tool::add_report(nook::tool::Command(tool));
}

// Lists the words that only nook-lab accepts, for comparisons with other methods. They are grouped by the
// most similar command of `nook`.
nook::tool::ElsewhereWords lab_words() {
  nook::tool::ElsewhereWords lab{"nook-lab", "(built with -DNOOK_LAB=ON)", {}};
  lab.words["evaluate"] = {"grid"};
  for (const char* command : {"evaluate character", "evaluate material", "evaluate probe", "evaluate nnao"})
    lab.words[command] = {"--peers"};
  const auto add = [&](const char* command, std::initializer_list<const char*> options) {
    lab.words[command].insert(lab.words[command].end(), options.begin(), options.end());
  };
  add("evaluate material", {"--methods", "--votf-refits", "--compare-seeding", "--sweep"});
  add("evaluate probe", {"--glossy", "--surfaces"});
  add("evaluate nnao",
      {"*",        "--views",      "--folder",   "--sources", "--thin",          "--tune",
       "--camera", "--cameras",    "--radius",   "--size",    "--max-radius-px", "--references",
       "--ratio",  "--rays",       "--temporal", "--mover",   "--bent-normals",  "--path-step",
       "--clip",   "--walk-speed", "--no-raw",   "--markdown"});
  return lab;
}

}  // namespace

int main(int argc, char** argv) {
  nook::tool::pin_process(argc, argv);
  return nook::tool::run_program(
      argc, argv, "nook",
      "Bakes ambient occlusion, light probes, materials and radiance transfer, measures them against ray "
      "tracing, and inspects .nook files.\nExit codes: 0 success, 2 bad arguments, 3 bad input, 4 a result "
      "that --strict refuses, 1 any other error.",
      add_commands, lab_words());
}
