// What the commands on materials share: the options of compression, and what a report says.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/progress_bar.h"
#include "material/comparison.h"

namespace CLI {
class App;
}

namespace nook::cli {

struct CompressionOptions {
  std::string ranks, votf_ranks;  // as given; empty: the material's defaults
  double threshold = 0.01;        // of --ranks auto
  bake::material::CompressionSettings settings;
};

void add_compression_options(CLI::App& command, CompressionOptions& options);

// The settings for a material: given ranks, or those of the built-in materials, or ranks by threshold. Throws
// ToolError for ranks that cannot be read, Failure for ranks that do not fit.
bake::material::CompressionSettings compression_settings(const CompressionOptions& options,
                                                         const bake::material::RawMaterial& raw);

// "T,W", or "paper": the paper's numbers for the form. Throws ToolError for a text that is neither.
nook::material::VisibilityMapping visibility_mapping(const std::string& text,
                                                     nook::material::VisibilityForm form);

nlohmann::ordered_json report_row(const std::string& material, const bake::material::MethodRow& row);
nlohmann::ordered_json describe(const bake::material::CompressionSettings& settings);

// The most memory that the process has held so far.
std::size_t peak_bytes();

// Shows stages on a bar and stops at Ctrl-C.
bake::material::StageProgress stage_progress(ProgressBar& bar, std::string prefix);

}  // namespace nook::cli
