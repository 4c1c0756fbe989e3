/* Repairs the standard streams of a program that was started with some of them closed, for example by
   `PROGRAM 2>&-`. It is plain C, so that samples in C can include it. */
#ifndef PLATFORM_STANDARD_STREAMS_H
#define PLATFORM_STANDARD_STREAMS_H

#include <stdio.h>

#ifndef _WIN32
#include <errno.h>
#include <fcntl.h>
#endif

/* Call it first in main(). Each file that you open gets the lowest free descriptor. If the error stream is
 * closed, a file can get its descriptor 2, and messages would be written into this file. So this function
 * opens /dev/null for closed streams, but for the wrong direction, such as reading for an output stream.
 * Printing then still fails with EBADF, so a lost result is noticed. Windows does not need this, because its
 * C library never gives 0, 1 or 2 to a file. */
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
