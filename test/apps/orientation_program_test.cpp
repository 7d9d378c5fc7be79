// The remedies that the program names for an array with exchanged dimensions work when typed.

#include <cstring>

#include "support/file_writers.hpp"
#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::run_program;

TEST(OrientationProgram, TheRemediesInTheErrorWorkAsTyped) {
    const TemporaryFolder folder;
    folder.write("x.npy", test::npy_bytes("'|u1'", "(2, 300)", std::string(300, '\1') + std::string(300, '\2')));
    for (const std::string verb : {"respond x.npy --rate 500Hz", "stream --in x.npy --rate 500Hz --pace fast --channels 2"}) {
        const auto refused = run_program(folder, verb);
        EXPECT_EQ(refused.status, 1);
        EXPECT_NE(refused.err.find(
                      "300 channels of only 2 samples? Use --transpose if each row is a channel, or --no-transpose if each row is a"),
                  std::string::npos)
            << refused.err;
        EXPECT_EQ(run_program(folder, verb + " --transpose").status, 0);
    }
    const auto transposed = run_program(folder, "respond x.npy --rate 500Hz --transpose");
    EXPECT_NE(transposed.out.find("2 channels, 300 samples"), std::string::npos) << transposed.out;
    const auto not_transposed = run_program(folder, "respond x.npy --rate 500Hz --no-transpose");
    EXPECT_NE(not_transposed.out.find("300 channels, 2 samples"), std::string::npos) << not_transposed.out;
    EXPECT_EQ(run_program(folder, "respond x.npy --rate 500Hz --transpose --no-transpose").status, 2);
    EXPECT_EQ(run_program(folder, "respond press --transpose").status, 2);
}

TEST(OrientationProgram, ADatasetMayBeNamedByTheEndOfItsPath) {
    const TemporaryFolder folder;
    {
        test::Hdf5File file(folder / "x.nwb");
        file.write_numbers("/acquisition/FingerForce/data", {3}, {0, 1, 2});
        file.write_numbers("/acquisition/other/data", {3}, {0, 1, 2});
    }
    EXPECT_EQ(run_program(folder, "respond x.nwb --rate 10Hz --dataset FingerForce").status, 0);
    EXPECT_EQ(run_program(folder, "respond x.nwb --rate 10Hz").status, 1);
}

}  // namespace
}  // namespace corpuscle
