// nook-lab: compares Nook with other methods, and writes the tables of the documents.
#include <CLI/CLI.hpp>

#include "bakers/lab/tool/commands.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/program.h"

namespace {

void add_commands(CLI::App& lab) {
  CLI::App* evaluate = lab.add_subcommand("evaluate", "measure Nook and other methods against ray tracing")
                           ->require_subcommand(1);
  nook::lab::add_evaluate_nnao(nook::tool::Command(*evaluate));
}

}  // namespace

int main(int argc, char** argv) {
  return nook::tool::run_program(
      argc, argv, "nook-lab",
      "Compares Nook with other methods on the scenes and characters of the documents.\n"
      "Exit codes: 0 done, 2 bad arguments, 3 bad input, 1 anything else.",
      add_commands);
}
