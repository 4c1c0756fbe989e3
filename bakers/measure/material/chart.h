// Line charts as SVG, for the documents.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace nook::measure {

struct ChartLine {
  std::string label;
  std::vector<std::pair<double, double>> points;  // x, y
  bool dashed = false;
  int colour = -1;  // lines of one number share a colour; -1: the line's place
};

struct Chart {
  std::string title, x_label, y_label;
  bool logarithmic = false;  // y; values below 1 are drawn at 1
  std::vector<ChartLine> lines;
};

// Readable on light and dark pages. Charts without points give an empty frame.
std::string chart_svg(const Chart& chart);

}  // namespace nook::measure
