#include "page/recording_answer.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>

#include "core/text/ascii_text.hpp"
#include "io/recording/recording_options.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/table/archive.hpp"
#include "io/table/foreign_format.hpp"
#include "page/documents.hpp"
#include "page/row.hpp"
#include "page/temporary_directory.hpp"

namespace corpuscle::page {
namespace {

constexpr std::size_t max_values = 50'000'000;  // of all channels together

Result<void> write_file(const std::string& path, std::span<const std::byte> bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) return bad_input("read: the recording cannot be written to a temporary file");
    return {};
}

/// The texts of an option: one, or a list of several.
Result<std::vector<std::string>> option_texts(const std::string& name, const Json& value) {
    const auto all = value.is_array() ? value : Json::array({value});
    if (!std::ranges::all_of(all, [](const Json& text) { return text.is_string(); }))
        return bad_input(fmt::format("read: the option \"{}\" is not a text, such as \"100Hz\", nor a list of texts", name));
    return all.get<std::vector<std::string>>();
}

/// The options that the page has: without those that name a second file.
OptionGroup page_options(RecordingOptions& options) {
    auto group = named_recording_options(options);
    std::erase_if(group.rows, [](const OptionRow& row) { return row.names == "--layout"; });
    return group;
}

/// The options of the request: each is a text, as on the command line, or a list of texts.
Result<RecordingOptions> read_options(ObjectReader& request) {
    RecordingOptions out;
    NamedOptions named(page_options(out));
    if (const auto* options = TRY(request.object("options")))
        for (const auto& [name, value] : options->items()) {
            if (name == "layout")
                return bad_input("read: the page reads one file, without a layout; use the option --layout of `corpuscle respond`");
            for (const auto& text : TRY(option_texts(name, value))) TRY(named.set(name, text));
        }
    return out;
}

/// The options of the command line that a text names and the page does not have: "--layout".
std::vector<std::string> foreign_options(std::string_view text) {
    RecordingOptions unused;
    const auto group = page_options(unused);
    const auto has_option = [&](std::string_view option) {
        return std::ranges::any_of(group.rows, [&](const OptionRow& row) { return row.names.substr(0, row.names.find(',')) == option; });
    };
    std::vector<std::string> out;
    for (auto at = text.find("--"); at != text.npos; at = text.find("--", at + 2)) {
        const bool begins_word = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
        const auto word = text.substr(at, text.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", at) - at);
        if (begins_word && word.size() > 2 && !has_option(word) && std::ranges::find(out, word) == out.end()) out.emplace_back(word);
    }
    return out;
}

/// The formats that a text names and this engine cannot read, such as that of the file that a remedy makes.
std::vector<std::string> foreign_formats(std::string_view text) {
    const bool has_hdf5(find_helper_program("corpuscle-hdf5")), has_sound(find_helper_program("corpuscle-sound"));
    const std::tuple<std::string_view, const char*, bool> formats[] = {{".npz", "NPZ", Archive::is_supported()},
                                                                       {".h5", "HDF5", has_hdf5},
                                                                       {"-v7.3", "HDF5", has_hdf5},
                                                                       {".wav", "WAV", has_sound},
                                                                       {".flac", "FLAC", has_sound}};
    std::vector<std::string> out;
    for (const auto& [mark, name, is_read] : formats)
        if (!is_read && text.find(mark) != text.npos && std::ranges::find(out, name) == out.end()) out.emplace_back(name);
    return out;
}

/// A text of a reader for the page: if it names options or formats of the command line that the page does not have, says so.
std::string page_text(std::string text) {
    if (text.find("corpuscle respond") != text.npos) return text;
    const auto options = foreign_options(text), formats = foreign_formats(text);
    if (!options.empty()) text += fmt::format(" ({}: only in `corpuscle respond`)", fmt::join(options, ", "));
    if (!formats.empty()) text += fmt::format("; the page cannot read {} files, `corpuscle respond` can", fmt::join(formats, " and "));
    return text;
}

/// The text of an error or note without the path of the temporary directory. A file name in it may be quoted for a shell.
std::string without_path(std::string text, const std::string& directory) {
    for (auto at = text.find(directory); at != text.npos; at = text.find(directory)) text.erase(at, directory.size());
    return text;
}

/// The force of each channel, N.
Result<std::vector<std::vector<double>>> read_force_of(ForceSource& source, const std::string& name) {
    std::vector<std::vector<double>> force(source.channels().size());
    for (Frames block(force.size(), 4096);;) {
        TRY(source.read(block));
        if (block.count == 0) return force;
        if ((force[0].size() + block.count) * force.size() > max_values)
            return bad_input(
                fmt::format("the recording has more than {} million values, the samples of all its channels together, which is the "
                            "limit of the page. Choose channels with --channel, or type: corpuscle respond {}",
                            max_values / 1'000'000, quote_shell_word(name)));
        for (std::size_t c = 0; c < force.size(); ++c)
            force[c].insert(force[c].end(), block.force[c].begin(), block.force[c].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

/// Returns an error if the file is a netlist by its name.
Result<void> refuse_netlist(const std::string& name) {
    constexpr std::string_view extensions[] = {".cir", ".ckt", ".net", ".sp", ".spice"};
    const auto extension = lower(std::filesystem::path(name).extension().string());
    if (std::ranges::find(extensions, extension) == std::end(extensions)) return {};
    return bad_input(fmt::format("{}: this is a netlist, not a recording; {}", name, file_afferent_advice(name)));
}

/// Adds clock, channels, notes and warnings of a recording that has been read. `clean`: removes the path of the temporary file.
void describe(const ForceSource& source, const std::function<std::string(const std::string&)>& clean, MessageWriter& answer) {
    answer.head["rate"] = source.clock().rate(), answer.head["t0"] = source.clock().t0;
    for (const auto& channel : source.channels()) answer.head["channels"].push_back(channel.name);
    answer.head["description"] = clean(source.description());
    answer.head["notes"] = answer.head["warnings"] = Json::array();
    for (const auto& note : source.notes()) answer.head["notes"].push_back(clean(note));
    const auto quality = source.quality();
    for (const auto& text : quality.descriptions) answer.head["notes"].push_back(clean(text));
    for (const auto& text : quality.warnings) answer.head["warnings"].push_back(clean(text));
}

KeptRecording kept_recording(const ForceSource& source, std::vector<std::vector<double>> force) {
    KeptRecording out{source.name(), source.channels(), source.clock(), {}, source.quality()};
    for (auto& values : force) out.force.push_back(std::make_shared<const std::vector<double>>(std::move(values)));
    return out;
}

}  // namespace

Result<void> read_recording(ObjectReader& request, std::optional<KeptRecording>& kept, MessageWriter& answer) {
    const auto name = std::filesystem::path(TRY(request.text("name"))).filename().string();
    const bool keeps = TRY(request.flag("keep"));
    if (keeps) kept.reset();  // also if this request fails
    const auto options = TRY(read_options(request));
    const auto* bytes = request.array("file");
    TRY(request.check_all_read());
    if (!bytes || bytes->type != "u8") return bad_input("read: the array \"file\" of type u8 is missing");
    if (name.empty() || name == "." || name == "..") return bad_input("read: \"name\" is not the name of a file, such as touch.csv");
    TRY(refuse_netlist(name));
    const auto directory = TRY(TemporaryDirectory::make());
    const auto path = directory.file(name);
    TRY(write_file(path, bytes->data));
    const auto clean = [&](const std::string& text) { return page_text(without_path(text, directory.file(""))); };
    auto source = open_recording(path, options);
    if (!source) return bad_input(clean(source.error().text()));
    auto force = read_force_of(**source, name);
    if (!force) return bad_input(clean(force.error().text()));
    describe(**source, clean, answer);
    answer.head["samples"] = force->front().size();
    if (keeps)
        kept = kept_recording(**source, std::move(*force));
    else
        for (std::size_t c = 0; c < force->size(); ++c) answer.add(fmt::format("force.{}", c), std::span<const double>((*force)[c]));
    return {};
}

}  // namespace corpuscle::page
