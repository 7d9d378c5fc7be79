#pragma once
// Property tests: rapidcheck's bridge wants GoogleTest before it.

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
