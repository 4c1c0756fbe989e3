// Reads the manifest of `nook plan`, nook.json. Its rules say which files are baked and how.
// docs/guide/pipeline.md describes it, and docs/guide/nook.schema.json is its JSON schema for editors.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace nook::tool::plan {

using Json = nlohmann::json;

struct Rule {
  std::string place;               // place of the rule in the manifest, such as "rules[2]"
  std::vector<std::string> match;  // patterns (glob.h)
  Json settings;                   // the rule without `match`
};

struct Manifest {
  std::filesystem::path file;  // as the user named it, for messages
  std::filesystem::path root;  // its folder, absolute
  std::string output;          // the pattern of outputs, for rules without a pattern of their own
  std::vector<Rule> rules;
};

// Reads a manifest and checks its keys, the types of its values, its patterns and its options. Throws
// ToolError (bad input) that names the place.
Manifest read_manifest(const std::filesystem::path& file);

// Merges the settings of all rules that match a file. Values of later rules replace values of earlier rules
// with the same name, and null removes a value (RFC 7396). Sets `last` to the last rule that matches. Returns
// null if no rule matches.
Json settings_of(const Manifest& manifest, const std::string& path, const Rule*& last);

// Throws ToolError (bad input) with a message such as "nook.json: rules[2].output: text".
[[noreturn]] void refuse(const Manifest& manifest, const std::string& place, const std::string& text);

// Replaces {dir} by the folder of a file, and {stem} by its name without the extension. If `escaped` is true,
// the result is a pattern, and the inserted texts contain no wildcards.
std::string expanded(std::string pattern, const std::string& path, bool escaped);

}  // namespace nook::tool::plan
