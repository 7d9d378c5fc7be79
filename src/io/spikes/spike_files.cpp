#include "io/spikes/spike_files.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "core/text/input_files.hpp"
#include "io/spikes/address_events.hpp"
#include "io/spikes/train_collector.hpp"
#include "io/text/utf8.hpp"

namespace corpuscle {
namespace {

/// True if a is before b in natural order, in which "ch2" is before "ch10": runs of digits are compared by value, other characters by byte.
bool natural_less(std::string_view a, std::string_view b) {
    // The number of digits at the beginning of s.
    const auto digits = [](std::string_view s) { return std::min(s.find_first_not_of("0123456789"), s.size()); };
    while (!a.empty() && !b.empty()) {
        auto m = digits(a), n = digits(b);
        if (m == 0 || n == 0) {
            if (a[0] != b[0]) return static_cast<unsigned char>(a[0]) < static_cast<unsigned char>(b[0]);
            m = n = 1;
        } else {
            auto x = a.substr(0, m), y = b.substr(0, n);
            x.remove_prefix(std::min(x.find_first_not_of('0'), m)), y.remove_prefix(std::min(y.find_first_not_of('0'), n));
            if (x.size() != y.size()) return x.size() < y.size();
            if (x != y) return x < y;
            if (m != n) return m < n;
        }
        a.remove_prefix(m), b.remove_prefix(n);
    }
    return a.size() < b.size();
}

}  // namespace

std::vector<NamedTrain> TrainCollector::sorted() && {
    std::vector<NamedTrain> out;
    for (auto& [name, times] : trains_) {
        std::sort(times.begin(), times.end());
        out.push_back({name.first, name.second, std::move(times)});
    }
    std::sort(out.begin(), out.end(), [](const NamedTrain& a, const NamedTrain& b) {
        return a.channel == b.channel ? natural_less(a.afferent, b.afferent) : natural_less(a.channel, b.channel);
    });
    return out;
}

std::string quote_csv_field(const std::string& text) {
    const auto name = to_utf8(text);
    if (name.find_first_of(",;\t\"\r\n") == name.npos && trimmed(name).size() == name.size() && !name.starts_with('#') &&
        !name.starts_with('%'))
        return name;
    std::string quoted = "\"";
    for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

Result<std::vector<NamedTrain>> read_spikes(const std::string& path, const SpikeColumns& columns) {
    const auto first = peek_input(path, 512);
    for (const auto& [begin, what] : {std::pair{"\x89HDF", "an HDF5 file"}, {"RIFF", "a sound file"}, {"fLaC", "a sound file"}})
        if (first.starts_with(begin))
            return bad_input(
                fmt::format("this is {}, not a spike file; supported are CSV, JSON lines, .npy, .npz and address events", what), {path});
    if (first.starts_with("PK") && (first.find(".npy") != first.npos || path.ends_with(".npz"))) return read_npz_spikes(path);
    if (first.starts_with("\x93NUMPY")) return read_npy_spikes(path, columns);
    return first.starts_with(address_events::magic) ? read_aer_spikes(path)
           : first.starts_with("#!AER-DAT2.0")      ? read_aedat2_spikes(path)
                                                    : read_text_spikes(path, columns);
}

}  // namespace corpuscle
