// The kernels of characters, one float at a time, in the order of the formulas.
#include "sdk/src/isa/scalar/vector.h"

#include "sdk/src/character/shadow_kernels_parts.h"

namespace nook::isa_scalar {

using Wide = Float;  // the vector type of the loops over spheres

#include "sdk/src/character/shadow_kernels_impl.inl"
#include "sdk/src/character/shadow_kernels_impl_directional.inl"
#include "sdk/src/character/shadow_kernels_pose_scalar.inl"
#include "sdk/src/character/shadow_kernels_table.inl"

}  // namespace nook::isa_scalar
