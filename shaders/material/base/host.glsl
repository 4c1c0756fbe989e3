// Shared functions for decoding tensors and networks: cells of view maps, and places of the tile.
#include "shaders/material/view_map.glsl"

#include "shaders/material/footprint.glsl"
