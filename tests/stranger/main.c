/* Each part takes MODEL.nook and RIG.engine, the file of flatten.py:
 *   stranger layouts MODEL RIG AO     AO in each kind, layout and place; writes it to the file AO
 *   stranger truth MODEL RIG BOUND UNIT
 *                                     its error against ray tracing, at most BOUND; UNIT units of the world are a
 *                                     metre
 *   stranger checks MODEL RIG         the check of right poses
 *   stranger mistakes MODEL RIG       the check of wrong ones
 *   stranger pictures MODEL RIG       the screen and world passes, on OpenGL
 *   stranger documents MODEL RIG      the lines that the documents show */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/stranger/stranger.h"

int main(int argc, char** argv) {
  stranger s;
  int failures;
  if (argc < 4) {
    fputs("usage: stranger layouts|truth|checks|mistakes|pictures|documents MODEL RIG [AO | BOUND UNIT]\n",
          stderr);
    return 2;
  }
  if (!stranger_start(&s, argv[2], argv[3])) return 1;
  if (strcmp(argv[1], "layouts") == 0 && argc == 5)
    stranger_run_layouts(&s, argv[4]);
  else if (strcmp(argv[1], "truth") == 0 && argc == 6) {
    s.unit = strtof(argv[5], NULL);
    stranger_run_truth(&s, strtof(argv[4], NULL));
  } else if (strcmp(argv[1], "checks") == 0)
    stranger_run_checks(&s);
  else if (strcmp(argv[1], "mistakes") == 0)
    stranger_run_mistakes(&s);
  else if (strcmp(argv[1], "pictures") == 0)
    stranger_run_pictures(&s);
  else if (strcmp(argv[1], "documents") == 0)
    stranger_run_documents(&s, argv[2]);
  else
    stranger_expect(&s, 0, "there is no part \"%s\" with %d arguments", argv[1], argc - 4);
  failures = s.failures;
  stranger_stop(&s);
  return failures ? 1 : 0;
}
