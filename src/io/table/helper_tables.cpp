// The recording formats that helper programs read (io/sandbox): HDF5 and sound files.

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "io/recording/recording_formats.hpp"
#include "io/sandbox/remote_samples.hpp"

namespace corpuscle {
namespace {

/// The unsigned integer that the bytes form.
std::uint64_t integer_of(std::string_view bytes, bool big_endian) {
    std::uint64_t n = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k)
        n |= std::uint64_t{static_cast<unsigned char>(bytes[k])} << (8 * (big_endian ? bytes.size() - 1 - k : k));
    return n;
}

/// The position of the first sample in a sound file, and the size of all samples, in bytes, as the header states them.
struct SoundData {
    std::uint64_t begin, size;
};

/// Finds the samples of a WAV, AIFF or AU file. nullopt for other formats, and for the header of a stream, which has no length.
std::optional<SoundData> find_sound_data(std::ifstream& file) {
    // A size of at least this value means that the length is not known: streams write the largest number or one close to it.
    constexpr std::uint64_t no_length = 0x7fff'0000;
    constexpr int max_chunks = 1000;  // chunks that are searched for the samples
    std::string file_header(12, '\0');
    if (!file.read(file_header.data(), 12)) return {};
    const std::string_view container = std::string_view(file_header).substr(0, 4), form_type = std::string_view(file_header).substr(8);
    if (container == ".snd") {  // AU: the header has the position of the samples, then their size
        const SoundData data{integer_of(std::string_view(file_header).substr(4, 4), true), integer_of(form_type, true)};
        return data.size < no_length ? std::optional(data) : std::nullopt;
    }
    const bool wave = (container == "RIFF" || container == "RIFX") && form_type == "WAVE",
               aiff = container == "FORM" && (form_type == "AIFF" || form_type == "AIFC");
    if (!wave && !aiff) return {};
    std::uint64_t at = 12;
    for (int chunk = 0; chunk < max_chunks; ++chunk) {
        std::string chunk_header(8, '\0');
        if (!file.seekg(static_cast<std::streamoff>(at)) || !file.read(chunk_header.data(), 8)) return {};
        const auto size = integer_of(std::string_view(chunk_header).substr(4), container != "RIFF");
        if (chunk_header.starts_with(wave ? "data" : "SSND"))
            return size < no_length ? std::optional(SoundData{at + 8, size}) : std::nullopt;
        at += 8 + size + size % 2;
    }
    return {};
}

/// A note for the user if the file is shorter than its header states, as an incomplete copy is; otherwise "". libsndfile reads such a file
/// without a warning.
std::string missing_samples_note(const std::string& path) {
    std::error_code status;
    const auto size = std::filesystem::file_size(path, status);
    std::ifstream file(path, std::ios::binary);
    const auto data = status || !file ? std::nullopt : find_sound_data(file);
    if (!data || data->begin + data->size <= size) return "";
    return fmt::format("the samples need {} bytes, but the file has {}; it may be incomplete, and only this part of the recording is read",
                       data->size, size - std::min<std::uint64_t>(data->begin, size));
}

}  // namespace

Result<std::unique_ptr<Table>> open_hdf5_table(const std::string& path, const TableOptions& options) {
    return make_table(open_remote_samples(path, {"corpuscle-hdf5", "the HDF5 library"}, options), path);
}

Result<std::unique_ptr<Table>> open_wav_table(const std::string& path, const TableOptions& options) {
    if (options.dataset) return bad_usage(fmt::format("--dataset {}: a sound file has only one array", *options.dataset));
    if (options.transpose) return bad_usage("--transpose: a sound file defines its channels, so it cannot be transposed");
    auto samples = open_remote_samples(path, {"corpuscle-sound", "libsndfile"}, options);
    if (auto note = missing_samples_note(path); samples && !note.empty()) (*samples)->add_note(std::move(note));
    return make_table(std::move(samples), path);
}

}  // namespace corpuscle
