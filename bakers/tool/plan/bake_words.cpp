#include "bakers/tool/plan/bake_words.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "bakers/tool/bake_survey.h"
#include "bakers/tool/baking.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"

namespace nook::tool::plan {
namespace {

struct Kind {
  const char* name;
  void (*add)(Command);
  std::size_t inputs;  // number of positional arguments
  bool is_of_rules;    // allowed as the "bake" of a rule
};
constexpr std::array kinds{Kind{"character", add_bake_character, 1, true},
                           Kind{"probe", add_bake_probe, 1, true},
                           Kind{"material", add_bake_material, 0, true},
                           Kind{"transfer", add_bake_transfer, 1, true},
                           Kind{"lod", add_bake_lod, 2, false},
                           Kind{"bent", add_bake_bent, 2, false},
                           Kind{"clips", add_bake_clips, 2, false}};

// The plan itself adds these options to every bake.
constexpr std::array<std::string_view, 10> options_of_plan{
    "output", "report", "depfile", "cache", "print-key", "isa", "threads", "quiet", "help", "help-all"};

const Kind& kind_of(const std::string& name) {
  return *std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.name == name; });
}

void run_survey(const Words& words, const BakeSurvey& survey) {
  run_words(words, kind_of(words.front()).add, &survey);
}

std::string text_of(const Manifest& m, const std::string& place, const Json& value, const std::string& path) {
  if (value.is_number()) return value.dump();
  if (!value.is_string())
    refuse(m, place,
           std::string("needs a text, a number, true, false, null, or a list of texts (got ") +
               value.type_name() + ")");
  const std::string text = expanded(value.get<std::string>(), path, false);
  if (text.find_first_of("\n\r") != std::string::npos)
    refuse(m, place, "a text has a line break, which tasks.txt cannot store; remove the line break");
  return text;
}

void add_words(const Manifest& m, const std::string& place, const std::string& name, const Json& value,
               const std::string& path, Words& words) {
  if (value.is_null() || value == false) return;
  if (value == true) return words.push_back("--" + name);
  if (!value.is_array()) return words.push_back("--" + name + "=" + text_of(m, place, value, path));
  for (const Json& each : value) words.push_back("--" + name + "=" + text_of(m, place, each, path));
}

}  // namespace

bool is_kind(const std::string& name) {
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](const Kind& kind) { return kind.is_of_rules && kind.name == name; });
}

std::string names_of_kinds() {
  std::string text;
  for (const Kind& kind : kinds)
    if (kind.is_of_rules) text += (text.empty() ? "" : ", ") + std::string(kind.name);
  return text;
}

Words option_words(const Manifest& manifest, const std::string& place, const Json& options,
                   const std::string& path) {
  Words words;
  for (const auto& item : options.items())
    add_words(manifest, place + "." + item.key(), item.key(), item.value(), path, words);
  return words;
}

void check_options(const Manifest& manifest, const std::string& place, const std::string& kind,
                   const Json& options) {
  if (options.is_null()) return;
  if (!options.is_object())
    refuse(manifest, place,
           std::string("needs an object of options of nook bake (got ") + options.type_name() + ")");
  for (const auto& item : options.items()) {
    const std::string at = place + "." + item.key();
    if (std::count(options_of_plan.begin(), options_of_plan.end(), item.key()) > 0)
      refuse(manifest, at, "nook plan itself sets this option for every bake; remove it here");
    if (item.key().size() < 2 || item.key().find_first_of("-= \t\n") == 0 ||
        item.key().find('=') != std::string::npos)
      refuse(manifest, at, "needs the long name of an option without its dashes, such as \"preset\"");
    Words words{kind};
    words.insert(words.end(), kind_of(kind).inputs, "file");
    add_words(manifest, at, item.key(), item.value(), "file", words);
    try {
      run_survey(words, BakeSurvey());
    } catch (const ToolError& error) {
      refuse(manifest, at, std::string(error.what()) + "; `nook bake " + kind + " --help` has the options");
    }
  }
}

BakeOutline outline_of(const Words& words) {
  BakeOutline outline;
  run_survey(
      words, {[&](const BakeCommand& command, const std::function<PreparedBake()>&) {
        outline = {command.files, command.reads_images, !command.makes_more && !command.has_time_limit};
      }});
  return outline;
}

bake::BakeIdentity identity_of(const Words& words) {
  bake::BakeIdentity identity;
  Words quiet = words;
  quiet.push_back("--quiet");
  run_survey(quiet, {[&](const BakeCommand&, const std::function<PreparedBake()>& prepare) {
               identity = prepare().identity;
             }});
  return identity;
}

std::string quoted(const std::string& word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

}  // namespace nook::tool::plan
