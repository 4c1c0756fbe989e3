#include "bakers/measure/character/specular_numbers.h"

#include <cstdio>
#include <span>

#include "shaders/character/specular_numbers.h"

namespace nook::measure {
namespace {

constexpr std::size_t units = nook::nnao::SpecularNumbers::units,
                      inputs = nook::nnao::SpecularNumbers::inputs;

// Each row has two lines of four numbers.
void append_row(std::string& text, int& line, std::span<const float, units> row) {
  char part[160];
  for (std::size_t first = 0; first < units; first += 4) {
    std::snprintf(part, sizeof part, "#define NOOK_SCENE_SPECULAR_%d %.5f, %.5f, %.5f, %.5f\n", line++,
                  double(row[first]), double(row[first + 1]), double(row[first + 2]), double(row[first + 3]));
    text += part;
  }
}

}  // namespace

nook::nnao::SpecularNumbers character_specular_numbers() {
  constexpr float rows[7][8] = {
      {NOOK_SCENE_SPECULAR_0, NOOK_SCENE_SPECULAR_1},   {NOOK_SCENE_SPECULAR_2, NOOK_SCENE_SPECULAR_3},
      {NOOK_SCENE_SPECULAR_4, NOOK_SCENE_SPECULAR_5},   {NOOK_SCENE_SPECULAR_6, NOOK_SCENE_SPECULAR_7},
      {NOOK_SCENE_SPECULAR_8, NOOK_SCENE_SPECULAR_9},   {NOOK_SCENE_SPECULAR_10, NOOK_SCENE_SPECULAR_11},
      {NOOK_SCENE_SPECULAR_12, NOOK_SCENE_SPECULAR_13},
  };
  nook::nnao::SpecularNumbers numbers;
  for (std::size_t u = 0; u < units; ++u) {
    for (std::size_t i = 0; i < inputs; ++i) numbers.weights[i][u] = rows[i][u];
    numbers.bias[u] = rows[5][u];
    numbers.out[u] = rows[6][u];
  }
  numbers.out_bias = NOOK_SCENE_SPECULAR_BIAS;
  return numbers;
}

std::string character_specular_header(const nook::nnao::SpecularNumbers& numbers) {
  std::string text =
      "// The numbers of the specular occlusion of characters; sdk/src/nnao/lighting.h defines them. C++ "
      "and\n"
      "// GLSL both include this file, which `nook train bent` writes from the built-in character.\n"
      "#ifndef NOOK_CHARACTER_SPECULAR_NUMBERS_H\n#define NOOK_CHARACTER_SPECULAR_NUMBERS_H\n\n";
  int line = 0;
  for (const auto& row : numbers.weights) append_row(text, line, row);
  append_row(text, line, numbers.bias);
  append_row(text, line, numbers.out);
  char bias[80];
  std::snprintf(bias, sizeof bias, "#define NOOK_SCENE_SPECULAR_BIAS %.5f\n\n#endif\n",
                double(numbers.out_bias));
  return text + bias;
}

}  // namespace nook::measure
