#include "bakers/measure/material/sweep.h"

#include "bakers/measure/material/report.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake::material;

std::string label_of(const Sweep::Series& s) {
  return s.method == Method::k_cta ? "K-CTA (" + std::to_string(s.mixture) + ")" : method_name(s.method);
}

template <class Value>
ChartLine line_of(const Sweep::Series& s, std::string label, bool dashed, const Value& value) {
  ChartLine line{std::move(label), {}, dashed};
  for (std::size_t i = 0; i < s.rows.size(); ++i)
    if (const auto y = value(s.rows[i])) line.points.push_back({double(s.ranks[i]), double(*y)});
  return line;
}

}  // namespace

Sweep measure_sweep(const RawMaterial& raw, const CompressionSettings& settings,
                    std::span<const std::uint32_t> ranks, const MethodProgress& progress) {
  for (const std::uint32_t rank : ranks)
    if (rank == 0 || rank % settings.cluster_rank_view != 0 || rank > raw.views.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "a total view rank of %u; need multiples of the cluster rank %u up to the %zu views",
                    rank, settings.cluster_rank_view, raw.views.size());
  Sweep sweep;
  sweep.ranks.assign(ranks.begin(), ranks.end());
  sweep.series = {{Method::n_svd, 1, {}, {}},
                  {Method::cta, 1, {}, {}},
                  {Method::k_cta, 2, {}, {}},
                  {Method::k_cta, 3, {}, {}},
                  {Method::k_cta, 4, {}, {}}};
  for (Sweep::Series& series : sweep.series)
    for (const std::uint32_t rank : ranks) {
      CompressionSettings s = settings;
      s.method = series.method;
      s.mixture = series.mixture;
      s.rank_view = rank;
      s.clusters = 0;
      if (s.method == Method::k_cta && s.mixture > s.cluster_count()) continue;
      const std::string prefix = label_of(series) + " at " + std::to_string(rank) + ": ";
      series.rows.push_back(measure_method(raw, s, progress(prefix)));
      series.ranks.push_back(rank);
    }
  return sweep;
}

std::vector<Chart> sweep_charts(const Sweep& sweep, const std::string& material) {
  const std::string axis = "total view rank";
  Chart signal{material + ": BTF", axis, "S/E, dB", false, {}};
  Chart distance{material + ": VOTF, signed distances", axis, "error texels", true, {}};
  Chart forms{material + ": VOTF, binary masks against distances", axis, "error texels", true, {}};
  for (const Sweep::Series& s : sweep.series) {
    const bool dashed = s.method != Method::k_cta;
    signal.lines.push_back(
        line_of(s, label_of(s), dashed, [](const MethodRow& r) { return std::optional(r.se_db); }));
    const auto of_distance = [](const MethodRow& r) { return r.error_texels_distance; };
    const auto of_binary = [](const MethodRow& r) { return r.error_texels_binary; };
    distance.lines.push_back(line_of(s, label_of(s), dashed, of_distance));
    if (s.method == Method::k_cta && s.mixture != 3) continue;
    const int colour = int(forms.lines.size() / 2);
    forms.lines.push_back(line_of(s, label_of(s) + " (S)", false, of_distance));
    forms.lines.push_back(line_of(s, label_of(s) + " (B)", true, of_binary));
    for (ChartLine* line : {&forms.lines.back(), &forms.lines.back() - 1}) line->colour = colour;
  }
  return {signal, distance, forms};
}

nlohmann::ordered_json sweep_rows(const Sweep& sweep, const std::string& material) {
  auto rows = nlohmann::ordered_json::array();
  for (const Sweep::Series& s : sweep.series)
    for (const MethodRow& row : s.rows) rows.push_back(report_row(material, row));
  return rows;
}

std::uint32_t crossing_rank(const Sweep::Series& s) {
  std::uint32_t crossing = 0;
  for (std::size_t i = s.rows.size(); i-- > 0;) {
    const auto &binary = s.rows[i].error_texels_binary, &distance = s.rows[i].error_texels_distance;
    if (!binary || !distance || *distance > *binary) break;
    crossing = s.ranks[i];
  }
  return crossing;
}

}  // namespace nook::measure
