// `nook plan` decides which of many assets have to be baked, and writes this plan for Ninja and for farms.
#include <memory>

#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/plan/planning.h"

namespace nook::tool {

void add_plan(Command tool) {
  const Command command = tool.add_subcommand(
      "plan",
      "find out which assets of a project must be baked again.\nThe manifest lists the bakes. The command "
      "compares the key of each bake (see --print-key of `nook bake`) with the key that is stored in its "
      "output. It copies results that the cache contains. For the other bakes, it writes build.ninja (for "
      "Ninja) and tasks.txt (one command per line).");
  const auto options = std::make_shared<plan::PlanOptions>();
  plan::add_plan_options(command, *options);
  command.add_flag("--dry-run", options->dry_run,
                   "do not write a plan or copy results; only print which bakes would run, and why");
  command.callback([options] { plan::make_plan(*options); });
}

}  // namespace nook::tool
