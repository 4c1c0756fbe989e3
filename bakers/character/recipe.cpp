#include "bakers/character/recipe.h"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>

#include "bakers/character/auto_poses.h"
#include "bakers/character/mesh_choice.h"
#include "bakers/character/pose_sets.h"
#include "bakers/character/pose_variants.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/character/rig_file.h"
#include "bakers/character/torn_edges.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/hash.h"
#include "sdk/src/core/version.h"

namespace nook::bake {

PresetValues preset_values(Preset preset, FitMethod fit) {
  // A step of mini-batches is cheap, but a round of block descent is not.
  const bool paper = fit == FitMethod::paper;
  PresetValues v;
  v.settings.fit = fit;
  switch (preset) {
    case Preset::draft:
      v.settings.rays = 16;
      v.settings.steps = paper ? 3 : 1500;
      v.auto_poses = 300;
      v.clip_poses = 200;
      v.single_joint_steps = 3;
      break;
    case Preset::standard:
      // Few rays on many poses give the best model. The noise of the rays averages out over the poses, but a
      // model cannot learn what no pose shows.
      v.settings.rays = 16;
      v.settings.steps = paper ? 20 : 20000;
      v.auto_poses = 2700;
      v.clip_poses = 1100;
      break;
    case Preset::production:
      v.settings.rays = 32;
      v.settings.steps = paper ? 100 : 60000;
      v.auto_poses = 10000;
      v.clip_poses = 4000;
      if (!paper) {
        // More key points lower the error (docs/character.md), but an update takes a fifth longer.
        v.settings.key_points = 800;
        v.settings.spheres = 100;
      }
      // This limit is higher than in the other presets, so that files with few clips get more poses too.
      v.max_samples_per_clip = 256;
      break;
  }
  return v;
}

std::size_t samples_per_clip(const PresetValues& values, std::size_t clips) {
  return clips == 0 ? 0
                    : std::clamp<std::size_t>((values.clip_poses + clips / 2) / clips, 4,
                                              values.max_samples_per_clip);
}

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array preset_names{"draft", "standard", "production"};
constexpr std::array pose_names{"auto", "single-joint", "clips", "all", "extra"};
constexpr std::array kernel_names{"paper", "nook", "rational"};
static_assert(kernel_names.size() == kernel_form_count);
constexpr std::array fit_names{"nook", "paper"};

template <std::size_t N>
std::size_t index_of(const std::array<const char*, N>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "the recipe of the model contains \"%s\", which this version does not know; bake the model again",
        name.c_str());
  return std::size_t(found - names.begin());
}

std::string hex(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof text, "%016" PRIx64, value);
  return text;
}

std::string hash_of_names(const ImportedCharacter& character) {
  std::string all;
  for (std::size_t clip : clips_by_name(character)) (all += character.clips[clip].name) += '\0';
  return hex(hash64(std::as_bytes(std::span(all))));
}

// Returns one hexadecimal digit for every four clips. The first clip is the lowest bit of the first digit.
std::string clip_bits(const ImportedCharacter& character, const std::vector<std::size_t>& chosen) {
  const std::vector<std::size_t> order = clips_by_name(character);
  std::vector<unsigned> digits((order.size() + 3) / 4, 0);
  for (std::size_t i = 0; i < order.size(); ++i)
    if (std::find(chosen.begin(), chosen.end(), order[i]) != chosen.end()) digits[i / 4] |= 1u << (i % 4);
  std::string text;
  for (unsigned d : digits) text += "0123456789abcdef"[d];
  return text;
}

std::vector<std::size_t> clips_of_bits(const ImportedCharacter& character, const std::string& bits) {
  const std::vector<std::size_t> order = clips_by_name(character);
  if (bits.size() != (order.size() + 3) / 4)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the model was baked from a file with other clips; bake the model again");
  std::vector<std::size_t> clips;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t digit = std::string("0123456789abcdef").find(bits[i / 4]);
    if (digit == std::string::npos)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "the clip list in the model's recipe is damaged; bake the model again");
    if (digit >> (i % 4) & 1) clips.push_back(order[i]);
  }
  return clips;
}

