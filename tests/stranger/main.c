/* stranger poses MODEL.nook RIG.engine AO BOUND    AO of all frames to the file AO; error at most BOUND
 * stranger checks MODEL.nook RIG.engine           the check of right poses
 * stranger mistakes MODEL.nook RIG.engine         the check of wrong ones
 * stranger pictures MODEL.nook RIG.engine         the screen and world passes, on OpenGL */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/stranger/stranger.h"

int main(int argc, char** argv) {
  stranger s;
  int failures;
  if (argc < 4) {
    fputs("usage: stranger poses|checks|mistakes|pictures MODEL RIG [AO BOUND]\n", stderr);
    return 2;
  }
  if (!stranger_start(&s, argv[2], argv[3])) return 1;
  if (strcmp(argv[1], "poses") == 0 && argc == 6)
    stranger_run_poses(&s, argv[4], strtof(argv[5], NULL));
  else if (strcmp(argv[1], "checks") == 0)
    stranger_run_checks(&s);
  else
    stranger_expect(&s, 0, "there is no part \"%s\" with %d arguments", argv[1], argc - 4);
  failures = s.failures;
  stranger_stop(&s);
  return failures ? 1 : 0;
}
