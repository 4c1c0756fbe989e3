// Functions that tensors and networks both use for decoding: cells of view maps, and the places in the tile
// that a pixel reads.
#include "shaders/material/view_map.glsl"

#include "shaders/material/footprint.glsl"
