/* Mends the standard streams of a program that was started without some of them, as `PROGRAM 2>&-` does. It
   is plain C, so that the samples can include it. */
#ifndef PLATFORM_STANDARD_STREAMS_H
#define PLATFORM_STANDARD_STREAMS_H

#include <stdio.h>

#ifndef _WIN32
#include <errno.h>
#include <fcntl.h>
#endif

/* Call it first in main(). An opened file takes the lowest free descriptor: if the error stream is closed,
 * this is 2, and without this call messages would go into the first file that you write. Closed descriptors
 * are opened on /dev/null in the wrong direction, so that printing still fails with EBADF and a lost result
 * is noticed. On Windows, the C library never gives 0, 1 or 2 to a file. */
static inline void open_closed_streams(void) {
#ifndef _WIN32
  for (int stream = 0; stream < 3; ++stream) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    /* If there is no /dev/null, as in some containers, the root folder stands in for it. */
    if (open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY) < 0) (void)!open("/", O_RDONLY);
  }
#endif
}

/* Call it at the end of main() if the result goes to the output stream. Returns the code, or 1 with a message
   if something did not get out, as on a full disk. */
static inline int code_after_output(int code) {
  if (fflush(stdout) == 0 && !ferror(stdout)) return code;
  fputs("the output stream cannot be written; the result is incomplete\n", stderr);
  return code ? code : 1;
}

#endif
