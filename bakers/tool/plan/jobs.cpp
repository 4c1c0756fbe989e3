#include "bakers/tool/plan/jobs.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "bakers/tool/command_end.h"
#include "bakers/tool/plan/job_order.h"
#include "platform/printable.h"
#include "sdk/src/core/failure.h"

namespace nook::tool::plan {
namespace {

namespace fs = std::filesystem;

// A file that matches at least one rule, with its settings.
struct Asset {
  std::string path;
  Json settings;
  const Rule* rule = nullptr;  // the last rule that matches
  std::vector<std::string> lods;
};

std::string normal(const std::string& path) {
  return fs::path(path).lexically_normal().generic_string();
}

void require_plain_name(const Manifest& m, const std::string& place, const std::string& path) {
  if (path.find_first_of("\n\r") != std::string::npos)
    refuse(m, place,
           "tasks.txt cannot contain a name with a line break (got \"" + platform::printable(path) +
               "\"); rename the file or skip it");
}

std::vector<Asset> matched_assets(const Manifest& m, FileTree& tree) {
  std::set<std::string> files;
  for (const Rule& rule : m.rules)
    for (const std::string& pattern : rule.match) {
      const std::vector<std::string> found = tree.find(pattern);
      if (found.empty())
        refuse(m, rule.place + ".match",
               "\"" + pattern + "\" matches no file below " + m.root.string() +
                   "; correct the pattern or remove it");
      files.insert(found.begin(), found.end());
    }
  std::vector<Asset> assets;
  for (const std::string& file : files) {
    Asset asset{file, {}, nullptr, {}};
    asset.settings = settings_of(m, file, asset.rule);
    if (asset.settings.is_null() || asset.settings.value("skip", false)) continue;
    require_plain_name(m, asset.rule->place, file);
    assets.push_back(std::move(asset));
  }
  return assets;
}

std::vector<std::string> texts_of(const Json& one_or_many) {
  if (one_or_many.is_string()) return {one_or_many.get<std::string>()};
  return one_or_many.get<std::vector<std::string>>();
}

const Json* part_of(const Asset& asset, const char* name) {
  const auto found = asset.settings.find(name);
  return found != asset.settings.end() && found->is_object() ? &*found : nullptr;
}

// Finds the levels of detail of a character. Adds the patterns that found a file to `used`.
void find_lods(const Manifest& m, FileTree& tree, Asset& asset, std::set<std::string>& used,
               std::map<std::string, std::string>& unused) {
  const Json* const lods = part_of(asset, "lods");
  if (!lods) return;
  if (!lods->contains("match"))
    refuse(m, asset.rule->place + ".lods",
           "needs \"match\", such as \"{dir}/{stem}_LOD*.glb\" (for " + asset.path + ")");
  for (const std::string& pattern : texts_of((*lods)["match"])) {
    std::vector<std::string> found = tree.find(expanded(pattern, asset.path, true));
    std::erase(found, asset.path);
    if (found.empty()) {
      unused.emplace(pattern, asset.rule->place);
      continue;
    }
    used.insert(pattern);
    for (std::string& lod : found) {
      require_plain_name(m, asset.rule->place + ".lods", lod);
      asset.lods.push_back(std::move(lod));
    }
  }
}

// A file that is a level of detail of a character is not baked as a separate character. Removes these files.
void take_lods(const Manifest& m, FileTree& tree, std::vector<Asset>& assets) {
  std::set<std::string> used;
  std::map<std::string, std::string> unused;
  std::map<std::string, std::string> body_of;
  for (Asset& asset : assets) {
    find_lods(m, tree, asset, used, unused);
    for (const std::string& lod : asset.lods) body_of.emplace(lod, asset.path);
  }
  for (const auto& [pattern, place] : unused)
    if (!used.contains(pattern))
      refuse(m, place + ".lods.match",
             "\"" + pattern + "\" matches no file of any character; correct the " + "pattern or remove it");
  for (const auto& [lod, body] : body_of) {
    const auto back = body_of.find(body);
    if (back != body_of.end() && back->second == lod)
      refuse(m, "lods", lod + " and " + body + " are levels of detail of each other; narrow the patterns");
  }
  std::erase_if(assets, [&](const Asset& asset) { return body_of.contains(asset.path); });
}

struct Builder {
  const Manifest& manifest;
  std::vector<Job> jobs;

