// Cells of view maps and places of the tile, which the decoding of tensors and the decoding of networks use.
#include "shaders/material/view_map.glsl"

#include "shaders/material/footprint.glsl"
