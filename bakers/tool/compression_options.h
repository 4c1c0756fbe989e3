// The options of compression, which the commands on materials share.
#pragma once

#include <string>

#include "bakers/job/material_bake.h"
#include "platform/progress_bar.h"

namespace nook::tool {

class Command;

struct CompressionOptions {
  std::string ranks, votf_ranks;  // as given; empty: the material's defaults
  double threshold = 0.01;        // for --ranks auto
  bake::material::CompressionSettings settings;
};

void add_compression_options(Command command, CompressionOptions& options);

// Returns the settings for a material, with given ranks, ranks of the built-in materials, or ranks by
// threshold. Throws ToolError for unreadable ranks, Failure for ranks that do not fit.
bake::material::CompressionSettings compression_settings(const CompressionOptions& options,
                                                         const bake::material::RawMaterial& raw);

// Throws what compression_settings throws for a material of these sizes, unless its values decide. A bake
// calls this before it traces rays. has_mask: the views will have a mask. Without views the sizes are
// unknown, and only the texts are checked.
void check_compression(const CompressionOptions& options, const bake::material::RawMaterial& sizes,
                       bool has_mask);

// Reads "T,W", or "paper" for the paper's numbers for the form. Throws ToolError for any other text.
nook::material::VisibilityMapping visibility_mapping(const std::string& text,
                                                     nook::material::VisibilityForm form);

// Shows stages on a bar and stops at Ctrl-C.
bake::material::StageProgress stage_progress(platform::ProgressBar& bar, std::string prefix);

}  // namespace nook::tool
