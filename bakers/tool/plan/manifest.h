// The manifest of nook plan, nook.json: rules that say which files are baked and how. docs/guide/pipeline.md
// describes it, and docs/guide/nook.schema.json has its form for editors.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace nook::tool::plan {

using Json = nlohmann::json;

struct Rule {
  std::string place;               // in the manifest, such as "rules[2]"
  std::vector<std::string> match;  // patterns (glob.h)
  Json settings;                   // the rule without `match`
};

struct Manifest {
  std::filesystem::path file;  // as the user named it, for messages
  std::filesystem::path root;  // its folder, absolute
  std::string output;          // the pattern of outputs for rules without their own
  std::vector<Rule> rules;
};

// Reads a manifest and checks its keys, the types of its values, its patterns and its options. Throws
// ToolError (bad input) that names the place.
Manifest read_manifest(const std::filesystem::path& file);

// Returns the settings of a file by all rules that match it. Later rules replace values of earlier ones, name
// by name, and null removes a value (RFC 7396). `last` becomes the last rule that matches. Returns null if
// none matches.
Json settings_of(const Manifest& manifest, const std::string& path, const Rule*& last);

// Throws ToolError (bad input): "nook.json: rules[2].output: text".
[[noreturn]] void refuse(const Manifest& manifest, const std::string& place, const std::string& text);

// Replaces {dir} and {stem} by the folder and the name of a file, without its extension. With `escaped` the
// result is a pattern in which they stand for themselves.
std::string expanded(std::string pattern, const std::string& path, bool escaped);

}  // namespace nook::tool::plan
