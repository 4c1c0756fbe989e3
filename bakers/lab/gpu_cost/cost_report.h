// Counts all shaders and passes of a source tree, or reads the counts of an earlier run from a report file.
// Prints the table, and compares two reports.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/lab/gpu_cost/shader_cost.h"

namespace nook::lab {

struct PassCost {
  std::string pass;
  Cycles cycles;
};

struct FamilyCost {
  std::string family;
  std::vector<ShaderCost> shaders;
  std::vector<PassCost> passes;
};

struct CostReport {
  std::string driver;
  std::vector<FamilyCost> families;

  // Returns one line for each shader that could not be counted, with the reason. Returns an empty string if
  // all were counted.
  std::string errors() const;
};

// Counts the shaders whose name contains `only`. A pass is reported only if all of its shaders are counted.
CostReport count_tree(const SourceTree& tree, const std::vector<std::string>& families,
                      const std::string& only);

// Writes each row on its own line, so that a changed shader is one changed line in a diff.
std::string report_text(const CostReport& report);
CostReport from_json(const nlohmann::json& json);

std::string cost_table(const CostReport& report);

struct Comparison {
  std::string text;
  std::vector<std::string> above_limit;  // shaders whose cycles grew by more than the limit
  std::vector<std::string> unmatched;    // shaders and passes that exist in only one report
};

// Compares the cycles of every shader and pass that exists in both reports, for each family.
Comparison compare(const CostReport& before, const CostReport& after, double limit);

}  // namespace nook::lab
