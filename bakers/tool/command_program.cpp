#include "bakers/tool/command_program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <new>
#include <sstream>

#include "bakers/tool/command_end.h"
#include "platform/output_stream.h"
#include "platform/printable.h"
#include "platform/standard_streams.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/version.h"

namespace nook::tool {

namespace {

// Returns the commands that the arguments name, outermost first, for example "nook", "bake", "probe".
std::vector<CLI::App*> named_commands(CLI::App& program) {
  std::vector<CLI::App*> commands{&program};
  while (!commands.back()->get_subcommands().empty())
    commands.push_back(commands.back()->get_subcommands().back());
  return commands;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// Joins the names of the commands, starting at index `first`. Index 0 is the program.
std::string name_of(const std::vector<CLI::App*>& commands, std::size_t first = 0) {
  std::vector<std::string> names;
  for (std::size_t c = first; c < commands.size(); ++c) names.push_back(commands[c]->get_name());
  return joined(names, " ");
}

// Returns a sentence that names the other program if the unknown words belong to it. It is added to the
// message about these words.
std::string elsewhere(CLI::App& program, const ElsewhereWords& words) {
  const std::string command = name_of(named_commands(program), 1);
  const auto known = words.words.find(command);
  if (known == words.words.end()) return "";
  for (const std::string& word : program.remaining(true)) {
    const std::string option = word.substr(0, word.find('='));
    if (std::ranges::count(known->second, option.starts_with('-') ? option : "*") > 0 ||
        std::ranges::count(known->second, option) > 0)
      return "; for " + option + " see " + words.program + " " + command + " --help " + words.how_to_get;
  }
  return "";
}

// Returns a message with the existing commands if the user gave no command.
std::string missing_command(CLI::App& program) {
  const std::vector<CLI::App*> commands = named_commands(program);
  std::vector<std::string> names;
  for (const CLI::App* each : commands.back()->get_subcommands([](CLI::App*) { return true; }))
    names.push_back(each->get_name());
  if (names.empty()) return "";
  const std::vector<std::string> unknown = commands.back()->remaining();
  return name_of(commands) + ": " +
         (unknown.empty() ? std::string("a command is missing") : "there is no command " + unknown.front()) +
         " (need one of " + joined(names, ", ") + ")";
}

// Returns a hint about the missing "--" of `nook task`. Without it, options of the command look like options
// of the task.
std::string missing_dashes(CLI::App& program) {
  const std::vector<CLI::App*> commands = named_commands(program);
  const std::vector<std::string> unknown = commands.back()->remaining();
  if (commands.back()->get_name() != "task" || unknown.empty()) return "";
  return unknown.front() + " is not an option of " + name_of(commands) +
         "; put -- before the command, as in: nook task --log FILE -- bake character HERO.glb -o HERO.nook";
}

std::string fault_text(CLI::App& program, const CLI::ParseError& fault, const ElsewhereWords& words) {
  std::string text;
  if (dynamic_cast<const CLI::RequiredError*>(&fault)) text = missing_command(program);
  if (dynamic_cast<const CLI::ExtrasError*>(&fault)) text = missing_dashes(program);
  if (text.empty()) {
    std::ostringstream out, error;
    program.exit(fault, out, error);
    text = error.str();
  }
  text.insert(std::min(text.find('\n'), text.size()), elsewhere(program, words));
  return text.ends_with('\n') ? text : text + "\n";
}

int parse(CLI::App& program, int argc, char** argv, const ElsewhereWords& words) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    std::ostringstream out, error;
    program.exit(asked, out, error);
    platform::print(platform::printable_lines(out.str()));
  } catch (const CLI::ParseError& fault) {
    std::fputs(platform::printable_lines(fault_text(program, fault, words)).c_str(), stderr);
    return exit_bad_arguments;
  }
  platform::require_printed();
  return exit_done;
}

// Returns the advice for a command that ran out of memory. It depends on the command.
std::string memory_advice(CLI::App& program) {
  const std::string name = name_of(named_commands(program));
  if (name.ends_with("bake character")) return "; use fewer poses, or a smaller preset";
  if (name.ends_with("evaluate character") || name.ends_with("report"))
    return "; measure fewer poses (--samples-per-clip)";
  if (name.ends_with("bake material")) return "; use fewer --directions or --texels";
  if (name.ends_with("bake probe")) return "; use a smaller map, or fewer probes";
  if (name.ends_with("train nnao")) return "; use fewer --scenes, --views or --points";
  return "; use smaller inputs, or a machine with more memory";
}

}  // namespace

int run_program(int argc, char** argv, const char* name, const char* description,
                const std::function<void(CLI::App&)>& add_commands, const ElsewhereWords& elsewhere) {
  open_closed_streams();
  watch_for_interrupt();
  const auto fail = [name](int code, const std::string& text) {
    std::fprintf(stderr, "%s: %s\n", name, platform::printable_lines(text).c_str());
    return code;
  };
  CLI::App program(description, name);
  try {
    program.set_version_flag("--version", version_text);
    program.require_subcommand(1);
    add_commands(program);
    return parse(program, argc, argv, elsewhere);
  } catch (const CommandEnd& end) {
    return end.code();
  } catch (const ToolError& e) {
    return fail(e.code(), e.what());
  } catch (const Failure& e) {
    return fail(exit_code_of(e.code()), e.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_other, "not enough memory" + memory_advice(program));
  } catch (const std::exception& e) {
    return fail(exit_other, e.what());
  }
}

}  // namespace nook::tool