// Reads the mesh selection from the JSON of a recipe.
MeshSelection meshes_of(const Json& j) {
  MeshSelection meshes;
  if (!j.contains("meshes")) return meshes;
  const Json& stored = j.at("meshes");
  if (stored.contains("only")) meshes.only = stored.at("only").get<std::vector<std::string>>();
  if (stored.contains("without")) meshes.without = stored.at("without").get<std::vector<std::string>>();
  return meshes;
}

}  // namespace

std::string content_digits(const ImportedCharacter& character) {
  return hex(character.source_hash);
}

bool reads_other_content(const Recipe& recipe, const ImportedCharacter& character) {
  return !recipe.content.empty() && recipe.content != content_digits(character);
}

MeshSelection stored_meshes(std::string_view recipe_text) {
  try {
    const Json j = Json::parse(recipe_text);
    return j.is_object() ? meshes_of(j) : MeshSelection();
  } catch (const Json::exception&) {
    return {};
  }
}

const char* name_of(Preset preset) {
  return preset_names[std::size_t(preset)];
}
const char* name_of(PoseMode mode) {
  return pose_names[std::size_t(mode)];
}
const char* name_of(KernelForm form) {
  return kernel_names[std::size_t(form)];
}
const char* name_of(FitMethod fit) {
  return fit_names[std::size_t(fit)];
}

std::vector<std::size_t> clips_by_name(const ImportedCharacter& character) {
  std::vector<std::size_t> order(character.clips.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return character.clips[a].name < character.clips[b].name; });
  return order;
}

double torn_by_clips(const ImportedCharacter& character) {
  constexpr std::size_t samples_per_clip = 8;
  return torn_share(character.mesh, clip_poses(character, motion_clips(character), samples_per_clip));
}

std::vector<Pose> automatic_poses(const ImportedCharacter& character, const Recipe& recipe, std::size_t count,
                                  std::uint64_t seed) {
  if (count == 0) return {};
  const std::vector<float> area = vertex_areas(character.mesh, character.mesh.position);
  return auto_poses(character.mesh, area, count, seed, recipe.rig, torn_by_clips(character));
}

namespace {

// Returns true if this version makes the same poses as the version that made the recipe.
bool makes_same_poses(const ImportedCharacter& character, const Recipe& recipe) {
  if (recipe.generation == pose_generation) return true;
  if (recipe.generation != 3 && recipe.generation != 4) return false;
  if (is_person(character.mesh, named_roles(character.mesh)))
    return !differs_from_generation_4(character.mesh, recipe.rig);
  return recipe.generation == 4 && recipe.clips.empty();
}

}  // namespace

