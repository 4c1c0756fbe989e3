// The options for the compression, which several commands on materials share.
#pragma once

#include <string>

#include "bakers/job/material_bake.h"
#include "platform/progress_bar.h"

namespace nook::tool {

class Command;

struct CompressionOptions {
  std::string ranks, votf_ranks;  // as the user gave them; empty: the material's defaults
  double threshold = 0.01;        // only used with --ranks auto
  bake::material::CompressionSettings settings;
};

void add_compression_options(Command command, CompressionOptions& options);

// Returns the settings for a material. The ranks are those that the user gave, or those of a built-in
// material, or they are chosen by the threshold. Throws ToolError for unreadable ranks, and Failure for ranks
// that are not possible for the material.
bake::material::CompressionSettings compression_settings(const CompressionOptions& options,
                                                         const bake::material::RawMaterial& raw);

// Throws the errors that compression_settings would throw for a material of these sizes, except errors that
// depend on the material's values. A bake calls this before it traces rays. Set has_mask if the views will
// have a mask. If `sizes` has no views, the sizes are not known yet, and only the texts of the options are
// checked.
void check_compression(const CompressionOptions& options, const bake::material::RawMaterial& sizes,
                       bool has_mask);

// Parses "T,W". Also accepts "paper", which stands for the values that the paper uses with this form. Throws
// ToolError for any other text.
nook::material::VisibilityMapping visibility_mapping(const std::string& text,
                                                     nook::material::VisibilityForm form);

// Returns a callback that shows stages on a progress bar and stops at Ctrl-C.
bake::material::StageProgress stage_progress(platform::ProgressBar& bar, std::string prefix);

}  // namespace nook::tool
