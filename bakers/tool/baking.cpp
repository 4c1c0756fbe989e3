#include "bakers/tool/baking.h"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/raytrace/instruction_set.h"
#include "bakers/raytrace/worker_arena.h"
#include "bakers/tool/bake_cache.h"
#include "bakers/tool/bake_survey.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/depfile.h"
#include "bakers/tool/table.h"
#include "platform/output_file.h"
#include "platform/output_stream.h"
#include "platform/printable.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {
namespace {

// Runs a part of the bake on the requested threads. If the user stops the part, converts the exception to the
// message for the user.
template <class Part>
void run_part(const BakeCommand& command, Part&& part) {
  const auto stopped = [&] { return ToolError(exit_other, command.stopped); };
  try {
    bake::run_with_threads(command.common.threads, part);
  } catch (const Failure& failure) {
    if (failure.code() == NOOK_ERROR_CANCELLED) throw stopped();
    throw;
  } catch (const ToolError&) {
    // naming_file() converts a failure to a ToolError and adds the name of the input, so a cancelled part can
    // also arrive here.
    if (interrupted()) throw stopped();
    throw;
  }
  // Ctrl-C after the last progress callback also stops the bake.
  if (interrupted()) throw stopped();
}

// Checks that main() has started the program again with the instruction set of --isa in its environment.
void require_instruction_set(const BakeOptions& options) {
  const char* const pinned = std::getenv(bake::isa_variable);
  if (!options.isa.empty() && options.isa != (pinned ? pinned : ""))
    throw ToolError(exit_other, "--isa: the program could not start itself again with " + options.isa +
                                    "; set " + bake::isa_variable + "=" + options.isa +
                                    " in the environment instead");
  bake::isa_level();
}

std::optional<BakeCache> cache_of(const BakeOptions& options) {
  const std::filesystem::path folder = cache_folder(options.cache);
  if (folder.empty()) return std::nullopt;
  return BakeCache(folder);
}

// Returns the result from the cache. If the cache does not have it, bakes it and stores it in the cache.
BakeOutput obtain(const BakeCommand& command, const std::optional<BakeCache>& cache,
                  const PreparedBake& prepared) {
  if (!cache || command.has_time_limit) return prepared.perform();
  const std::string key = prepared.identity.key();
  const bool quiet = command.common.quiet;
  if (!command.makes_more)
    if (std::optional<BakeOutput> hit = cache->find(key, quiet)) return std::move(*hit);
  BakeOutput output = prepared.perform();
  if (!interrupted()) cache->store(key, output);
  return output;
}

void print_key(const BakeCommand& command, const std::function<PreparedBake()>& prepare) {
  std::string key;
  run_part(command, [&] { key = prepare().identity.key(); });
  platform::print(key + "\n");
}

// Warns about names that Ninja cannot read, even with --quiet. Without the warning, a build would bake every
// time without saying why.
std::string rule_of(const BakeCommand& command) {
  const std::filesystem::path& output = command.baking.output;
  const std::vector<std::filesystem::path> read = files_read(command.files, command.reads_images);
  const std::string cut = name_that_ninja_cuts(output, read);
  if (!cut.empty())
    std::fprintf(stderr,
                 "nook: --depfile: Ninja 1.11 cuts off the name %s at a quote or another special character, "
                 "and would bake every time; rename the file, or use nook plan\n",
                 platform::printable(cut).c_str());
  return depfile_text(output, read);
}

}  // namespace

void add_bake_options(Command command, BakeOptions& options) {
  options.survey = command.survey();
  command.add_option("-o,--output", options.output, "write the result to this .nook file");
  command.add_flag("--print-key", options.prints_key,
                   "print the key of the bake instead of baking. The key is a hash of all inputs and "
                   "settings that affect the result: equal keys mean equal results (docs/guide/pipeline.md)");
  command.add_option(
      "--depfile", options.depfile,
      "write a rule for Make and Ninja to this file; the rule lists all files that the bake reads");
  command.add_option("--cache", options.cache,
                     "keep results in this folder, each under its key (--print-key). If the folder already "
                     "contains the result, the command copies it instead of baking. Default: the folder in "
                     "the environment variable NOOK_CACHE; no cache if it is not set");
  command
      .add_option("--isa", options.isa,
                  "processor instruction set of the bake: x86-64-v2, x86-64-v3 or native. native (default) "
                  "is the best set that this processor has. With x86-64-v2 or x86-64-v3, old and new "
                  "processors of one maker write the same bytes")
      .check(one_of({"native", "x86-64-v2", "x86-64-v3"}));
}

BakeOutput one_row(bake::BakedFile file, std::initializer_list<const char*> only_in_report) {
  using Json = nlohmann::ordered_json;
  Json row = Json::parse(file.report);
  BakeOutput output;
  output.file = std::move(file.model);
  output.report =
      Json{{"rows", Json::array({row})}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  for (const char* key : only_in_report) row.erase(key);
  output.table = table_text(Json::array({std::move(row)}));
  return output;
}

void run_bake(BakeCommand command, const std::function<PreparedBake()>& prepare) {
  const BakeOptions& options = command.baking;
  if (options.survey) return options.survey->found(command, prepare);
  require_instruction_set(options);
  if (options.prints_key) return print_key(command, prepare);
  if (options.output.empty()) throw ToolError(exit_bad_arguments, "--output is required");
  const std::filesystem::path& report = command.common.report;
  CommandFiles& files = command.files;
  files.outputs.insert(files.outputs.begin(), {"-o", options.output});
  files.outputs.push_back({"--report", report});
  files.outputs.push_back({"--depfile", options.depfile});
  require_distinct_files(files);
  const std::string rule = options.depfile.empty() ? "" : rule_of(command);
  const std::optional<BakeCache> cache = cache_of(options);
  const platform::FileEvents events = file_events(command.common.quiet);
  platform::OutputFile output_file(options.output, events);
  std::optional<platform::OutputFile> report_file, rule_file;
  if (!report.empty()) report_file.emplace(report, events);
  if (!rule.empty()) rule_file.emplace(options.depfile, events);
  make_image_folder(files.images);
  BakeOutput output;
  run_part(command, [&] { output = obtain(command, cache, prepare()); });
  // Writes the report before the baked file. If the baked file exists, its report therefore exists too, even
  // if the program was killed in between.
  if (report_file) report_file->commit(output.report);
  if (rule_file) rule_file->commit(rule);
  output_file.commit(output.file);
  print_table(command.common, output.table, true);
}

}  // namespace nook::tool
