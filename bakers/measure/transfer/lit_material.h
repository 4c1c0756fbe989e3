// A material's response to the lobes of baked transfer.
#pragma once

#include "sdk/src/material/tables.h"
#include "sdk/src/transfer/response.h"

namespace nook::measure {

nook::transfer::Response response_of(const nook::material::MaterialTables& tables, std::uint32_t lobes);

}  // namespace nook::measure
