#include "bakers/measure/material/chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nook::measure {
namespace {

constexpr double width = 640, height = 400, left = 70, right = 150, top = 40, bottom = 50;
// Distinguishable with any colour vision (Okabe and Ito 2008).
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

// Round steps of 1, 2 or 5 times a power of ten, about `count` of them.
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

std::string chart_svg(const Chart& chart) {
  return Drawing(chart).svg();
}

}  // namespace nook::measure
