#include "bakers/lab/material/rank_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bakers/measure/material/material_report.h"
#include "sdk/src/core/failure.h"

namespace nook::lab {
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

constexpr double width = 640, height = 400, left = 70, right = 150, top = 40, bottom = 50;
// People with any colour vision can distinguish these colours (Okabe and Ito 2008).
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

std::string format(const char* pattern, auto... values) {
  char text[512];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

struct Axis {
  double low = 0, high = 1, step = 1;
  double at(double value) const { return (value - low) / (high - low); }
};

// Returns an axis with about `count` steps. A step is 1, 2 or 5 times a power of ten.
Axis round_axis(double low, double high, int count) {
  if (!(high > low)) high = low + 1;
  const double raw = (high - low) / count, power = std::pow(10, std::floor(std::log10(raw)));
  const double step = power * (raw / power < 1.5 ? 1 : raw / power < 3.5 ? 2 : raw / power < 7.5 ? 5 : 10);
  return {std::floor(low / step) * step, std::ceil(high / step) * step, step};
}

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart) {
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    for (const ChartLine& line : chart.lines)
      for (const auto& [x, y] : line.points) {
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, scaled(y));
        y1 = std::max(y1, scaled(y));
      }
    if (x0 > x1) x0 = 0, x1 = 1, y0 = 0, y1 = 1;
    x_ = round_axis(x0, x1, 8);
    y_ = chart.logarithmic ? Axis{std::floor(y0), std::max(std::ceil(y1), std::floor(y0) + 1), 1}
                           : round_axis(y0, y1, 6);
  }

  std::string svg() const {
    std::string out = format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" width=\"%g\" height=\"%g\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" "
        "fill=\"white\"/>\n",
        width, height, width, height);
    out += text(width / 2, 20, "middle", chart_.title) + grid();
    for (std::size_t i = 0; i < chart_.lines.size(); ++i) out += line(i);
    return out + "</svg>\n";
  }

 private:
  double scaled(double y) const { return chart_.logarithmic ? std::log10(std::max(y, 1.0)) : y; }
  double px(double x) const { return left + x_.at(x) * (width - left - right); }
  double py(double y) const { return height - bottom - y_.at(y) * (height - top - bottom); }

  static std::string text(double x, double y, const char* anchor, const std::string& what,
                          const char* extra = "") {
    return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" %s>", x, y, anchor, extra) + escaped(what) +
           "</text>\n";
  }
  static std::string stroke(double x0, double y0, double x1, double y1) {
    return format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ccc\"/>\n", x0, y0, x1,
                  y1);
  }

  std::string grid() const {
    std::string out;
    for (double x = x_.low; x <= x_.high + 1e-9 * x_.step; x += x_.step)
      out += stroke(px(x), py(y_.low), px(x), py(y_.high)) +
             text(px(x), height - bottom + 18, "middle", format("%g", x));
    for (double y = y_.low; y <= y_.high + 1e-9 * y_.step; y += y_.step)
      out += stroke(px(x_.low), py(y), px(x_.high), py(y)) +
             text(left - 8, py(y) + 4, "end", format("%g", chart_.logarithmic ? std::pow(10, y) : y));
    out += text((left + width - right) / 2, height - 12, "middle", chart_.x_label);
    return out + text(18, (top + height - bottom) / 2, "middle", chart_.y_label,
                      format("transform=\"rotate(-90 18 %.1f)\"", (top + height - bottom) / 2).c_str());
  }

  std::string line(std::size_t index) const {
    const ChartLine& l = chart_.lines[index];
    const char* colour = colours[(l.colour < 0 ? index : std::size_t(l.colour)) % std::size(colours)];
    const char* dash = l.dashed ? " stroke-dasharray=\"6 4\"" : "";
    std::string points, marks;
    for (const auto& [x, y] : l.points) {
      points += format("%.1f,%.1f ", px(x), py(scaled(y)));
      marks +=
          format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n", px(x), py(scaled(y)), colour);
    }
    const double y = top + 10 + 20 * double(index), x = width - right + 14;
    return "<polyline points=\"" + points + "\"" +
           format(" fill=\"none\" stroke=\"%s\" stroke-width=\"2\"%s/>\n", colour, dash) + marks +
           format(
               "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2\"%s/>\n",
               x, y, x + 24, y, colour, dash) +
           text(x + 30, y + 4, "start", l.label);
  }

  const Chart& chart_;
  Axis x_, y_;
};

}  // namespace

Sweep measure_sweep(const RawMaterial& raw, const CompressionSettings& settings,
                    std::span<const std::uint32_t> ranks, const MethodProgress& progress) {
  for (const std::uint32_t rank : ranks)
    if (rank == 0 || rank % settings.cluster_rank_view != 0 || rank > raw.views.size())
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "a total view rank is %u; need a multiple of the cluster rank %u, at most %zu, the number of views",
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

std::string chart_svg(const Chart& chart) {
  return Drawing(chart).svg();
}

}  // namespace nook::lab
