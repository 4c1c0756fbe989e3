// Text in pictures, without a font file.
#pragma once

#include <string>

#include "platform/platform.h"

namespace crowd {

constexpr int kLabelHeight_px = 30;

// Draws white text, 5 by 7 dots of two pixels each, on a dark strip of kLabelHeight_px along the top.
void draw_label(platform::Image& image, const std::string& text);

// Pictures of equal size in rows of so many columns, with a thin gap between.
platform::Image tile(const std::vector<platform::Image>& pictures, int columns);

}  // namespace crowd
