#!/usr/bin/env bash
# Prints the C, C++ and GLSL files whose code, comments apart, differs between a commit and the working tree.
#   tests/language/same_code.sh COMMIT
# A change of comments alone prints nothing. Message texts are code here.
set -euo pipefail
cd "$(git -C "$(dirname "${BASH_SOURCE[0]}")" rev-parse --show-toplevel)"
code() { gcc -fpreprocessed -dD -E -P -w -x c++ - 2> /dev/null | tr -s ' \n\t' '   '; }
git diff --name-only --diff-filter=M "$1" -- '*.h' '*.hpp' '*.c' '*.cpp' '*.inl' '*.glsl' '*.frag' '*.vert' '*.comp' |
  while IFS= read -r file; do
    cmp -s <(git show "$1:$file" | code) <(code < "$file") || echo "$file"
  done
