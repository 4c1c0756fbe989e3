// The methods that the screen-space network is compared with, each tuned, as it was published otherwise.
#pragma once

#include <span>

namespace nook::cli {

enum class Peer { ssao, ssao_plus, hbao, gtao, bitmask };
inline constexpr Peer all_peers[] = {Peer::ssao, Peer::ssao_plus, Peer::hbao, Peer::gtao, Peer::bitmask};

const char* peer_name(Peer peer);    // in tables
const char* peer_shader(Peer peer);  // in shaders/

// What the grid search chooses.
struct PeerTuning {
  float radius_scale = 1;  // the method's radius over the radius asked for
  float power = 1;         // of its result
  // Bias of SSAO+ in radii and of HBAO in radians; where GTAO's falloff begins, in radii; thickness of the
  // bitmask in radii. SSAO has none.
  float shape = 0;
  bool equal_weights = false;  // bitmask: sectors of equal cosine-weighted share; else of equal angle
};

struct PeerMethod {
  Peer peer;
  int taps;
  PeerTuning tuning;
};

// Taps as directions x steps (HBAO), or 2 halves x slices x steps (GTAO and the bitmask).
struct PeerGrid {
  int groups, steps;
};
PeerGrid peer_grid(Peer peer, int taps);

// Every row of the comparison, with the tuning that `nook evaluate nnao --tune all` prints.
std::span<const PeerMethod> peer_methods();

// Texture fetches a pixel: the pixel's depth and normal, one depth a tap; the blur's are blur_fetches more.
int peer_fetches(const PeerMethod& method);
// Two axes, each AO, depth and normal of 7 pixels.
inline constexpr int blur_fetches = 2 * 3 * 7;

}  // namespace nook::cli
