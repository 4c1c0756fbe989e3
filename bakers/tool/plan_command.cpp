// `nook plan` decides which of many assets have to be baked, and writes this plan for Ninja and for farms.
#include <memory>

#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/plan/planning.h"

namespace nook::tool {

void add_plan(Command tool) {
  const Command command =
      tool.add_subcommand("plan",
                          "find out which of many assets have to be baked.\nThe command reads a manifest, "
                          "and compares the key of each bake with the key in its output. It copies results "
                          "from the cache, and writes build.ninja and tasks.txt for the other bakes.");
  const auto options = std::make_shared<plan::PlanOptions>();
  plan::add_plan_options(command, *options);
  command.add_flag("--dry-run", options->dry_run, "write nothing; only print which bakes would run, and why");
  command.callback([options] { plan::make_plan(*options); });
}

}  // namespace nook::tool
