#include "io/nwb/hdf5_messages.hpp"

#include "core/bytes.hpp"
#include "io/sandbox/remote_samples.hpp"

namespace corpuscle {
namespace {

constexpr std::uint64_t success = 0;  // with which a response begins that is not an error

template <class... T>
std::string message_of(const T&... values) {
    ByteWriter out;
    out.put(values...);
    return out.take();
}

/// Decodes the contents of a response that is not an error.
template <class T>
Result<T> decode_contents(const std::string& m, const std::string& path) {
    TRY(decode_status(m, path));
    ByteReader in(m);
    std::uint64_t status = 0;
    T contents;
    if (in.get(status, contents)) return contents;
    return bad_input("invalid response of the helper process that reads this file", {path});
}

}  // namespace

std::string encode(const Hdf5Step& step) { return message_of(step); }
std::string encode(const UnitsRequest& request) { return message_of(request); }
std::string encode(const std::vector<NwbUnit>& units) { return message_of(success, units); }
std::string encode(const TrialsRequest& request) { return message_of(request); }
std::string encode(const NwbTrialTable& table) { return message_of(success, table); }
std::string encode_success() { return message_of(success); }

bool decode(const std::string& m, Hdf5Step& step) { return ByteReader(m).get(step); }
bool decode(const std::string& m, UnitsRequest& request) { return ByteReader(m).get(request); }
bool decode(const std::string& m, TrialsRequest& request) { return ByteReader(m).get(request); }

Result<std::vector<NwbUnit>> decode_units(const std::string& m, const std::string& path) {
    return decode_contents<std::vector<NwbUnit>>(m, path);
}
Result<NwbTrialTable> decode_trials(const std::string& m, const std::string& path) { return decode_contents<NwbTrialTable>(m, path); }

}  // namespace corpuscle
