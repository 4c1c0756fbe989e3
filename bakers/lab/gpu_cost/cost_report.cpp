#include "bakers/lab/gpu_cost/cost_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

namespace nook::lab {
namespace {

// The text of a table line. Longer lines are truncated.
using Line = std::array<char, 300>;

// A column of the report that holds an instruction count.
struct Column {
  const char* key;
  InstructionClass counted;
};
constexpr Column columns[] = {{"valu", InstructionClass::vector},
                              {"transcendental", InstructionClass::quarter_rate},
                              {"texture", InstructionClass::fetch},
                              {"stores", InstructionClass::store},
                              {"local_memory", InstructionClass::local_memory},
                              {"scalar", InstructionClass::scalar},
                              {"scalar_loads", InstructionClass::scalar_load}};

const ShaderCost* find(const std::vector<ShaderCost>& shaders, const std::string& name) {
  const auto found = std::find_if(shaders.begin(), shaders.end(),
                                  [&](const ShaderCost& cost) { return cost.shader == name; });
  return found == shaders.end() || !found->error.empty() ? nullptr : &*found;
}

std::vector<PassCost> pass_costs(const std::vector<ShaderCost>& shaders) {
  std::vector<PassCost> costs;
  for (const PassCase& pass : all_passes()) {
    PassCost cost{pass.name, {}};
    const bool known = std::all_of(pass.shaders.begin(), pass.shaders.end(), [&](const auto& part) {
      const ShaderCost* shader = find(shaders, part.first);
      if (!shader) return false;
      cost.cycles.alu += part.second * shader->cycles().alu;
      cost.cycles.texture += part.second * shader->cycles().texture;
      return true;
    });
    if (known) costs.push_back(cost);
  }
  return costs;
}

double rounded(double value) {
  return double(std::int64_t(100 * value + 0.5)) / 100;
}

struct NamedCycles {
  std::string name;
  double cycles;
};

std::vector<NamedCycles> named_cycles(const FamilyCost& family) {
  std::vector<NamedCycles> cycles;
  for (const ShaderCost& shader : family.shaders)
    if (shader.error.empty()) cycles.push_back({shader.shader, shader.cycles().all()});
  for (const PassCost& pass : family.passes) cycles.push_back({"pass " + pass.pass, pass.cycles.all()});
  return cycles;
}

const NamedCycles* find(const std::vector<NamedCycles>& cycles, const std::string& name) {
  const auto found = std::find_if(cycles.begin(), cycles.end(),
                                  [&](const NamedCycles& other) { return other.name == name; });
  return found == cycles.end() ? nullptr : &*found;
}

void compare_family(Comparison& comparison, const FamilyCost& before, const FamilyCost& after, double limit) {
  Line line;
  const std::vector<NamedCycles> old = named_cycles(before), now = named_cycles(after);
  const auto unmatched = [&](const std::string& name, const char* where) {
    std::snprintf(line.data(), line.size(), "%-9s %-52s only in the %s one\n", after.family.c_str(),
                  name.c_str(), where);
    comparison.text += line.data();
    comparison.unmatched.push_back(after.family + ": " + name);
  };
  for (const NamedCycles& shader : now) {
    const NamedCycles* was = find(old, shader.name);
    if (!was) {
      unmatched(shader.name, "new");
      continue;
    }
    // The maximum avoids a division by 0. Real shaders always have cycles.
    const double ratio = shader.cycles / std::max(was->cycles, 1.0);
    const bool above = ratio > limit;
    std::snprintf(line.data(), line.size(), "%-9s %-52s %10.1f %10.1f %8.3f%s\n", after.family.c_str(),
                  shader.name.c_str(), was->cycles, shader.cycles, ratio, above ? "  above the limit" : "");
    comparison.text += line.data();
    if (above) comparison.above_limit.push_back(after.family + ": " + shader.name);
  }
  for (const NamedCycles& was : old)
    if (!find(now, was.name)) unmatched(was.name, "old");
}

nlohmann::json to_json(const CostReport& report) {
  nlohmann::json json = {{"driver", report.driver}, {"rows", nlohmann::json::array()}};
  for (const FamilyCost& family : report.families) {
    for (const ShaderCost& shader : family.shaders) {
      if (!shader.error.empty()) continue;
      nlohmann::json row = {{"shader", shader.shader}, {"family", family.family}};
      for (const Column& column : columns) row[column.key] = rounded(shader.counts[column.counted]);
      row["registers"] = shader.vector_registers;
      row["scalar_registers"] = shader.scalar_registers;
      row["waves"] = shader.waves;
      row["code_bytes"] = shader.code_bytes;
      row["alu_cycles"] = rounded(shader.cycles().alu);
      row["texture_cycles"] = rounded(shader.cycles().texture);
      json["rows"].push_back(std::move(row));
    }
    for (const PassCost& pass : family.passes)
      json["passes"].push_back({{"pass", pass.pass},
                                {"family", family.family},
                                {"alu_cycles", rounded(pass.cycles.alu)},
                                {"texture_cycles", rounded(pass.cycles.texture)}});
  }
  return json;
}

}  // namespace

std::string CostReport::errors() const {
  std::string lines;
  for (const FamilyCost& family : families)
    for (const ShaderCost& shader : family.shaders)
      if (!shader.error.empty()) lines += family.family + ": " + shader.shader + ": " + shader.error + "\n";
  return lines;
}

CostReport count_tree(const SourceTree& tree, const std::vector<std::string>& families,
                      const std::string& only) {
  CostReport report;
  for (const std::string& family : families) {
    NullDevice device(family);
    report.driver = device.driver();
    FamilyCost cost{family, {}, {}};
    for (const ShaderCase& shader : all_shaders())
      if (shader.name.find(only) != std::string::npos)
        cost.shaders.push_back(shader_cost(device, family, tree, shader));
    cost.passes = pass_costs(cost.shaders);
    report.families.push_back(std::move(cost));
  }
  return report;
}

std::string report_text(const CostReport& report) {
  const nlohmann::json json = to_json(report);
  std::string text = "{\"driver\": " + json["driver"].dump();
  for (const char* list : {"passes", "rows"}) {
    text += std::string(",\n\"") + list + "\": [";
    const char* separator = "\n";
    for (const nlohmann::json& row : json.value(list, nlohmann::json::array())) {
      text += separator + row.dump();
      separator = ",\n";
    }
    text += "]";
  }
  return text + "}\n";
}

CostReport from_json(const nlohmann::json& json) {
  CostReport report;
  report.driver = json.at("driver");
  const auto family_of = [&](const nlohmann::json& row) -> FamilyCost& {
    const std::string name = row.at("family");
    for (FamilyCost& family : report.families)
      if (family.family == name) return family;
    return report.families.emplace_back(FamilyCost{name, {}, {}});
  };
  for (const nlohmann::json& row : json.at("rows")) {
    ShaderCost cost;
    cost.shader = row.at("shader");
    for (const Column& column : columns) cost.counts[column.counted] = row.at(column.key);
    cost.vector_registers = row.at("registers");
    cost.scalar_registers = row.at("scalar_registers");
    cost.waves = row.at("waves");
    cost.code_bytes = row.at("code_bytes");
    family_of(row).shaders.push_back(std::move(cost));
  }
  if (json.contains("passes"))
    for (const nlohmann::json& row : json.at("passes"))
      family_of(row).passes.push_back({row.at("pass"), {row.at("alu_cycles"), row.at("texture_cycles")}});
  return report;
}

std::string cost_table(const CostReport& report) {
  Line line;
  std::string out = report.driver + "; instructions and cycles of a wave of 64 threads\n";
  for (const FamilyCost& family : report.families) {
    std::snprintf(line.data(), line.size(), "\n%-52s %8s %8s %8s %6s %6s %8s %8s %5s %5s %9s %9s\n",
                  family.family.c_str(), "valu", "transc.", "fetches", "stores", "local", "scalar",
                  "s. loads", "regs", "waves", "alu cyc.", "tex. cyc.");
    out += line.data();
    for (const ShaderCost& shader : family.shaders) {
      if (!shader.error.empty()) {
        std::snprintf(line.data(), line.size(), "%-52s failed, see below\n", shader.shader.c_str());
        out += line.data();
        continue;
      }
      const InstructionCounts& n = shader.counts;
      std::snprintf(line.data(), line.size(),
                    "%-52s %8.0f %8.0f %8.1f %6.0f %6.0f %8.0f %8.0f %5u %5u %9.0f %9.0f\n",
                    shader.shader.c_str(), n[InstructionClass::vector], n[InstructionClass::quarter_rate],
                    n[InstructionClass::fetch], n[InstructionClass::store], n[InstructionClass::local_memory],
                    n[InstructionClass::scalar], n[InstructionClass::scalar_load], shader.vector_registers,
                    shader.waves, shader.cycles().alu, shader.cycles().texture);
      out += line.data();
    }
    if (family.passes.empty()) continue;
    std::snprintf(line.data(), line.size(), "\n%-52s %9s %9s %9s\n",
                  (family.family + ", whole passes").c_str(), "alu cyc.", "tex. cyc.", "sum");
    out += line.data();
    for (const PassCost& pass : family.passes) {
      std::snprintf(line.data(), line.size(), "%-52s %9.0f %9.0f %9.0f\n", pass.pass.c_str(), pass.cycles.alu,
                    pass.cycles.texture, pass.cycles.all());
      out += line.data();
    }
  }
  return out;
}

Comparison compare(const CostReport& before, const CostReport& after, double limit) {
  Comparison comparison;
  Line line;
  std::snprintf(line.data(), line.size(), "%-9s %-52s %10s %10s %8s\n", "family", "cycles of", "old", "new",
                "new/old");
  comparison.text += line.data();
  for (const FamilyCost& family : after.families)
    for (const FamilyCost& old : before.families)
      if (old.family == family.family) compare_family(comparison, old, family, limit);
  return comparison;
}

}  // namespace nook::lab
