#include "bakers/tool/command_program.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>
#include <sstream>

#include "bakers/tool/command_end.h"
#include "platform/printable.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/version.h"

namespace nook::tool {

namespace {

int parse(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    std::ostringstream out, error;
    const bool done = program.exit(e, out, error) == 0;
    std::fputs(platform::printable_lines(out.str()).c_str(), stdout);
    std::fputs(platform::printable_lines(error.str()).c_str(), stderr);
    return done ? exit_done : exit_bad_arguments;
  }
  return exit_done;
}

}  // namespace

int run_program(int argc, char** argv, const char* name, const char* description,
                const std::function<void(CLI::App&)>& add_commands) {
  watch_for_interrupt();
  const auto fail = [name](int code, const char* text) {
    std::fprintf(stderr, "%s: %s\n", name, platform::printable_lines(text).c_str());
    return code;
  };
  try {
    CLI::App program(description, name);
    program.set_version_flag("--version", version_text);
    program.require_subcommand(1);
    add_commands(program);
    return parse(program, argc, argv);
  } catch (const ToolError& e) {
    return fail(e.code(), e.what());
  } catch (const Failure& e) {
    return fail(exit_code_of(e.code()), e.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_other, "not enough memory; use fewer poses, or a smaller preset");
  } catch (const std::exception& e) {
    return fail(exit_other, e.what());
  }
}

}  // namespace nook::tool
