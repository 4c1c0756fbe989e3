#include "platform/file_waits.h"

#include <poll.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "platform/printable.h"

namespace platform {

void Wait::step() {
  if (events_.stopped && events_.stopped()) throw Stopped("stopped; " + what_);
  if (++steps_ * step_ms < int(waiting_seconds * 1000) || said_) return;
  said_ = true;
  if (events_.waits)
    events_.waits(what_);
  else
    std::fprintf(stderr, "%s\n", printable(what_).c_str());
}

void wait_until_ready(int descriptor, short event, Wait& wait) {
  for (;;) {
    pollfd one{descriptor, event, 0};
    const int ready = poll(&one, 1, Wait::step_ms);
    if (ready > 0) return;
    if (ready < 0 && errno != EINTR)
      throw std::runtime_error(std::string("poll failed (") + std::strerror(errno) + ")");
    wait.step();
  }
}

}  // namespace platform
