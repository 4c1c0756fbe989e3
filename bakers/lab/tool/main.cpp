// nook-lab: compares Nook with other methods, and writes the tables of the documents.
#include <CLI/CLI.hpp>

#include "bakers/lab/character/character_peers.h"
#include "bakers/lab/tool/lab_commands.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/command_program.h"
#include "bakers/tool/peers.h"

namespace {

// The character methods to compare with: a linear pose model (Kontkanen & Aila 2006) and pose clusters (Kirk
// & Arikan 2007).
constexpr nook::measure::CharacterPeer character_peers[] = {
    {"linear_pose", [](const nook::bake::SkinnedMesh& mesh, std::span<const nook::bake::Pose> training,
                       const nook::bake::AoTargets& targets,
                       std::uint64_t) { return nook::lab::fit_linear_pose(mesh, training, targets); }},
    {"pose_clusters", nook::lab::fit_pose_clusters}};

void add_commands(CLI::App& lab) {
  CLI::App* evaluate =
      lab.add_subcommand("evaluate", "measure Nook and other methods against ray tracing, and compare them")
          ->require_subcommand(1);
  nook::tool::add_evaluate_character(nook::tool::Command(*evaluate), character_peers);
  nook::lab::add_evaluate_grid(nook::tool::Command(*evaluate));
  nook::lab::add_evaluate_material(nook::tool::Command(*evaluate));
  nook::lab::add_evaluate_nnao(nook::tool::Command(*evaluate));
  nook::lab::add_evaluate_probe(nook::tool::Command(*evaluate));
}

}  // namespace

int main(int argc, char** argv) {
  return nook::tool::run_program(
      argc, argv, "nook-lab",
      "Compares Nook with other methods, on the scenes and characters of the documents.\nExit codes: 0 "
      "success, 2 bad arguments, 3 bad input, 1 any other error.",
      add_commands);
}
