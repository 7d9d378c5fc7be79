#pragma once
// Property tests: rapidcheck's bridge wants GoogleTest before it. rc::check only returns whether the property held: EXPECT_TRUE it.

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
