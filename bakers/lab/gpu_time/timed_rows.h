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

// The context and the settings that all rows share.
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

// Times the variants of the screen pass, and every method of the comparison with its own denoiser. All are
// drawn with fragment shaders. Also times the compute path. The view shows a procedural room, and the AO
// radius is 0.5 metres.
std::vector<TimedRow> time_screen(const Timing& timing);

// Times nook_gl_scene_update for crowds on the ground with changing poses. Crowds are timed without linked
// neighbours and with four linked neighbours per body. `model` is a file for nook_model_load.
std::vector<TimedRow> time_characters(const Timing& timing, const std::filesystem::path& model);

// Times the world pass while 100 bodies darken the floor on which they stand.
std::vector<TimedRow> time_world(const Timing& timing, const std::filesystem::path& model);

// Measures how long it takes to fill the whole image with one material under one light. `files` are files for
// nook_material_load, one per row.
std::vector<TimedRow> time_materials(const Timing& timing, const std::vector<std::filesystem::path>& files);

// Measures how long it takes to fill the whole image with the irradiance and the glossy reflection of probe
// lobes. The lobes come from a grid or from a single probe.
std::vector<TimedRow> time_probes(const Timing& timing);

}  // namespace nook::lab
