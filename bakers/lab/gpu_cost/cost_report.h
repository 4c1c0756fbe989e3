// Counts all shaders and passes of a tree, or reads them from the file of an earlier run. Prints the table,
// and compares two reports.
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

  // Returns a line with the reason for each shader without numbers; empty if there is none.
  std::string errors() const;
};

// Counts the shaders whose name contains `only`. A pass needs all of its shaders.
CostReport count_tree(const SourceTree& tree, const std::vector<std::string>& families,
                      const std::string& only);

// A row is a line, so that a changed shader is a changed line.
std::string report_text(const CostReport& report);
CostReport from_json(const nlohmann::json& json);

std::string cost_table(const CostReport& report);

struct Comparison {
  std::string text;
  std::vector<std::string> above_limit;  // shaders whose cycles grew by more than the limit
  std::vector<std::string> unmatched;    // shaders and passes that only one report has
};

// Returns the ratio of the cycles of every shader and pass in both reports, by family.
Comparison compare(const CostReport& before, const CostReport& after, double limit);

}  // namespace nook::lab
