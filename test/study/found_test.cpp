// What a study reads off a circuit that was solved.

#include <cmath>

#include "study/deck.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(Found, ADevicesReadingsAreTheSlopesOfTheCircuitAboutIt) {
    const auto found = test::sure(found_in({"one\n.lib '../process/tsmc180.lib' tt\nvd d 0 0.5\nvg g 0 0.4\nm1 d g 0 0 nch w=1.5u l=0.5u\n",
                                            {},
                                            ".op\n.tf i(vd) vg\n.tf i(vd) vd"}));
    EXPECT_NEAR(found.reading("m1", "i_d") / -found.at_rest("i(vd)"), 1, 1e-6);
    EXPECT_NEAR(found.reading("m1", "g_mg") / -found.by("i(vd)", "vg"), 1, 1e-6);
    EXPECT_NEAR(found.reading("m1", "g_md") / -found.by("i(vd)", "vd"), 1, 1e-6);
}

TEST(Found, WhatWasNotAskedIsNaN) {
    const auto found = test::sure(found_in({"one\nv1 a 0 1\nr1 a 0 1k\n", {}, ".op\n.tf i(v1) v1"}));
    EXPECT_TRUE(std::isnan(found.by("v(a)", "v1")));
    EXPECT_TRUE(std::isnan(found.reading("m1", "i_d")));
    EXPECT_TRUE(std::isnan(found.reading("r1", "i_f")));
}

}  // namespace
}  // namespace corpuscle
