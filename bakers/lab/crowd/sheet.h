// Sheets of labelled pictures, made without a font file.
#pragma once

#include <string>
#include <vector>

#include "platform/platform.h"

namespace nook::lab::crowd {

constexpr int label_height_px = 30;

// Draws white text on a dark strip of label_height_px along the top. Letters have 5 by 7 dots of two pixels.
void draw_label(platform::Image& image, const std::string& text);

// Puts pictures of equal size into rows with the given number of columns, with a thin white gap between them.
platform::Image tile(const std::vector<platform::Image>& pictures, int columns);

}  // namespace nook::lab::crowd
