#pragma once
// Property tests. GoogleTest must be included before rapidcheck's bridge. rc::check only returns true or false; wrap it in EXPECT_TRUE.

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
