#include <nook/nook_character.h>
#include <stdio.h>

int main(void) {
  nook_context_desc desc;
  nook_context context = NULL;
  if (nook_context_desc_init(&desc) || nook_context_create(&desc, &context)) {
    puts(nook_last_message());
    return 1;
  }
  printf("nook %u.%u\n", (unsigned)(nook_version() >> 22), (unsigned)(nook_version() >> 12 & 1023));
  nook_context_destroy(&context);
  return 0;
}
