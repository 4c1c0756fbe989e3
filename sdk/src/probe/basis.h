// The basis functions of a probe. All kinds of bases have the same interface. It gives the values for a
// direction, and the integrals and the Gram matrix over the sphere or a hemisphere. Fits use only this
// interface.
#pragma once

#include <nook/nook_probe.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook::probe {

inline constexpr std::uint32_t max_functions = NOOK_PROBE_MAX_FUNCTIONS;
inline constexpr float max_sharpness = 1e4f;
inline constexpr std::uint32_t max_order = 4;
inline constexpr std::uint32_t dice_vertices = 12;

enum class BasisKind : std::uint8_t { gaussians = 0, harmonics = 1, dice = 2 };
enum class Domain : std::uint8_t { sphere = 0, hemisphere = 1 };

// A basis as plain data. Fits can be merged only if their bases compare equal.
struct Basis {
  BasisKind kind = BasisKind::gaussians;
  Domain domain = Domain::sphere;
  bool ambient = false;                          // Gaussians: the last function is constant (sharpness 0)
  std::uint32_t order = 0;                       // harmonics: the highest band
  std::uint32_t count = 0;                       // number of functions
  Vec3 up{0, 0, 1};                              // the hemisphere's axis
  std::array<Vec3, max_functions> axis{};        // Gaussians and dice
  std::array<float, max_functions> sharpness{};  // Gaussians

  bool operator==(const Basis&) const = default;
};

// Returns a basis of lobes with these axes. If `ambient` is true, a constant lobe (sharpness 0) follows them.
// Throws INVALID_ARGUMENT if check_basis rejects the basis.
Basis gaussian_basis(std::span<const Vec3> axes, std::span<const float> sharpnesses, bool ambient,
                     Domain domain = Domain::sphere, Vec3 up = {0, 0, 1});
// Returns the default basis: `lobes` lobes on a Vogel spiral, all with the sharpness even_sharpness.
Basis vogel_basis(std::uint32_t lobes, bool ambient = false, Domain domain = Domain::sphere,
                  Vec3 up = {0, 0, 1});
Basis harmonic_basis(std::uint32_t order, Domain domain = Domain::sphere, Vec3 up = {0, 0, 1});
Basis dice_basis(Domain domain = Domain::sphere, Vec3 up = {0, 0, 1});

// Returns the default sharpness: half the number of lobes on the whole sphere, for example 6 for 12 lobes. On
// a hemisphere, the number is doubled first. With this sharpness, the overlap of neighbouring lobes does not
// depend on the number of lobes.
float even_sharpness(std::uint32_t lobes, Domain domain);

// Throws Failure(code) if a count, axis or sharpness is out of range, or if two lobes are so similar that no
// fit can separate them. The message then names both lobes.
void check_basis(const Basis& basis, nook_result code);

// Sets values[i] = B_i(direction) for all `count` functions. The direction must be a unit vector.
void evaluate_basis(const Basis& basis, Vec3 direction, float* values);
void evaluate_basis(const Basis& basis, const double direction[3], double* values);

double domain_area(Domain domain);

// basis_integrals returns the integral of each B_i over the domain. basis_gram returns the Gram matrix; its
// element i * count + k is the integral of B_i B_k over the domain.
Vector<double> basis_integrals(const Basis& basis, Memory* memory = default_memory());
Vector<double> basis_gram(const Basis& basis, Memory* memory = default_memory());

}  // namespace nook::probe
