#include "io/wav_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "io/remote_samples.hpp"

namespace corpuscle {
namespace {

std::uint64_t number_of_bytes(std::string_view bytes, bool big_endian) {
    std::uint64_t n = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k)
        n |= std::uint64_t{static_cast<unsigned char>(bytes[k])} << (8 * (big_endian ? bytes.size() - 1 - k : k));
    return n;
}

/// Where the samples of a sound file begin, and how many bytes of them its header promises.
struct SoundData {
    std::uint64_t begin, size;
};

/// WAV, AIFF and AU files; none: another kind, or a header that says no length, as those of streams do.
std::optional<SoundData> find_sound_data(std::ifstream& file) {
    constexpr std::uint64_t no_length = 0x7fff'0000;  // and above; streams have 0, the highest number or one near it
    constexpr int most_chunks = 1000;
    std::string head(12, '\0');
    if (!file.read(head.data(), 12)) return {};
    const std::string_view kind = std::string_view(head).substr(0, 4), form = std::string_view(head).substr(8);
    if (kind == ".snd") {
        const SoundData data{number_of_bytes(std::string_view(head).substr(4, 4), true), number_of_bytes(form, true)};
        return data.size < no_length ? std::optional(data) : std::nullopt;
    }
    const bool wave = (kind == "RIFF" || kind == "RIFX") && form == "WAVE", aiff = kind == "FORM" && (form == "AIFF" || form == "AIFC");
    if (!wave && !aiff) return {};
    std::uint64_t at = 12;
    for (int chunk = 0; chunk < most_chunks; ++chunk) {
        std::string head_of_chunk(8, '\0');
        if (!file.seekg(static_cast<std::streamoff>(at)) || !file.read(head_of_chunk.data(), 8)) return {};
        const auto size = number_of_bytes(std::string_view(head_of_chunk).substr(4), kind != "RIFF");
        if (head_of_chunk.starts_with(wave ? "data" : "SSND"))
            return size < no_length ? std::optional(SoundData{at + 8, size}) : std::nullopt;
        at += 8 + size + size % 2;
    }
    return {};
}

/// What is to be said of a file that ends before its samples do, as half a copy does: its reader takes it as a shorter one. Else "".
std::string remark_on_missing_samples(const std::string& path) {
    std::error_code status;
    const auto size = std::filesystem::file_size(path, status);
    std::ifstream file(path, std::ios::binary);
    const auto data = status || !file ? std::nullopt : find_sound_data(file);
    if (!data || data->begin + data->size <= size) return "";
    return fmt::format("the samples should take {} bytes, and {} are there: cut short? Only the beginning of the recording is read",
                       data->size, size - std::min<std::uint64_t>(data->begin, size));
}

/// Samples with one more remark.
class RemarkedSamples final : public Samples {
    std::unique_ptr<Samples> samples_;
    SamplesFacts facts_;

public:
    RemarkedSamples(std::unique_ptr<Samples> samples, std::string remark) : samples_(std::move(samples)), facts_(samples_->facts()) {
        facts_.remarks.push_back(std::move(remark));
    }
    const SamplesFacts& facts() const override { return facts_; }
    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        return samples_->fetch(first, rows, wanted, out);
    }
};

}  // namespace

Result<std::unique_ptr<Table>> open_wav_table(const std::string& path, const TableOptions& options) {
    if (options.dataset) return bad_usage(fmt::format("--dataset {}: a sound file has only one array", *options.dataset));
    if (options.transpose) return bad_usage("--transpose: in a sound file each channel is known");
    auto samples = remote_samples(path, {"corpuscle-sound", "libsndfile"}, options);
    if (auto remark = remark_on_missing_samples(path); samples && !remark.empty())
        samples = std::unique_ptr<Samples>(std::make_unique<RemarkedSamples>(*std::move(samples), std::move(remark)));
    return table_of(std::move(samples), path);
}

}  // namespace corpuscle
