// `nook plan` decides which of many assets have to be baked, and writes this plan for Ninja and for farms.
#include <memory>

#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/plan/planning.h"

namespace nook::tool {

void add_plan(Command tool) {
  const Command command =
      tool.add_subcommand("plan",
                          "find out which of many assets have to be baked.\nReads a manifest, compares the "
                          "key of each bake with the key in its output, copies results from the cache, and "
                          "writes build.ninja and tasks.txt for the rest.");
  const auto options = std::make_shared<plan::PlanOptions>();
  plan::add_plan_options(command, *options);
  command.add_flag("--dry-run", options->dry_run, "only print what would run and why, and write nothing");
  command.callback([options] { plan::make_plan(*options); });
}

}  // namespace nook::tool
