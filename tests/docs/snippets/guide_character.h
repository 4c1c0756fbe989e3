#include <nook/experimental/nook_calibration.h>
#include <stdio.h>

extern FILE* poses;
extern void* record;
