// Catch2 2 (Debian 12) and 3 (Debian 13) under one name.
#pragma once

// Maps are printed.
#define CATCH_CONFIG_ENABLE_PAIR_STRINGMAKER

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif
