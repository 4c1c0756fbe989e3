// The timed passes: rows of one kind in each function, in the order of the tables.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bakers/lab/gpu_time/gpu_clock.h"
#include "bakers/measure/nnao/network_pass.h"

namespace nook::lab {

struct TimedRow {
  std::string name;
  GpuTime time;
};

// The context and what the rows share.
struct Timing {
  platform::Context& context;
  const measure::NookGl& nook;
  const GpuClock& clock;
  int width, height;  // pixels
  std::function<bool(const std::string&)> wanted;

  void add(std::vector<TimedRow>& rows, const std::string& name, const std::function<void()>& call,
           const std::function<void()>& prepare = {}) const {
    if (wanted(name)) rows.push_back({name, clock.time(call, prepare)});
  }
};

// The screen pass in its forms and every method of the comparison with its own denoiser, all drawn with
// fragment shaders, over one view of a procedural room at a radius of 0.5 metres; and the compute path.
std::vector<TimedRow> time_screen(const Timing& timing);

// nook_gl_scene_update of crowds that stand on the ground, without neighbours and with four, with poses that
// change. model: a file of nook_model_load.
std::vector<TimedRow> time_characters(const Timing& timing, const std::filesystem::path& model);

// The world pass: 100 bodies darken the floor on which they stand.
std::vector<TimedRow> time_world(const Timing& timing, const std::filesystem::path& model);

// The whole image in one material and one light, for each file of nook_material_load.
std::vector<TimedRow> time_materials(const Timing& timing, const std::vector<std::filesystem::path>& files);

// The whole image in the irradiance and in the glossy reflection of lobes, of a grid and of one place.
std::vector<TimedRow> time_probes(const Timing& timing);

}  // namespace nook::lab
