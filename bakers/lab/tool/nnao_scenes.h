// What the protocols of `nook-lab evaluate nnao` share: scenes from the command line or from a list of test
// views, their ray-traced views, and the end of all reports.
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

// Takes size and rays from the list of --views if the command line has none. Throws ToolError.
Work read_work(EvaluateNnaoOptions& options);

// Traces the scene's views, or reads them from the folder of references; shows progress, and can be
// interrupted. Throws ToolError that names the scene's file.
std::vector<MeasuredView> traced_views(const SceneRequest& scene, const EvaluateNnaoOptions& options);

std::vector<MeasuredView> traced_views(const Work& work, const EvaluateNnaoOptions& options);

// Adds the conditions of all rows of a report: rays per reference, OpenGL and the seed.
void add_conditions(nlohmann::ordered_json& report, const EvaluateNnaoOptions& options,
                    platform::Context& context);

// Returns the largest radius on the screen that every method uses, in pixels.
float max_radius_px(const EvaluateNnaoOptions& options);

}  // namespace nook::lab
