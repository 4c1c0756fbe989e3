// Code that all protocols of `nook-lab evaluate nnao` share. It reads scenes from the command line or from a
// list of test views, traces their views, and writes what all reports have in common.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bakers/lab/nnao/measured_view.h"
#include "bakers/lab/nnao/screen_report.h"
#include "bakers/lab/tool/nnao_options.h"
#include "platform/platform.h"

namespace nook::lab {

// The scenes of the command line or of the list, and the ratios to report.
struct Work {
  std::vector<SceneRequest> scenes;
  std::vector<MethodRatio> ratios;
};

// If the command line does not state the image size or the number of rays, they are taken from the list of
// --views. Throws ToolError.
Work read_work(EvaluateNnaoOptions& options);

// Traces the scene's views, or reads them from the folder of cached references. Shows progress, and can be
// interrupted. Throws ToolError with the name of the scene's file.
std::vector<MeasuredView> traced_views(const SceneRequest& scene, const EvaluateNnaoOptions& options);

std::vector<MeasuredView> traced_views(const Work& work, const EvaluateNnaoOptions& options);

// Adds the conditions that hold for all rows of a report: rays per reference, OpenGL and the seed.
void add_conditions(nlohmann::ordered_json& report, const EvaluateNnaoOptions& options,
                    platform::Context& context);

// Returns the maximum AO radius on the screen, in pixels. All methods use this limit.
float max_radius_px(const EvaluateNnaoOptions& options);

}  // namespace nook::lab
