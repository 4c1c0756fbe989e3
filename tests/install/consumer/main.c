#include <nook/nook_character.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  nook_context_desc desc;
  nook_context context = NULL;
  nook_model model = NULL;
  if (nook_context_desc_init(&desc) || nook_context_create(&desc, &context)) {
    puts(nook_last_message());
    return 1;
  }
  if (nook_model_load(context, "not a model", 11, &model) != NOOK_ERROR_BAD_FILE) return 1;
  puts(nook_last_message());
  nook_context_destroy(&context);
  return strstr(nook_last_message(), "too short") == NULL;
}
