#include "bakers/tool/compression_options.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"

namespace nook::tool {
namespace {

using namespace bake::material;
using nook::material::VisibilityForm;

std::vector<std::uint32_t> read_numbers(const std::string& text, std::size_t count, const char* option) {
  std::vector<std::uint32_t> numbers;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, comma - at);
    if (part.empty() || part.size() > 6 || part.find_first_not_of("0123456789") != std::string::npos) break;
    numbers.push_back(std::uint32_t(std::stoul(part)));
    at = comma + 1;
  }
  if (numbers.size() != count || at != text.size() + 1)
    throw ToolError(exit_bad_arguments, std::string(option) + ": got " + text + ", need " +
                                            std::to_string(count) +
                                            " whole numbers with commas between them");
  return numbers;
}

}  // namespace

void add_compression_options(Command command, CompressionOptions& o) {
  CompressionSettings& s = o.settings;
  s.bits = default_bits;
  command
      .add_option("--ranks", o.ranks,
                  "number of components (rank) that the compressed colours (BTF) keep for light (L), views "
                  "(V, of all clusters together) and texels (X and Y). Higher ranks give a smaller error and "
                  "a larger file. auto chooses the ranks by --threshold. Default: fixed ranks for each "
                  "built-in structure, auto for other materials")
      .type_name("L,V,X,Y|auto");
  command
      .add_option(
          "--votf-ranks", o.votf_ranks,
          "number of components (rank) that the compressed visibility (VOTF) keeps along the texture's x and "
          "y. Default: as --ranks chooses them; 80,80 if --ranks has numbers, or fewer for small textures")
      .type_name("X,Y");
  command
      .add_option("--threshold", o.threshold,
                  "for --ranks auto: largest squared error that each of L, V, X and Y may add, divided by "
                  "the sum of the squared values of the material")
      .check(in_range(1e-6, 0.5))
      .capture_default_str();
  command
      .add_option("--cluster-rank", s.cluster_rank_view,
                  "rank of each view cluster: the number of view components that a cluster keeps")
      .check(in_range(1, 64))
      .capture_default_str();
  command
      .add_option("--clusters", s.clusters,
                  "number of view clusters (groups of similar views). Default: V of --ranks divided by "
                  "--cluster-rank")
      .check(in_range(1, 1024));
  command
      .add_option("--mixture", s.mixture, "number of clusters that each view is mixed from (the K of K-CTA)")
      .check(in_range(1, 8))
      .capture_default_str();
  command
      .add_option("--votf-refits", s.votf_refits,
                  "number of additional fits of the visibility (VOTF). They correct only the values that lie "
                  "on the wrong side of the threshold between visible and hidden")
      .check(in_range(0, 16))
      .capture_default_str();
  command
      .add_option("--bits", s.bits,
                  "bits of each stored number, in the file and in textures: 8 (integers), or 16 (half "
                  "floats, twice the size and 0.1 dB better)")
      .check(one_of_numbers({8, 16}))
      .capture_default_str();
  command
      .add_option_function(
          "--seeding",
          [&s](const std::string& v) { s.seeding = v == "values" ? Seeding::values : Seeding::directions; },
          "how views are first grouped into clusters: directions (default, by view direction) or values (by "
          "k-means over their values)")
      .check(one_of({"directions", "values"}))
      .type_name("NAME");
}

namespace {

// Sets the ranks of the BTF to the given ranks, or to the ranks of a built-in material. Returns false if the
// threshold determines the ranks.
bool set_known_ranks(const CompressionOptions& options, const RawMaterial& raw, CompressionSettings& s) {
  if (options.ranks.empty()) return set_builtin_ranks(raw, s);
  if (options.ranks == "auto") return false;
  const auto r = read_numbers(options.ranks, 4, "--ranks");
  s.rank_light = r[0];
  s.rank_view = r[1];
  s.rank_x = r[2];
  s.rank_y = r[3];
  s.votf_rank_x = std::min(s.votf_rank_x, raw.width);
  s.votf_rank_y = std::min(s.votf_rank_y, raw.height);
  return true;
}

void set_rest(const CompressionOptions& options, CompressionSettings& s) {
  if (!options.votf_ranks.empty()) {
    const auto r = read_numbers(options.votf_ranks, 2, "--votf-ranks");
    s.votf_rank_x = r[0];
    s.votf_rank_y = r[1];
  }
  if (votf_settings(s).method == Method::k_cta && options.settings.clusters == 0)
    s.mixture = std::min(s.mixture, s.cluster_count());
}

}  // namespace

CompressionSettings compression_settings(const CompressionOptions& options, const RawMaterial& raw) {
  CompressionSettings s = options.settings;
  const bool has_ranks = s.method != Method::neural || has_votf(raw, s);
  if (has_ranks && !set_known_ranks(options, raw, s)) s = ranks_by_threshold(raw, options.threshold, s);
  set_rest(options, s);
  check_settings(s, raw);
  return s;
}

void check_compression(const CompressionOptions& options, const RawMaterial& sizes, bool has_mask) {
  CompressionSettings s = options.settings;
  if (s.method == Method::neural) check_neural(s);
  if (!set_known_ranks(options, sizes, s)) set_lowest_ranks(sizes, s);
  set_rest(options, s);
  if (!sizes.views.empty()) check_settings(s, sizes, has_mask);
}

nook::material::VisibilityMapping visibility_mapping(const std::string& text, VisibilityForm form) {
  if (text == "paper") return nook::material::paper_mapping(form);
  nook::material::VisibilityMapping mapping;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%f,%f%c", &mapping.threshold, &mapping.weight, &rest) != 2)
    throw ToolError(exit_bad_arguments, "--visibility-mapping: got " + text +
                                            ", need two numbers T,W, such as 0.05,12, or the word paper");
  return mapping;
}

StageProgress stage_progress(platform::ProgressBar& bar, std::string prefix) {
  return [&bar, prefix = std::move(prefix)](const char* stage, std::size_t done, std::size_t total) {
    bar.show(prefix + stage, "steps", done, total);
    return !interrupted();
  };
}

}  // namespace nook::tool
