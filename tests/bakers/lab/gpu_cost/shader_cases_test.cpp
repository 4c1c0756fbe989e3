#include "bakers/lab/gpu_cost/shader_cases.h"

#include <filesystem>
#include <set>

#include "bakers/lab/gpu_cost/cost_report.h"
#include "tests/catch.h"

using namespace nook::lab;
namespace fs = std::filesystem;

namespace {

bool is_stage(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".vert" || extension == ".frag" || extension == ".comp";
}

CostReport report_of(double vector_instructions) {
  ShaderCost cost;
  cost.shader = "some shader";
  cost.counts[InstructionClass::vector] = vector_instructions;
  CostReport report;
  report.driver = "driver";
  report.families = {{"navi21", {cost}, {}}};
  return report;
}

}  // namespace

TEST_CASE("every shader of the tree is counted") {
  std::set<std::string> counted;
  for (const ShaderCase& shader : all_shaders()) counted.insert(shader.path);
  const fs::path root = NOOK_SOURCE_ROOT;
  for (const char* folder : {"shaders", "bakers/lab/nnao/shaders"})
    for (const auto& file : fs::recursive_directory_iterator(root / folder)) {
      // The vertices of the triangle over the screen cost nothing beside its pixels, and nothing.frag has no
      // pixels. The others are drawn only with nook_gl_desc.debug.
      const std::set<std::string> left_out{"screen.vert", "nothing.frag", "surface.frag", "bodies.frag"};
      if (!is_stage(file.path()) || left_out.count(file.path().filename().string())) continue;
      const std::string path = fs::relative(file.path(), root).generic_string();
      INFO(path);
      CHECK(counted.count(path) == 1);
    }
}

TEST_CASE("names are unique, and passes are made of shaders") {
  std::set<std::string> names;
  for (const ShaderCase& shader : all_shaders()) CHECK(names.insert(shader.name).second);
  for (const PassCase& pass : all_passes())
    for (const auto& [shader, share] : pass.shaders) {
      INFO(pass.name << ": " << shader);
      CHECK(names.count(shader) == 1);
      CHECK(share > 0);
    }
}

TEST_CASE("the comparison finds what grew by more than the limit") {
  const CostReport before = report_of(100);
  CHECK(compare(before, report_of(102), 1.02).above_limit.empty());
  CHECK(compare(before, report_of(103), 1.02).above_limit == std::vector<std::string>{"navi21: some shader"});
  CHECK(compare(before, report_of(50), 1.02).above_limit.empty());
  CostReport renamed = before;
  renamed.families[0].shaders[0].shader = "another";
  CHECK(compare(before, renamed, 1.02).unmatched.size() == 2);
}

TEST_CASE("a report keeps its numbers in its file") {
  const CostReport before = report_of(123);
  const CostReport after = from_json(nlohmann::json::parse(report_text(before)));
  CHECK(after.driver == before.driver);
  REQUIRE(after.families.size() == 1);
  CHECK(after.families[0].shaders[0].counts[InstructionClass::vector] == 123);
}
