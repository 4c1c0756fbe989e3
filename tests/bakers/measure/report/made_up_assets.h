// Assets of every state, as a studio would have them, with hostile names among them.
#pragma once

#include <vector>

#include "bakers/measure/report/overview.h"

std::vector<nook::report::Asset> made_up_assets(std::size_t count);

// A page of them, compared with an earlier page.
nook::report::Overview made_up_overview(std::size_t count);
