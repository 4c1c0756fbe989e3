// nook_gpu_cost: estimates the cost of a tree's shaders on GPUs that this machine does not have, and compares
// two trees.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "bakers/lab/gpu_cost/cost_report.h"
#include "platform/output_file.h"
#include "platform/standard_streams.h"

namespace {

using namespace nook::lab;
namespace fs = std::filesystem;

// The accepted GPU families. RADV ends the process if it gets an unknown name. The loops of materials are
// known only for the default families.
const std::set<std::string> known_families = {"polaris10", "vega10",  "vega20",  "navi10",  "navi21",
                                              "navi23",    "gfx1036", "gfx1100", "gfx1101", "gfx1102"};

constexpr int exit_done = 0, exit_failed = 1, exit_skipped = 77;

struct Options {
  std::string root = NOOK_SOURCE_ROOT;
  std::vector<std::string> families = {"navi21", "gfx1100", "vega10"};
  std::vector<std::string> defines;
  bool buffers_as_textures = false;
  std::string only, report, dump;
  std::string before, after;
  double limit = 1e9;
};

// OpenGL ES 3.0 has no texture buffers. A 2D texture replaces each texture buffer. Its rows hold the elements
// of the buffer one after the other.
constexpr char texture_rows[] =
    "#define samplerBuffer sampler2D\n"
    "vec4 texelFetch(sampler2D rows, int i) { return texelFetch(rows, ivec2(i & 2047, i >> 11), 0); }\n";

std::string first_lines(const Options& options) {
  std::string lines = options.buffers_as_textures ? texture_rows : "";
  for (std::string define : options.defines) {
    if (const std::size_t equals = define.find('='); equals != std::string::npos) define[equals] = ' ';
    lines += "#define " + define + "\n";
  }
  return lines;
}

void write(const fs::path& path, const std::string& text) {
  platform::OutputFile(path).commit(text);
}

nlohmann::json read_json(const std::string& path) {
  return nlohmann::json::parse(file_text(path));
}

// Writes the Vulkan GLSL, the disassembly and the loops of each shader, so that you can check the counts.
void dump(const Options& options, const SourceTree& tree) {
  fs::create_directories(options.dump);
  for (const std::string& family : options.families) {
    NullDevice device(family);
    for (const ShaderCase& shader : all_shaders()) {
      if (shader.name.find(options.only) == std::string::npos) continue;
      const fs::path path = fs::path(options.dump) / (family + ", " + shader.name);
      write(path.string() + ".glsl", vulkan_glsl(tree, shader).text);
      const std::string disassembly = compile_shader(device, tree, shader).disassembly;
      write(path.string() + ".txt", disassembly);
      std::printf("%s, %s\n%s", family.c_str(), shader.name.c_str(), describe_loops(disassembly).c_str());
    }
  }
}

int fail_for(const CostReport& report) {
  const std::string errors = report.errors();
  if (errors.empty()) return exit_done;
  std::fprintf(stderr, "\nnot counted:\n%s", errors.c_str());
  return exit_failed;
}

int count(const Options& options) {
  const SourceTree tree{options.root, first_lines(options)};
  if (!options.dump.empty()) {
    dump(options, tree);
    return exit_done;
  }
  const CostReport report = count_tree(tree, options.families, options.only);
  std::fputs(cost_table(report).c_str(), stdout);
  if (fail_for(report) != exit_done) return exit_failed;
  if (!options.report.empty()) write(options.report, report_text(report));
  return exit_done;
}

// Returns the report for `path`. If the path is a folder, the function counts the shaders of this tree. If it
// is a file, the function reads the report of an earlier run.
CostReport report_of(const Options& options, const std::string& path, const std::string& defines) {
  if (fs::is_directory(path)) return count_tree({path, defines}, options.families, options.only);
  return from_json(read_json(path));
}

void print_names(const char* title, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::fprintf(stderr, "\n%s:\n", title);
  for (const std::string& name : names) std::fprintf(stderr, "  %s\n", name.c_str());
}

int compare_two(const Options& options) {
  const CostReport before = report_of(options, options.before, "");
  const CostReport after = report_of(options, options.after, first_lines(options));
  if (before.driver != after.driver) {
    std::printf(
        "SKIPPED: the old numbers come from %s, the new ones from %s; numbers from different compilers "
        "cannot be compared\n",
        before.driver.c_str(), after.driver.c_str());
    return exit_skipped;
  }
  const Comparison comparison = compare(before, after, options.limit);
  std::fputs(comparison.text.c_str(), stdout);
  if (fail_for(after) != exit_done) return exit_failed;
  print_names(("above " + std::to_string(options.limit) + " times the old cycles").c_str(),
              comparison.above_limit);
  // If `before` is a stored report, it must list the same shaders as the tree. If `before` is a tree, it may
  // have different shaders.
  const bool of_a_report = !fs::is_directory(options.before) && options.only.empty();
  if (of_a_report) print_names("only in one of the two", comparison.unmatched);
  if (comparison.above_limit.empty() && (!of_a_report || comparison.unmatched.empty())) return exit_done;
  if (of_a_report)
    std::fprintf(stderr,
                 "\nif you intended this, write new numbers: bakers/lab/tables/gpu_cost.py --write, or "
                 "nook_gpu_cost --report %s\n",
                 options.before.c_str());
  return exit_failed;
}

// Called if RADV is missing, because then nothing can be counted. This is treated as a failure only if
// NOOK_REQUIRE_RADV=1 is set.
int without_radv(const char* what) {
  const char* required = std::getenv("NOOK_REQUIRE_RADV");
  if (required && std::string(required) == "1") {
    std::fprintf(stderr, "%s\n", what);
    return exit_failed;
  }
  std::printf("NO RADV, SKIPPED: %s\n", what);
  return exit_skipped;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App tool(
      "Compiles every shader with the RADV driver, for GPUs that this machine does not need to have, and "
      "counts their instructions.\nExit codes: 0 success, 77 RADV is missing or is not the version that gave "
      "the old numbers, 2 bad arguments, 1 any other error.",
      "nook_gpu_cost");
  tool.add_option("--root", options.root,
                  "folder of the source tree whose shaders are counted. Default: the tree that this program "
                  "was built from")
      ->check(CLI::ExistingDirectory);
  tool.add_option("--family", options.families,
                  "GPU families to compile for, by their names in RADV; separate them by commas")
      ->delimiter(',')
      ->capture_default_str()
      ->check(CLI::IsMember(known_families));
  tool.add_option("--only", options.only, "count only shaders whose name contains this text");
  tool.add_option("--define", options.defines, "define this macro in every shader, as NAME or NAME=VALUE");
  tool.add_flag("--buffers-as-textures", options.buffers_as_textures,
                "replace texture buffers by 2D textures with rows of 2,048 texels, as on OpenGL ES 3.0");
  tool.add_option("--report", options.report, "write the numbers to this JSON file");
  tool.add_option(
      "--dump", options.dump,
      "write the Vulkan GLSL and the disassembly of each shader into this folder, and print its loops");
  CLI::App* compare = tool.add_subcommand(
      "compare",
      "print the cycles of each shader in one source tree or report, divided by its cycles in another");
  compare->fallthrough();
  compare->add_option("old", options.before, "old numbers: the folder of a source tree, or a report file")
      ->required()
      ->check(CLI::ExistingPath);
  compare
      ->add_option("new", options.after,
                   "new numbers: the folder of a source tree, or a report file; --define and "
                   "--buffers-as-textures apply only to this tree")
      ->required()
      ->check(CLI::ExistingPath);
  compare->add_option("--limit", options.limit,
                      "fail if a ratio (new cycles divided by old cycles) is above this number");
  try {
    tool.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return tool.exit(error) == 0 ? exit_done : 2;
  }
  return compare->parsed() ? compare_two(options) : count(options);
}

}  // namespace

int main(int argc, char** argv) {
  open_closed_streams();
  try {
    return code_after_output(run(argc, argv));
  } catch (const NoRadv& missing) {
    return without_radv(missing.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return exit_failed;
  }
}
