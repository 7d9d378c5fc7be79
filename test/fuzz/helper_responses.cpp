// Arbitrary bytes as the responses of a helper program: table info and rows, units or trials of an NWB file, or an error. A malicious file
// may control the helper.

#include <cstdint>
#include <cstdlib>

#include "io/nwb/nwb_messages.hpp"
#include "io/sandbox/helper_messages.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace corpuscle;
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const auto info = decode_info(bytes, "x.h5");
    if (info && info->time_column && *info->time_column >= info->columns.size()) std::abort();
    std::vector<std::vector<double>> out(2, std::vector<double>(3));
    const auto rows = decode_rows(bytes, 1, 2, out, "x.h5");
    if (!rows && rows.error().message.size() > size + 64) std::abort();
    (void)decode_response<std::vector<NwbUnit>>(bytes, "x.nwb"), (void)decode_response<NwbTrialTable>(bytes, "x.nwb");
    OpenRequest open;
    FetchRequest fetch;
    UnitsRequest units;
    TrialsRequest trials;
    (void)decode(bytes, open), (void)decode(bytes, fetch), (void)decode_request(bytes, units), (void)decode_request(bytes, trials);
    return 0;
}
