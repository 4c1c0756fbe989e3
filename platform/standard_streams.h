/* Repairs the standard streams of a program that was started with some of them closed, for example by
   `PROGRAM 2>&-`. It is plain C, so that samples in C can include it. */
#ifndef PLATFORM_STANDARD_STREAMS_H
#define PLATFORM_STANDARD_STREAMS_H

#include <stdio.h>

#ifndef _WIN32
#include <errno.h>
#include <fcntl.h>
#endif

/* Call it first in main(). A file that is opened gets the lowest free descriptor. If the error stream is
 * closed, this is 2, and messages would be written into the first file that you open. So this function opens
 * closed descriptors on /dev/null, in the wrong direction: printing still fails with EBADF, and a lost result
 * is noticed. On Windows, nothing is needed, because the C library never gives 0, 1 or 2 to a file. */
static inline void open_closed_streams(void) {
#ifndef _WIN32
  for (int stream = 0; stream < 3; ++stream) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    /* If there is no /dev/null, as in some containers, opens the root folder instead. */
    if (open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY) < 0) (void)!open("/", O_RDONLY);
  }
#endif
}

/* Call it at the end of main() if the result is written to the output stream. Returns `code`. If something
   could not be written, as on a full disk, prints a message and returns 1 instead of 0. */
static inline int code_after_output(int code) {
  if (fflush(stdout) == 0 && !ferror(stdout)) return code;
  fputs("the output stream cannot be written; the result is incomplete\n", stderr);
  return code ? code : 1;
}

#endif
