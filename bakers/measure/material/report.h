// The description of a compression in files and reports.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/measure/material/comparison.h"

namespace nook::bake::material {

// One row of the tables, with the most memory that the process has held so far.
nlohmann::ordered_json report_row(const std::string& material, const MethodRow& row);

nlohmann::ordered_json describe(const CompressionSettings& settings);

}  // namespace nook::bake::material
