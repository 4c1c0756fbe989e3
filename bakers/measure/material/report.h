// A compression in the tables of the measurements.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/measure/material/comparison.h"

namespace nook::bake::material {

// The row of baked_figures.h with all that was measured besides.
nlohmann::ordered_json report_row(const std::string& material, const MethodRow& row);

}  // namespace nook::bake::material
