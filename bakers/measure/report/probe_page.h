// The page of a light probe or of a grid of them.
#pragma once

#include "bakers/measure/report/page.h"
#include "bakers/raytrace/environment.h"
#include "sdk/src/probe/probe.h"

namespace nook::report {

// map: what a single probe was baked from; null: it is not compared. A grid takes none.
PageParts probe_parts(const probe::Probes& probes, const bake::Environment* map);

}  // namespace nook::report
