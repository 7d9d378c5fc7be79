#pragma once
// Property tests with rapidcheck. GoogleTest must be included before rapidcheck's header for it. rc::check() only returns true or false, so
// wrap it in EXPECT_TRUE.

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
