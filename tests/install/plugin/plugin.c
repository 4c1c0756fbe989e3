/* A plug-in of a host that links Nook. */
#include <nook/nook_character.h>

int plugin_start(void);
int plugin_start(void) {
  nook_context_desc desc;
  nook_context context = NULL;
  if (nook_context_desc_init(&desc)) return 1;
  if (nook_context_create(&desc, &context)) return 1;
  nook_context_destroy(&context);
  return 0;
}
