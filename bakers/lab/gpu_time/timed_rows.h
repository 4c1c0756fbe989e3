// The timed passes. Each function returns rows of one kind, in the order of the tables.
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

// The context, and what the rows share.
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

// Times the screen pass in its forms and every method of the comparison with its own denoiser, drawn with
// fragment shaders. The view shows a procedural room at a radius of 0.5 metres. Also times the compute path.
std::vector<TimedRow> time_screen(const Timing& timing);

// Times nook_gl_scene_update for crowds on the ground with changing poses, without neighbours and with four.
// model: a file for nook_model_load.
std::vector<TimedRow> time_characters(const Timing& timing, const std::filesystem::path& model);

// The world pass: 100 bodies darken the floor on which they stand.
std::vector<TimedRow> time_world(const Timing& timing, const std::filesystem::path& model);

// Fills the whole image with one material in one light, for each file of nook_material_load.
std::vector<TimedRow> time_materials(const Timing& timing, const std::vector<std::filesystem::path>& files);

// Fills the whole image with the irradiance and the glossy reflection of lobes, from a grid and from one
// place.
std::vector<TimedRow> time_probes(const Timing& timing);

}  // namespace nook::lab
