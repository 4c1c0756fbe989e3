#include "bakers/tool/plan/manifest.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/plan/bake_words.h"
#include "bakers/tool/plan/glob.h"

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

constexpr const char* default_output = "baked/{dir}/{stem}.nook";

using Keys = std::set<std::string>;
const Keys& keys_of_manifest() {
  static const Keys keys{"$schema", "output", "rules"};
  return keys;
}
const Keys& keys_of_rule() {
  static const Keys keys{"match", "skip", "bake", "input", "output", "options", "lods", "bent", "clips"};
  return keys;
}
// Returns the allowed keys of "lods", "bent" and "clips".
const Keys& keys_of_part(const std::string& part) {
  static const Keys lods{"match", "output", "options"}, others{"output", "options"};
  return part == "lods" ? lods : others;
}

std::string listed(const Keys& keys) {
  std::string text;
  for (const std::string& key : keys) text += (text.empty() ? "" : ", ") + key;
  return text;
}

// Finds duplicate keys. Without this, the JSON library silently keeps the last of two equal keys.
class EqualKeys {
 public:
  bool see(Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end) open_.pop_back();
    if (event == Event::key && !open_.back().insert(parsed.get<std::string>()).second && twice_.empty())
      twice_ = parsed.get<std::string>();
    return true;
  }
  const std::string& twice() const { return twice_; }

 private:
  std::vector<Keys> open_;
  std::string twice_;
};

// Returns "line 3, column 5: syntax error ..." from a message of the JSON library.
std::string fault_of(const Json::parse_error& error) {
  const std::string text = error.what();
  const std::size_t at = text.find("line ");
  return at == std::string::npos ? text : text.substr(at);
}

Json parsed(const fs::path& file) {
  const std::vector<std::byte> bytes = read_any_file(file);
  EqualKeys keys;
  Json json;
  try {
    json = Json::parse(reinterpret_cast<const char*>(bytes.data()),
                       reinterpret_cast<const char*>(bytes.data() + bytes.size()),
                       [&](int, Json::parse_event_t event, Json& value) { return keys.see(event, value); });
  } catch (const Json::parse_error& error) {
    throw ToolError(exit_bad_input, file.string() + ": " + fault_of(error) + "; correct the JSON there");
  }
  if (!keys.twice().empty())
    throw ToolError(exit_bad_input, file.string() + ": one object has the key \"" + keys.twice() +
                                        "\" twice; remove one of them");
  return json;
}

void require_object(const Manifest& m, const std::string& place, const Json& json) {
  if (!json.is_object()) refuse(m, place, std::string("needs an object (got ") + json.type_name() + ")");
}

void require_keys(const Manifest& m, const std::string& place, const Json& json, const Keys& keys) {
  require_object(m, place, json);
  for (const auto& item : json.items())
    if (!keys.contains(item.key()))
      refuse(m, place,
             "there is no key \"" + item.key() + "\"; the keys here are " + listed(keys) +
                 (place.empty() ? "" : ". Put options of a bake into \"options\""));
}

std::string text_of(const Manifest& m, const std::string& place, const Json& json) {
  if (!json.is_string()) refuse(m, place, std::string("needs a text (got ") + json.type_name() + ")");
  const std::string text = json.get<std::string>();
  if (text.empty()) refuse(m, place, "the text is empty");
  if (text.find_first_of("\n\r") != std::string::npos)
    refuse(m, place, "tasks.txt cannot contain a name with a line break; rename the file");
  return text;
}

// Throws if a path is not below the manifest's folder, or contains "." or "..".
void require_inside(const Manifest& m, const std::string& place, const std::string& path) {
  const fs::path as_path(path);
  bool is_plain = !as_path.is_absolute();
  for (const fs::path& name : as_path) is_plain = is_plain && name != ".." && name != "." && !name.empty();
  if (!is_plain)
    refuse(m, place,
           "\"" + path +
               "\" must be a path below the manifest's folder, without . and ..; move the file or " +
               "the manifest");
}

std::vector<std::string> patterns_of(const Manifest& m, const std::string& place, const Json& json) {
  std::vector<std::string> patterns;
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i)
      patterns.push_back(text_of(m, place + "[" + std::to_string(i) + "]", json[i]));
  else
    patterns.push_back(text_of(m, place, json));
  if (patterns.empty())
    refuse(m, place, "the list is empty; name at least one pattern, such as \"**/*.glb\"");
  return patterns;
}

void require_pattern(const Manifest& m, const std::string& place, const std::string& pattern) {
  const std::string plain = expanded(pattern, "dir/stem.glb", false);
  if (plain.find_first_of("{}") != std::string::npos)
    refuse(m, place, "may contain only the placeholders {dir} and {stem} (got \"" + pattern + "\")");
  require_inside(m, place, plain);
}

