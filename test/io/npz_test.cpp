// Lists written as NPZ are read back unchanged, and the bytes do not depend on the time or its zone.

#include "io/table/npz.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

const std::vector<std::int64_t> extreme_integers = {0, -1, std::numeric_limits<std::int64_t>::max(),
                                                    std::numeric_limits<std::int64_t>::min()};
const std::vector<double> example_numbers = {0.1, -0.0, 1e308, INFINITY};
const std::vector<std::string> example_texts = {"", "fz", "Kraft in \xc2\xb5N", "\xf0\x9f\xa4\x9a"};

std::string example_archive() {
    NpzWriter npz;
    npz.add("whole", extreme_integers);
    npz.add("numbers", example_numbers);
    npz.add("words", example_texts);
    return test::value_or_throw(npz.bytes());
}

TEST(Npz, ListsAreReadBackUnchanged) {
    const TemporaryFolder folder;
    const auto npz = test::value_or_throw(NpzReader::open(folder.write("x.npz", example_archive())));
    EXPECT_EQ(npz.names(), (std::vector<std::string>{"whole", "numbers", "words"}));
    EXPECT_EQ(test::value_or_throw(npz.integers("whole")), extreme_integers);
    EXPECT_EQ(test::value_or_throw(npz.numbers("numbers")), example_numbers);
    EXPECT_TRUE(std::signbit(test::value_or_throw(npz.numbers("numbers"))[1]));
    EXPECT_EQ(test::value_or_throw(npz.strings("words")), example_texts);
}

TEST(Npz, ListsOfAnyLengthAreReadBackUnchanged) {
    EXPECT_TRUE(rc::check("lists of any length", [] {
        const auto integers = *rc::gen::arbitrary<std::vector<std::int64_t>>();
        const auto reals = *rc::gen::arbitrary<std::vector<double>>();
        const auto texts = *rc::gen::container<std::vector<std::string>>(rc::gen::string<std::string>());
        auto stored = texts;  // NumPy pads texts with zeros and stores Unicode only
        for (auto& t : stored) std::erase_if(t, [](char c) { return c == 0 || static_cast<unsigned char>(c) >= 0x80; });
        NpzWriter npz;
        npz.add("i", integers);
        npz.add("r", reals);
        npz.add("t", stored);
        const auto path = (std::filesystem::temp_directory_path() / ("corpuscle-npz-" + std::to_string(::getpid()) + ".npz")).string();
        std::ofstream(path, std::ios::binary) << test::value_or_throw(npz.bytes());
        const auto reread = test::value_or_throw(NpzReader::open(path));
        std::filesystem::remove(path);
        RC_ASSERT(test::value_or_throw(reread.integers("i")) == integers);
        RC_ASSERT(test::value_or_throw(reread.numbers("r")) == reals);
        RC_ASSERT(test::value_or_throw(reread.strings("t")) == stored);
    }));
}

TEST(Npz, TheBytesDoNotDependOnTheClockOrItsZone) {
    const auto local = example_archive();
    const std::string zone = std::getenv("TZ") ? std::getenv("TZ") : "";
    for (const char* other : {"Asia/Kolkata", "America/St_Johns", "Africa/Monrovia", "Pacific/Apia"}) {
        ::setenv("TZ", other, 1);
        EXPECT_EQ(example_archive(), local) << other;
    }
    ::setenv("TZ", zone.c_str(), 1);
    EXPECT_EQ(static_cast<unsigned char>(local[12]), 0x21) << "the date in the archive is the first of January";
    EXPECT_EQ(local[13], 0) << "1980";
}

TEST(Npz, MissingListsAndWrongTypesGiveAnError) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.npz", example_archive());
    const auto npz = test::value_or_throw(NpzReader::open(path));
    EXPECT_TRUE(npz.has("words"));
    EXPECT_FALSE(npz.has("word"));
    EXPECT_EQ(npz.strings("word").error().text(), path + ": no array 'word'; did you mean 'words'?");
    EXPECT_EQ(npz.strings("whole").error().text(), path + "/whole: the type is '<i8', expected strings");
    EXPECT_EQ(npz.integers("numbers").error().text(), path + "/numbers: the type is '<f8', expected integers");
    EXPECT_EQ(test::value_or_throw(npz.numbers("whole"))[1], -1) << "integers are numbers";
    const auto text = folder.write("y.npz", "a,b\n1,2\n");
    EXPECT_EQ(NpzReader::open(text).error().text(), text + ": cannot be read as a zip archive: Not a zip archive");
    const auto cut = folder.write("z.npz", example_archive().substr(0, 300));
    EXPECT_FALSE(NpzReader::open(cut));
    auto damaged = example_archive();
    damaged[damaged.find("NUMPY", 200) + 127] ^= 1;  // one bit of the numbers; the checksum of the archive detects it
    EXPECT_EQ(test::value_or_throw(NpzReader::open(folder.write("d.npz", damaged))).numbers("numbers").error().message,
              "cannot be decompressed: CRC error");
}

/// Adds `more` to the size of the member "numbers" in the directory of the archive, and changes one of its bits if `damaged`.
std::string with_size(std::string bytes, int more, bool damaged) {
    const auto entry = bytes.find("PK\x01\x02", bytes.find("PK\x01\x02") + 4);  // the entry of the second member, "numbers"
    for (const std::size_t at : {entry + 20, entry + 24}) {
        std::uint32_t size = 0;
        std::memcpy(&size, &bytes[at], sizeof size);
        size += static_cast<std::uint32_t>(more);
        std::memcpy(&bytes[at], &size, sizeof size);
    }
    if (damaged) bytes[bytes.find("NUMPY", 200) + 127] ^= 1;
    return bytes;
}

TEST(Npz, AWrongSizeInTheArchiveDirectoryIsAnError) {
    const TemporaryFolder folder;
    const auto numbers_of = [&](int more, bool damaged) {
        const auto npz = test::value_or_throw(NpzReader::open(folder.write("x.npz", with_size(example_archive(), more, damaged))));
        return npz.numbers("numbers");
    };
    EXPECT_TRUE(numbers_of(0, false));
    EXPECT_FALSE(numbers_of(0, true));
    for (const int more : {-32, -8, -1, 1, 8, 4096})
        for (const bool damaged : {false, true}) EXPECT_FALSE(numbers_of(more, damaged)) << more;
    EXPECT_EQ(numbers_of(8, true).error().message, "the archive states 168 bytes, but the array has 160; it may be damaged");
}

}  // namespace
}  // namespace corpuscle
