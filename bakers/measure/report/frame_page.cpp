#include "bakers/measure/report/pages.h"

#include <algorithm>
#include <cmath>

#include "bakers/measure/nnao/frame_pictures.h"
#include "bakers/measure/nnao/frame_replay.h"
#include "bakers/measure/report/advice.h"

namespace nook::report {
namespace {

using bake::Picture;
using nook::nnao::Recording;

constexpr int max_width_px = 900;

// If a picture is wider than the page, keeps only every n-th pixel in both directions.
Picture page_picture(const platform::Image& image) {
  const int step = (image.width + max_width_px - 1) / max_width_px;
  Picture picture{(image.width + step - 1) / step, (image.height + step - 1) / step, {}};
  for (int y = 0; y < image.height; y += step)
    for (int x = 0; x < image.width; x += step)
      for (int c = 0; c < 3; ++c)
        picture.rgb.push_back(image.pixels[std::size_t((y * image.width + x) * image.channels + c)]);
  return picture;
}

// Returns the AO radius on the screen for a surface at this depth, in pixels, before the minimum and maximum
// radius in pixels are applied.
double radius_px(const Recording& recording, double depth) {
  const double height = double(recording.height);
  if (recording.frame.radius_kind != 0) return double(recording.frame.radius) * height;
  const double scale = 0.5 * height * std::fabs(double(recording.frame.projection[5]));
  return double(recording.frame.radius) * scale /
         (nook::nnao::is_perspective(recording.frame.projection) ? depth : 1);
}

Measures measures_of(const Recording& recording, const bake::nnao::TracedView& view) {
  const double limit = recording.frame.max_radius_px > 0 ? double(recording.frame.max_radius_px)
                                                         : double(recording.height) / 4;
  double sky = 0, cut = 0, small = 0, surfaces = 0, not_finite = 0, ao = 0;
  for (const float depth : view.depth) {
    if (std::isnan(depth)) {
      ++not_finite;
    } else if (!std::isfinite(depth)) {
      ++sky;
    } else {
      ++surfaces;
      const double radius = radius_px(recording, double(depth));
      if (radius > limit) ++cut;
      if (radius < 2) ++small;
    }
  }
  for (const float value : recording.ao) {
    if (!std::isfinite(value)) ++not_finite;
    ao += double(value);
  }
  Measures measures;
  measures.value["sky_share"] = sky / double(view.depth.size());
  measures.value["not_finite"] = not_finite;
  if (surfaces > 0) {
    measures.value["reach_share"] = cut / surfaces;
    measures.value["small_share"] = small / surfaces;
  }
  if (!recording.ao.empty()) measures.value["ao_mean"] = ao / double(recording.ao.size());
  return measures;
}

}  // namespace

PageParts frame_parts(const Recording& recording) {
  const bake::nnao::TracedView view = measure::view_of_frame(recording);
  const Measures measures = measures_of(recording, view);
  const int width = int(recording.width), height = int(recording.height);
  PageParts parts;
  parts.lead = text(std::to_string(width)) + Html(" x ") + text(std::to_string(height)) +
               Html(" pixels, drawn by ") + text(std::string_view(recording.renderer)) +
               Html(". Note of the person who recorded it: ") +
               (recording.note.empty() ? Html("none")
                                       : Html("“") + text(std::string_view(recording.note)) + Html("”")) +
               Html(".");
  Html pictures;
  if (!recording.ao.empty())
    pictures += figure(
        page_picture(measure::ao_picture(recording.ao, width, height)),
        "The ambient occlusion that the pass drew",
        Html("The AO that the pass drew on the machine that recorded the frame. Black is 0, white is 1."));
  pictures +=
      figure(page_picture(measure::depth_picture(view)), "The depth of the frame, near bright and far dark",
             Html("Depth: near is bright, far is dark, and pixels without a surface are blue. A wrong "
                  "projection or clip range shows here."));
  pictures += figure(page_picture(measure::normal_picture(view)), "The normals of the frame as colours",
                     Html("Normals in view space: red to the right, green up, blue towards the viewer. A "
                          "floor must have a single colour, mostly green."));
  parts.sections = Html("<section id=\"frame\"><h2>The frame</h2>\n") + pictures +
                   Html(
                       "<p><code>nook evaluate nnao --frame</code> draws the frame again, on OpenGL, and "
                       "compares it with the recording and with an exact integral.</p>\n</section>\n");
  parts.advice = advice_list(Subject::frame, measures);
  return parts;
}

}  // namespace nook::report