std::vector<Pose> recipe_poses(const ImportedCharacter& character, const Recipe& recipe) {
  if (!makes_same_poses(character, recipe) && recipe.auto_poses + recipe.variant_poses > 0)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "this version of Nook generates other training poses than the version that baked the model "
                  "(got generation %d, need %d); bake the model again",
                  recipe.generation, pose_generation);
  std::vector<Pose> poses;
  const std::vector<float> area = vertex_areas(character.mesh, character.mesh.position);
  const auto add = [&](std::vector<Pose> more) {
    poses.insert(poses.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  std::vector<Pose> shown;
  if (!recipe.clips.empty()) shown = clip_poses(character, recipe.clips, recipe.samples_per_clip);
  add(automatic_poses(character, recipe, recipe.auto_poses, recipe.settings.seed));
  if (!shown.empty()) {
    std::vector<Pose> variants =
        pose_variants(character.mesh, area, shown, recipe.variant_poses, recipe.settings.seed, recipe.rig);
    add(std::move(shown));
    add(std::move(variants));
  }
  if (recipe.single_joint_steps > 0)
    add(single_joint_poses(character.mesh, recipe.single_joint_steps, single_joint_range));
  return poses;
}

std::string recipe_text(const ImportedCharacter& character, const Recipe& recipe) {
  const BakeSettings& s = recipe.settings;
  Json j;
  j["nook"] = version_text;
  j["content"] = recipe.content;
  j["preset"] = name_of(recipe.preset);
  j["poses"] = name_of(recipe.poses);
  j["auto_poses"] = recipe.auto_poses;
  if (!character.clips.empty()) {
    j["clips"] = clip_bits(character, recipe.clips);
    j["clip_names"] = hash_of_names(character);
  }
  j["samples_per_clip"] = recipe.samples_per_clip;
  j["variant_poses"] = recipe.variant_poses;
  j["generation"] = recipe.generation;
  j["single_joint_steps"] = recipe.single_joint_steps;
  j["extra_poses"] = recipe.extra_poses;
  store_meshes(j, recipe.meshes);
  if (!recipe.rig.empty()) j["rig"] = Json::parse(rig_text(character.mesh, recipe.rig));
  j["seed"] = s.seed;
  j["rays"] = s.rays;
  j["spheres"] = s.spheres;
  j["key_points"] = s.key_points;
  j["entries"] = s.entries;
  j["steps"] = s.steps;
  j["kernel"] = name_of(s.kernel.form);
  j["fit"] = name_of(s.fit);
  if (s.learn_gamma)
    j["gamma"] = "learned";
  else
    j["gamma"] = s.kernel.gamma;
  j["saturation"] = s.used_saturation();
  j["time_limit_s"] = s.time_limit_s;
  return j.dump();
}

Recipe read_recipe(const ImportedCharacter& character, std::string_view text) {
  try {
    const Json j = Json::parse(text);
    Recipe r;
    r.preset = Preset(index_of(preset_names, j.at("preset")));
    r.poses = PoseMode(index_of(pose_names, j.at("poses")));
    r.auto_poses = j.at("auto_poses");
    r.content = j.value("content", std::string());
    r.meshes = meshes_of(j);
    if (j.contains("clips")) {
      if (j.at("clip_names") != hash_of_names(character))
        throw Failure(NOOK_ERROR_BAD_FILE,
                      "the model was baked from a file with other clips; bake the model again");
      r.clips = clips_of_bits(character, j.at("clips"));
    }
    r.samples_per_clip = j.at("samples_per_clip");
    // Older files without variant poses lack the variant keys.
    r.variant_poses = j.value("variant_poses", std::size_t(0));
    r.generation = j.value("generation", 1);
    r.single_joint_steps = j.at("single_joint_steps");
    r.extra_poses = j.at("extra_poses");
    if (j.contains("rig")) r.rig = read_rig(character.mesh, j.at("rig").dump());
    r.settings.seed = j.at("seed");
    r.settings.rays = j.at("rays");
    r.settings.spheres = j.at("spheres");
    r.settings.key_points = j.at("key_points");
    r.settings.steps = j.at("steps");
    r.settings.entries = j.value("entries", r.settings.entries);
    // Recipes of earlier versions have no gamma.
    if (const auto gamma = j.find("gamma"); gamma != j.end()) {
      r.settings.learn_gamma = *gamma == "learned";
      if (gamma->is_number()) r.settings.kernel.gamma = *gamma;
    }
    r.settings.kernel.form = KernelForm(index_of(kernel_names, j.at("kernel")));
    r.settings.fit = FitMethod(index_of(fit_names, j.at("fit")));
    // Recipes of character files up to version 3 have no saturation.
    r.settings.saturation = j.value("saturation", 0.0f);
    r.settings.time_limit_s = j.at("time_limit_s");
    return r;
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& e) {
    throw Failure(NOOK_ERROR_BAD_FILE, "the model's recipe cannot be read (%s); bake the model again",
                  e.what());
  }
}

}  // namespace nook::bake
