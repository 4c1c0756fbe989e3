// Makes sheets of labelled pictures. No font file is needed.
#pragma once

#include <string>
#include <vector>

#include "platform/platform.h"

namespace nook::lab::crowd {

constexpr int label_height_px = 30;

// Draws white text on a dark strip along the top, which is label_height_px high. Letters have 5 by 7 dots,
// and each dot has 2 by 2 pixels.
void draw_label(platform::Image& image, const std::string& text);

// Arranges pictures of equal size in a grid with `columns` columns. There is a thin white gap between
// pictures.
platform::Image tile(const std::vector<platform::Image>& pictures, int columns);

}  // namespace nook::lab::crowd
