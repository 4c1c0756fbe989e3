// Linear light as display values.
#pragma once

#include "bakers/images/picture.h"

namespace nook::report {

// Of 0 to 1, by the sRGB curve; more is white, less black.
bake::Colour display(Vec3 linear);

// A picture of one colour.
bake::Picture plain_picture(int width, int height, bake::Colour colour);
void set_pixel(bake::Picture& picture, int x, int y, bake::Colour colour);

}  // namespace nook::report
