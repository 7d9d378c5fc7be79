// Values that a study reads from a solved circuit.

#include <cmath>

#include "reproduction/claims/study_netlist.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(NetlistResult, ADevicesConductancesAreTheSlopesOfTheCircuit) {
    const auto found = test::value_or_throw(
        run_study_netlist({"one\n.lib '../process/tsmc180.lib' tt\nvd d 0 0.5\nvg g 0 0.4\nm1 d g 0 0 nch w=1.5u l=0.5u\n",
                           {},
                           ".op\n.tf i(vd) vg\n.tf i(vd) vd"}));
    EXPECT_NEAR(found.operating_info("m1", "i_d") / -found.operating_point("i(vd)"), 1, 1e-6);
    EXPECT_NEAR(found.operating_info("m1", "g_mg") / -found.derivative("i(vd)", "vg"), 1, 1e-6);
    EXPECT_NEAR(found.operating_info("m1", "g_md") / -found.derivative("i(vd)", "vd"), 1, 1e-6);
}

TEST(NetlistResult, UnrequestedValuesAreNaN) {
    const auto found = test::value_or_throw(run_study_netlist({"one\nv1 a 0 1\nr1 a 0 1k\n", {}, ".op\n.tf i(v1) v1"}));
    EXPECT_TRUE(std::isnan(found.derivative("v(a)", "v1")));
    EXPECT_TRUE(std::isnan(found.operating_info("m1", "i_d")));
    EXPECT_TRUE(std::isnan(found.operating_info("r1", "i_f")));
}

}  // namespace
}  // namespace corpuscle
