#pragma once

#include <vector>

namespace nook_samples::mannequin {

/// Makes the built-in character: a skinned, animated human figure of about 6,000 vertices, as the bytes of a
/// .glb file. Every call makes the same bytes and takes a few seconds.
std::vector<unsigned char> make_mannequin_glb();

}  // namespace nook_samples::mannequin
