// The protocols of `nook evaluate nnao`. Each returns a report, and throws ToolError or Failure (cancelled).
#pragma once

#include <nlohmann/json.hpp>

#include "bakers/tool/nnao/options.h"

namespace nook::tool {

// AO of single frames, by every method and number of taps.
nlohmann::ordered_json evaluate_views(EvaluateNnaoOptions& options);

// Bent normals and specular occlusion in place of AO.
nlohmann::ordered_json evaluate_bent_normals(EvaluateNnaoOptions& options);

// Means over the frames of a moving camera in place of single frames.
nlohmann::ordered_json evaluate_sequences(EvaluateNnaoOptions& options);

// Means over frames where a skinned character walks.
nlohmann::ordered_json evaluate_movers(const EvaluateNnaoOptions& options);

// The best settings of baselines on training scenes; prints the rows of their table.
nlohmann::ordered_json evaluate_tuning(const EvaluateNnaoOptions& options);

}  // namespace nook::tool
