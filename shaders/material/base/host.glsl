// Cells of view maps and places of the tile, for decoding tensors and networks.
#include "shaders/material/view_map.glsl"

#include "shaders/material/footprint.glsl"
