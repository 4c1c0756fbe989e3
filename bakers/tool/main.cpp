// nook: bakes, measures and inspects what the runtime loads.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>
#include <sstream>

#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/tool_error.h"
#include "platform/printable.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/version.h"

namespace {

int run(int argc, char** argv) {
  CLI::App tool(
      "Bakes ambient occlusion, light probes, materials and radiance transfer, measures them against ray "
      "tracing, and inspects .nook files.\n"
      "Exit codes: 0 done, 2 bad arguments, 3 bad input, 1 anything else.",
      "nook");
  tool.set_version_flag("--version", nook::version_text);
  tool.require_subcommand(1);
  CLI::App* bake = tool.add_subcommand("bake", "make .nook files")->require_subcommand(1);
  CLI::App* evaluate =
      tool.add_subcommand("evaluate", "measure .nook files against ray tracing")->require_subcommand(1);
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
  nook::tool::add_evaluate_grid(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_probe(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_material(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_transfer(nook::tool::Command(*evaluate));
  nook::tool::add_evaluate_world(nook::tool::Command(*evaluate));
  CLI::App* train = tool.add_subcommand("train", "train networks")->require_subcommand(1);
  nook::tool::add_train_bent(nook::tool::Command(*train));
  nook::tool::add_train_nnao(nook::tool::Command(*train));
  nook::tool::add_train_specular(nook::tool::Command(*train));
  CLI::App* write =
      tool.add_subcommand("export", "write what .nook files hold for other engines")->require_subcommand(1);
  nook::tool::add_export_casters(nook::tool::Command(*write));
  nook::tool::add_inspect(nook::tool::Command(tool));
  nook::tool::add_report(nook::tool::Command(tool));
  try {
    tool.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    std::ostringstream out, error;
    const bool done = tool.exit(e, out, error) == 0;
    std::fputs(platform::printable_lines(out.str()).c_str(), stdout);
    std::fputs(platform::printable_lines(error.str()).c_str(), stderr);
    return done ? nook::tool::exit_done : nook::tool::exit_bad_arguments;
  }
  return nook::tool::exit_done;
}

}  // namespace

int main(int argc, char** argv) {
  nook::tool::watch_for_interrupt();
  const auto fail = [](int code, const char* text) {
    std::fprintf(stderr, "nook: %s\n", platform::printable_lines(text).c_str());
    return code;
  };
  try {
    return run(argc, argv);
  } catch (const nook::tool::ToolError& e) {
    return fail(e.code(), e.what());
  } catch (const nook::Failure& e) {
    return fail(nook::tool::exit_code_of(e.code()), e.what());
  } catch (const std::bad_alloc&) {
    return fail(nook::tool::exit_other, "not enough memory; use fewer poses, or a smaller preset");
  } catch (const std::exception& e) {
    return fail(nook::tool::exit_other, e.what());
  }
}