  // `inputs` are the positional arguments. `about` is the path that {dir} and {stem} in file name patterns
  // refer to.
  void add(const std::string& place, const std::string& kind, const Words& inputs, const std::string& about,
           const std::string& output, const Json& settings) {
    Job job;
    job.kind = kind;
    job.source = about;
    job.output = normal(output);
    job.place = place;
    job.words = {kind};
    job.words.insert(job.words.end(), inputs.begin(), inputs.end());
    const Json options = settings.value("options", Json::object());
    const auto preset = options.find("preset");
    if (kind == "character")
      job.preset = preset != options.end() && preset->is_string() ? preset->get<std::string>() : "standard";
    const Words more = option_words(manifest, place + ".options", options, about);
    job.words.insert(job.words.end(), more.begin(), more.end());
    try {
      job.outline = outline_of(job.words);
    } catch (const ToolError& error) {
      refuse(manifest, place, about + ": " + error.what());
    } catch (const Failure& failure) {
      refuse(manifest, place, about + ": " + failure.what());
    }
    jobs.push_back(std::move(job));
  }
};

// If the path begins with a dash, puts "./" in front, because it would be read as an option otherwise.
std::string as_argument(const std::string& path) {
  return path.starts_with('-') ? "./" + path : path;
}

std::string output_of(const Json& settings, const std::string& about, const std::string& otherwise) {
  const auto pattern = settings.find("output");
  return pattern == settings.end() ? otherwise : expanded(pattern->get<std::string>(), about, false);
}

void add_jobs(Builder& builder, const Asset& asset) {
  const std::string& place = asset.rule->place;
  const std::string kind = asset.settings["bake"].get<std::string>(), file = as_argument(asset.path);
  const std::string body = output_of(asset.settings, asset.path, "");
  const bool has_input = asset.settings.contains("input");
  const std::string option = has_input ? asset.settings["input"].get<std::string>() : "";
  builder.add(place, kind, {has_input ? "--" + option + "=" + file : file}, asset.path, body, asset.settings);
  for (const char* part : {"lods", "bent", "clips"})
    if (kind != "character" && part_of(asset, part))
      refuse(builder.manifest, place + "." + part,
             "belongs only to characters, but " + asset.path + " is baked as " + kind);
  const std::string stem = body.substr(0, body.size() - std::string(".nook").size()),
                    model = as_argument(body);
  for (const std::string& lod : asset.lods) {
    const Json& settings = asset.settings["lods"];
    const std::string like_body = output_of(asset.settings, lod, "");
    builder.add(place + ".lods", "lod", {model, as_argument(lod)}, lod, output_of(settings, lod, like_body),
                settings);
  }
  for (const char* part : {"bent", "clips"})
    if (const Json* const settings = part_of(asset, part))
      builder.add(place + "." + part, part, {file, model}, asset.path,
                  output_of(*settings, asset.path, stem + "." + part + ".nook"), *settings);
}

}  // namespace

std::string report_of(const std::string& output) {
  return output.substr(0, output.rfind('.')) + ".json";
}

std::vector<Job> jobs_of(const Manifest& manifest, FileTree& tree) {
  std::vector<Asset> assets = matched_assets(manifest, tree);
  take_lods(manifest, tree, assets);
  Builder builder{manifest, {}};
  for (const Asset& asset : assets) add_jobs(builder, asset);
  if (builder.jobs.empty())
    refuse(manifest, "rules", "the rules skip every file, so nothing is left to bake; change the rules");
  return ordered_jobs(manifest, std::move(builder.jobs));
}

}  // namespace nook::tool::plan
