// Which vertices of which poses a camera can see.
#pragma once

namespace nook::measure {

// Vertex-poses whose ray-traced AO is below this are black: inside the body or in a fist, where no camera
// sees them and any model is right that says 0. Two rays of 128 reach it.
inline constexpr double visible_truth = 0.01;

}  // namespace nook::measure