void check_output(const Manifest& m, const std::string& place, const Json& json) {
  const std::string output = text_of(m, place, json);
  require_pattern(m, place, output);
  if (!output.ends_with(".nook")) refuse(m, place, "must end in .nook (got \"" + output + "\")");
}

void check_part(const Manifest& m, const std::string& place, const std::string& part, const Json& json) {
  if (json.is_null()) return;
  require_keys(m, place, json, keys_of_part(part));
  if (json.contains("output") && !json["output"].is_null())
    check_output(m, place + ".output", json["output"]);
  if (json.contains("match"))
    for (const std::string& pattern : patterns_of(m, place + ".match", json["match"]))
      require_pattern(m, place + ".match", pattern);
  if (json.contains("options"))
    check_options(m, place + ".options", part == "lods" ? "lod" : part, json["options"]);
}

Rule checked_rule(const Manifest& m, const std::string& place, const Json& json) {
  require_keys(m, place, json, keys_of_rule());
  if (!json.contains("match")) refuse(m, place, "needs \"match\", the files that the rule applies to");
  Rule rule{place, patterns_of(m, place + ".match", json["match"]), json};
  rule.settings.erase("match");
  for (const std::string& pattern : rule.match) require_inside(m, place + ".match", pattern);
  if (json.contains("skip") && !json["skip"].is_boolean())
    refuse(m, place + ".skip", std::string("needs true or false (got ") + json["skip"].type_name() + ")");
  for (const char* name : {"bake", "input"})
    if (json.contains(name)) text_of(m, place + "." + name, json[name]);
  if (json.contains("bake") && !is_kind(json["bake"].get<std::string>()))
    refuse(m, place + ".bake",
           "there is no bake \"" + json["bake"].get<std::string>() + "\" (need one of " + names_of_kinds() +
               ")");
  if (json.contains("output")) check_output(m, place + ".output", json["output"]);
  for (const char* part : {"lods", "bent", "clips"})
    if (json.contains(part)) check_part(m, place + "." + part, part, json[part]);
  return rule;
}

// If no rule names a bake, a rule is for characters, and its options are checked here. Otherwise, the kind of
// bake depends on all rules that match a file, and describe_job() checks the options later.
void check_rule_options(const Manifest& m) {
  const bool all_characters = std::none_of(m.rules.begin(), m.rules.end(), [](const Rule& rule) {
    return rule.settings.contains("bake") && rule.settings["bake"] != "character";
  });
  for (const Rule& rule : m.rules)
    if (rule.settings.contains("options") && (all_characters || rule.settings.contains("bake")))
      check_options(m, rule.place + ".options", rule.settings.value("bake", "character"),
                    rule.settings["options"]);
}

}  // namespace

void refuse(const Manifest& manifest, const std::string& place, const std::string& text) {
  throw ToolError(exit_bad_input, manifest.file.string() + ": " + (place.empty() ? "" : place + ": ") + text);
}

Manifest read_manifest(const fs::path& file) {
  Manifest m;
  m.file = file;
  m.root = fs::absolute(file).lexically_normal().parent_path();
  const Json json = parsed(file);
  require_keys(m, "", json, keys_of_manifest());
  m.output = json.contains("output") ? text_of(m, "output", json["output"]) : default_output;
  check_output(m, "output", m.output);
  if (!json.contains("rules") || !json["rules"].is_array() || json["rules"].empty())
    refuse(m, "rules", "needs a list of at least one rule, such as [{\"match\": \"characters/**/*.glb\"}]");
  for (std::size_t i = 0; i < json["rules"].size(); ++i)
    m.rules.push_back(checked_rule(m, "rules[" + std::to_string(i) + "]", json["rules"][i]));
  check_rule_options(m);
  return m;
}

Json settings_of(const Manifest& manifest, const std::string& path, const Rule*& last) {
  Json settings;
  for (const Rule& rule : manifest.rules) {
    const bool fits = std::any_of(rule.match.begin(), rule.match.end(),
                                  [&](const std::string& pattern) { return matches(pattern, path); });
    if (!fits) continue;
    if (settings.is_null()) settings = {{"bake", "character"}, {"output", manifest.output}};
    settings.merge_patch(rule.settings);
    last = &rule;
  }
  return settings;
}

std::string expanded(std::string pattern, const std::string& path, bool escaped) {
  const fs::path as_path(path);
  const std::string folder = as_path.parent_path().string();
  const auto shown = [&](const std::string& text) { return escaped ? literal_pattern(text) : text; };
  const auto replace = [&](std::string_view name, const std::string& text) {
    for (std::size_t at = 0; (at = pattern.find(name, at)) != std::string::npos; at += text.size())
      pattern.replace(at, name.size(), text);
  };
  // For a file in the manifest's own folder, {dir} is empty, so we remove the slash after {dir} too.
  if (folder.empty()) replace("{dir}/", "");
  replace("{dir}", shown(folder));
  replace("{stem}", shown(as_path.stem().string()));
  return pattern;
}

}  // namespace nook::tool::plan
