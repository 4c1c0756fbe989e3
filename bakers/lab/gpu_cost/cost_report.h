// All shaders and passes of a tree, or of a file that an earlier run wrote; the table, and the comparison of
// two.
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

  // Returns a line for each shader without numbers, with the reason; empty if there is none.
  std::string errors() const;
};

// Counts the shaders whose name contains `only`; passes need all of theirs.
CostReport count_tree(const SourceTree& tree, const std::vector<std::string>& families,
                      const std::string& only);

// A row is a line, so that a change of one shader is a change of one line.
std::string report_text(const CostReport& report);
CostReport from_json(const nlohmann::json& json);

std::string cost_table(const CostReport& report);

struct Comparison {
  std::string text;
  std::vector<std::string> above_limit;  // shaders whose cycles grew by more than the limit
  std::vector<std::string> unmatched;    // shaders and passes that only one of both has
};

// The ratio of the cycles of every shader and pass that both reports have, by family.
Comparison compare(const CostReport& before, const CostReport& after, double limit);

}  // namespace nook::lab
