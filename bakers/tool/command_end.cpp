#include "bakers/tool/command_end.h"

#include <csignal>
#include <cstdio>
#include <initializer_list>

#include "platform/printable.h"

namespace nook::tool {
namespace {

// A signal handler can only use static storage.
volatile std::sig_atomic_t signalled = 0;

extern "C" void note_signal(int) {
  signalled = 1;
}

}  // namespace

void watch_for_interrupt() {
  struct sigaction action = {};
  action.sa_handler = note_signal;
  action.sa_flags = int(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    // A signal that is ignored stays ignored, so that work continues under nohup and in the background of a
    // script.
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  // If the reader of a pipe has ended, a write to the pipe then fails with an error that is reported, instead
  // of ending the process.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // the write then fails, like on a full disk
}

bool interrupted() {
  return signalled != 0;
}

platform::FileEvents file_events(bool quiet) {
  const auto say = [](const std::string& text) {
    std::fprintf(stderr, "nook: %s\n", platform::printable(text).c_str());
  };
  platform::FileEvents events;
  events.stopped = interrupted;
  events.waits = say;
  if (!quiet) events.replaces = say;
  return events;
}

}  // namespace nook::tool
