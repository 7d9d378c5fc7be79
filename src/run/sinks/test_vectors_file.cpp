#include "run/sinks/test_vectors_file.hpp"

#include <iterator>

#include "model/sensor/front_end_factory.hpp"

namespace corpuscle {
namespace {

/// The lines above the rows: comments with the afferent and every constant, then the names of the columns. For each neuron current I..., a
/// column s... says whether the neuron fired.
std::string header_text(const AfferentPlan& plan, const std::string& channel, const DigitalAfferent& afferent) {
    const auto& constants = afferent.chain().constants();
    std::string text = "# corpuscle vectors 1, described in doc/fixed-point.md\n";
    text += fmt::format("# afferent {}\n# parts {}\n# channel {}\n", plan.name, plan.composition(), channel);
    text += fmt::format("# word {}\n# frac {}\n# bits {:g}\n# f_s {} Hz\n", constants.format().word, constants.format().frac,
                        *plan.value("bits"), *plan.value("f_s"));
    for (const auto& c : constants.all())  // a constant without a shift is a level, otherwise a factor
        text += c.shift < 0 ? fmt::format("# level {} {} {}\n", c.name, c.value, c.word)
                            : fmt::format("# factor {} {} {} {}\n", c.name, c.value, c.word, c.shift);
    std::string columns = "code,F", bits;
    for (const auto& [name, unit] : afferent.chain().recordables()) {
        columns += "," + name;
        if (name.starts_with("I")) bits += ",s" + name.substr(1);
    }
    return text + columns + bits + "\n";
}

/// The table from codes to force words, as CSV.
std::string rom_text(const DigitalAfferent& afferent) {
    std::string text = "code,F\n";
    for (std::size_t code = 0; code < afferent.rom().size(); ++code) text += fmt::format("{},{}\n", code, afferent.rom()[code]);
    return text;
}

/// A channel's name as one line of a comment.
std::string one_line(std::string name) {
    for (char& c : name)
        if (c == '\n' || c == '\r') c = ' ';
    return name;
}

}  // namespace

/// Makes the digital afferents at this input's sample rate; for the first input also writes their tables of force words.
Result<void> TestVectorsFile::make_afferents(const Input& input) {
    digital_.clear();
    for (const auto& plan : input.plans) {
        const bool is_digital = !plan.converter.empty();
        digital_.push_back(is_digital ? make_digital(plan, {input.source.clock().T()}) : nullptr);
        if (!is_digital || input.index > 0) continue;
        paths_.push_back(fmt::format("{}/rom-{}.csv", directory_, plan.name));
        auto file = OutputFile::create(paths_.back());
        if (!file) return file.error();
        if (auto ok = file->write(rom_text(*digital_.back())); !ok) return ok;
        complete_files_.push_back(std::move(*file));
    }
    file_counts_.resize(digital_.size());
    return {};
}

Result<void> TestVectorsFile::open_vectors_file(const Input& input, std::size_t afferent_index) {
    const auto a = afferent_index % input.plans.size(), c = input.channel_of(afferent_index);
    const auto number = ++file_counts_[a] == 1 ? "" : fmt::format("-{}", file_counts_[a]);
    paths_.push_back(fmt::format("{}/vectors-{}{}.csv", directory_, input.plans[a].name, number));
    auto file = OutputFile::create(paths_.back());
    if (!file) return file.error();
    if (auto ok = file->write(header_text(input.plans[a], one_line(input.channel_name(c)), *digital_[a])); !ok) return ok;
    const ChannelSlot slot{static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(input.source.channels().size())};
    afferent_files_[afferent_index] = AfferentFile{a, std::move(*file), digital_[a]->start(slot)};
    return {};
}

Result<void> TestVectorsFile::begin(const Input& input) {
    if (auto ok = make_afferents(input); !ok) return ok;
    afferent_files_.clear();
    afferent_files_.resize(input.afferent_count());
    for (std::size_t u = 0; u < input.afferent_count(); ++u)
        if (digital_[u % input.plans.size()])
            if (auto ok = open_vectors_file(input, u); !ok) return ok;
    return {};
}

Result<void> TestVectorsFile::block(const Input& input, const RunBlock& block) {
    for (std::size_t u = 0; u < afferent_files_.size(); ++u) {
        if (!afferent_files_[u]) continue;
        fmt::memory_buffer text;
        const auto put_row = [&](const DigitalAfferent::Conversion& c) {
            fmt::format_to(std::back_inserter(text), "{},{}", c.code, c.force);
            for (const Word w : c.recorded) fmt::format_to(std::back_inserter(text), ",{}", w);
            for (const bool spike : c.fired) fmt::format_to(std::back_inserter(text), ",{:d}", spike);
            text.push_back('\n');
        };
        std::vector<Spike> spikes;
        ResponseBlock response{spikes};
        const std::span force(block.force.force[input.channel_of(u)].data(), block.force.count);
        if (auto ok = digital_[afferent_files_[u]->plan_index]->respond_and_report(force, afferent_files_[u]->state, response, put_row);
            !ok)
            return ok;
        if (auto ok = afferent_files_[u]->file.write({text.data(), text.size()}); !ok) return ok;
    }
    return {};
}

Result<void> TestVectorsFile::end(const Input&, std::int64_t) {
    for (auto& afferent_file : afferent_files_)
        if (afferent_file) complete_files_.push_back(std::move(afferent_file->file));
    afferent_files_.clear();
    return {};
}

Result<void> TestVectorsFile::commit() {
    for (auto& file : complete_files_)
        if (auto ok = file.commit(); !ok) return ok;
    return {};
}

}  // namespace corpuscle
