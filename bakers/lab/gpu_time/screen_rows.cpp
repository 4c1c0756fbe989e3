#include "bakers/lab/gpu_time/timed_rows.h"
#include "bakers/lab/nnao/baseline_pass.h"
#include "bakers/raytrace/random.h"

namespace nook::lab {

using namespace measure;

namespace {

using namespace bake::nnao;

constexpr std::uint64_t seed = 4;

struct NamedForm {
  const char* name;
  NetworkForm form;
};
constexpr NamedForm forms[] = {{"NNAO 9", {9}},
                               {"NNAO 16", {16}},
                               {"NNAO 32", {32}},
                               {"NNAO 64", {64}},
                               {"NNAO 9, half", {9, true}},
                               {"NNAO 16, half", {16, true}},
                               {"NNAO 32, half", {32, true}},
                               {"NNAO 64, half", {64, true}},
                               {"NNAO 9, bent normals", {9, false, 1, true}},
                               {"NNAO 9, bent normals, half", {9, true, 1, true}},
                               {"NNAO 9, mean over frames", {9, false, 1, false, 4}},
                               {"NNAO 9, filtered twice", {9, false, 2}},
                               {"NNAO 16, compute", {16, false, 1, false, 0, NOOK_NNAO_PATH_COMPUTE}},
                               {"NNAO 64, compute", {64, false, 1, false, 0, NOOK_NNAO_PATH_COMPUTE}}};

TracedView traced_room(std::uint32_t width, std::uint32_t height) {
  bake::Random random(seed);
  const TrainingScene scene = make_room(random);
  const bake::RayScene rays(scene.soup);
  return trace_view(rays, place_camera(rays, scene, random, width, height));
}

}  // namespace

std::vector<TimedRow> time_screen(const Timing& timing) {
  const auto& [context, nook, clock, width, height, wanted] = timing;
  const GladGLContext& gl = context.gl();
  const GpuView view(gl, traced_room(std::uint32_t(width), std::uint32_t(height)));
  AoRequest request;
  // This is the same share of the image height as in the error measurements, which use 360 rows.
  request.max_radius_px = 0.25f * float(height);
  std::vector<TimedRow> rows;
  for (const NamedForm& named : forms) {
    if (!wanted(named.name)) continue;
    NetworkPass pass(nook, width, height, named.form, {}, request.blur_sharpness);
    const Mat3x4 still;
    timing.add(rows, named.name, [&] { pass.draw(view, request, true, still, false); });
  }
  BaselinePass baselines(gl, width, height);
  const auto add = [&](const BaselineMethod& method, const std::string& denoised) {
    timing.add(rows, baseline_row(method) + " " + std::to_string(method.taps) + denoised,
               [&] { baselines.draw(method, view, request, true); });
  };
  for (const BaselineMethod& method : baseline_methods()) {
    add(method, "");
    if (method.baseline != Baseline::xegtao || method.shipped) continue;
    for (const Denoiser denoiser : {Denoiser::edges_1, Denoiser::edges_2, Denoiser::edges_3}) {
      BaselineMethod own = method;
      own.tuning.denoiser = denoiser;
      add(own, std::string(", ") + denoiser_name(denoiser));
    }
  }
  return rows;
}

}  // namespace nook::lab
