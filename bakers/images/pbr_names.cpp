#include "bakers/images/pbr_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

bool is_upper(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// "Bricks090_4K_NormalGL" is bricks, k, normal, gl.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  char before = 0;
  for (const char c : name) {
    const bool starts = is_letter(c) && (!is_letter(before) || (is_upper(c) && !is_upper(before)));
    if (starts) words.emplace_back();
    if (is_letter(c)) words.back() += char(std::tolower(static_cast<unsigned char>(c)));
    before = c;
  }
  return words;
}

struct Word {
  std::string_view text;
  std::optional<PbrMap> map;  // none: a map without use here
};

constexpr std::array words{Word{"albedo", PbrMap::base_colour},
                           Word{"basecolor", PbrMap::base_colour},
                           Word{"basecolour", PbrMap::base_colour},
                           Word{"color", PbrMap::base_colour},
                           Word{"colour", PbrMap::base_colour},
                           Word{"col", PbrMap::base_colour},
                           Word{"diffuse", PbrMap::base_colour},
                           Word{"diff", PbrMap::base_colour},
                           Word{"alb", PbrMap::base_colour},
                           Word{"normal", PbrMap::normal},
                           Word{"normals", PbrMap::normal},
                           Word{"nor", PbrMap::normal},
                           Word{"norm", PbrMap::normal},
                           Word{"nrm", PbrMap::normal},
                           Word{"normalgl", PbrMap::normal},
                           Word{"normaldx", PbrMap::normal},
                           Word{"roughness", PbrMap::roughness},
                           Word{"rough", PbrMap::roughness},
                           Word{"rgh", PbrMap::roughness},
                           Word{"gloss", PbrMap::gloss},
                           Word{"glossiness", PbrMap::gloss},
                           Word{"smoothness", PbrMap::gloss},
                           Word{"metalness", PbrMap::metalness},
                           Word{"metallic", PbrMap::metalness},
                           Word{"metal", PbrMap::metalness},
                           Word{"metallness", PbrMap::metalness},
                           Word{"height", PbrMap::height},
                           Word{"displacement", PbrMap::height},
                           Word{"disp", PbrMap::height},
                           Word{"bump", PbrMap::height},
                           Word{"arm", PbrMap::packed},
                           Word{"orm", PbrMap::packed},
                           Word{"ao", {}},
                           Word{"occlusion", {}},
                           Word{"ambientocclusion", {}},
                           Word{"opacity", {}},
                           Word{"alpha", {}},
                           Word{"emission", {}},
                           Word{"emissive", {}},
                           Word{"specular", {}},
                           Word{"spec", {}},
                           Word{"preview", {}}};

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string list_of(std::span<const std::string> names) {
  constexpr std::size_t most = 6;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    list += (i ? ", " : "") + names[i].substr(0, 60);
  return list + (names.size() > most ? ", ..." : "");
}

// The places that files take, before some give way to others.
struct Places {
  std::optional<std::size_t> base_colour, normal_up, normal_down, roughness, gloss, metalness, height, packed;

  std::optional<std::size_t>& of(const PbrName& name) {
    switch (name.map) {
      case PbrMap::base_colour:
        return base_colour;
      case PbrMap::normal:
        return name.green_down ? normal_down : normal_up;
      case PbrMap::roughness:
        return roughness;
      case PbrMap::gloss:
        return gloss;
      case PbrMap::metalness:
        return metalness;
      case PbrMap::height:
        return height;
      case PbrMap::packed:
        break;
    }
    return packed;
  }
};

}  // namespace

std::optional<PbrName> parse_pbr_name(std::string_view name) {
  if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) name = name.substr(0, dot);
  std::optional<PbrMap> map;
  bool green_down = false;
  std::vector<std::string> parts = words_of(name);
  // A picture of a whole material, such as "Metal032_1K.png", begins with the name of the material.
  if (parts.size() > 1 && parts.front() == "metal") parts.erase(parts.begin());
  for (const std::string& word : parts) {
    const auto* const known =
        std::find_if(words.begin(), words.end(), [&](const Word& w) { return w.text == word; });
    if (known != words.end()) map = known->map;
    green_down = green_down || is_one_of(word, {"dx", "directx", "normaldx"});
  }
  if (!map) return std::nullopt;
  return PbrName{*map, *map == PbrMap::normal && green_down};
}

PbrFiles arrange_pbr_names(std::span<const std::string> names) {
  Places places;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto name = parse_pbr_name(names[i]);
    if (!name) continue;
    std::optional<std::size_t>& place = places.of(*name);
    if (place)
      throw Failure(NOOK_ERROR_BAD_FILE, "%.150s and %.150s are the same map by their names; one is needed",
                    names[*place].c_str(), names[i].c_str());
    place = i;
  }
  if (!places.base_colour)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "no image is a base colour by its name (got %s; need a name with albedo, base color, color or "
        "diffuse)",
        names.empty() ? "no image" : list_of(names).c_str());
  PbrFiles files;
  files.base_colour = *places.base_colour;
  files.normal = places.normal_up ? places.normal_up : places.normal_down;
  files.green_down = !places.normal_up;
  files.roughness = places.roughness ? places.roughness : places.gloss;
  files.roughness_is_gloss = !places.roughness && places.gloss;
  files.metalness = places.metalness;
  files.height = places.height;
  files.packed = places.packed;
  return files;
}

}  // namespace nook::bake::material
