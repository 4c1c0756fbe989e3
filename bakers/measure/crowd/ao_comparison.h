// The crowd's ambient occlusion against ray tracing: errors, and two sheets of pictures.
#pragma once

#include <string>

#include "bakers/measure/crowd/errors.h"
#include "bakers/measure/crowd/subject.h"

namespace nook::measure::crowd {

struct FormErrors {
  std::string form;
  Errors errors;
};

struct AoErrors {
  std::uint32_t rays = 0;         // for each vertex of the reference
  double noise_floor_mse = 0;     // the reference's own error
  std::size_t characters = 0;     // that were measured
  bool have_neighbours = false;   // each has another character within 1 m
  std::vector<FormErrors> forms;  // with several sets of terms, and the static AO
  double links_cut_mse_area = 0;  // share of the error that the neighbours' terms remove
};

AoErrors measure_ao(const Subject& subject);

// The screen-space pass that panels show.
struct ScreenSpaceSettings {
  int taps = 64;
  bool half_resolution = false;
  float radius_m = 0.5f;
};

// The group with no AO, static AO, Nook's AO by terms, the reference, and the difference of the two.
// Screen-space AO appears in three more panels unless the settings are null: alone, on the floor beside
// Nook's AO, and, traced with rays of the same radius, on the reference's floor.
platform::Image ao_sheet(const Subject& subject, const ScreenSpaceSettings* screen_space);

// The group by Nook's default form and by one norm over the spheres of all bodies, once with the model's
// gamma and once with the gamma 2 of the paper, beside the reference. Without the ground, whose darkening
// would hide what overlapping spheres do. The subject's own evaluation is the default form.
platform::Image double_shadowing_sheet(const Subject& subject, EvaluatedCrowd& one_norm,
                                       EvaluatedCrowd& one_norm_gamma_2);

}  // namespace nook::measure::crowd
