#include "cli/nnao/peers.h"

namespace nook::cli {
namespace {

// What `nook evaluate nnao --tune all` prints, seed 1.
constexpr PeerMethod methods[] = {
#include "cli/nnao/peer_tuning.inl"
};

}  // namespace

const char* peer_name(Peer peer) {
  switch (peer) {
    case Peer::ssao:
      return "ssao";
    case Peer::ssao_plus:
      return "ssao+";
    case Peer::hbao:
      return "hbao";
    case Peer::gtao:
      return "gtao";
    default:
      return "gtao_bitmask";
  }
}

const char* peer_shader(Peer peer) {
  switch (peer) {
    case Peer::ssao:
      return "ssao.frag";
    case Peer::ssao_plus:
      return "ssao_plus.frag";
    case Peer::hbao:
      return "hbao.frag";
    case Peer::gtao:
      return "gtao.frag";
    default:
      return "bitmask.frag";
  }
}

PeerGrid peer_grid(Peer peer, int taps) {
  if (peer == Peer::ssao || peer == Peer::ssao_plus) return {1, taps};
  if (peer == Peer::hbao) return {taps <= 16 ? 4 : 8, taps <= 32 ? 4 : 8};
  switch (taps) {
    case 4:
      return {1, 2};
    case 8:
      return {2, 2};
    case 16:
      return {2, 4};
    case 18:
      return {3, 3};
    case 32:
      return {4, 4};
    default:
      return {4, 8};
  }
}

std::span<const PeerMethod> peer_methods() {
  return methods;
}

int peer_fetches(const PeerMethod& method) {
  return 2 + method.taps;
}

}  // namespace nook::cli
