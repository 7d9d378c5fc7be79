// Test vectors: each word that a digital afferent (an afferent behind a converter) computes, to verify hardware built to
// doc/fixed-point.md. For each digital afferent:
//
// vectors-AFFERENT.csv: the constants as comments, then one row for each conversion on the first channel of the first input. Each further
// channel, also of further inputs, has its own file: vectors-AFFERENT-2.csv, vectors-AFFERENT-3.csv
//
// rom-AFFERENT.csv: the table from codes of the converter to words of force.

#include <algorithm>
#include <iterator>

#include "model/sensor/digital_afferent.hpp"
#include "run/channels/channel_population.hpp"
#include "run/sinks/file_sink.hpp"

namespace corpuscle {
namespace {

/// The lines above the rows: comments with the afferent and every constant, then the names of the columns. For each neuron current I..., a
/// column s... says whether the neuron fired.
std::string header_text(const AfferentPlan& plan, const std::string& channel, const DigitalAfferent& afferent) {
    const auto& constants = afferent.chain().constants;
    std::string text = "# corpuscle vectors 1, described in doc/fixed-point.md\n";
    text += fmt::format("# afferent {}\n# parts {}\n# channel {}\n", plan.name, plan.composition(), channel);
    text += fmt::format("# word {}\n# frac {}\n# bits {:g}\n# f_s {} Hz\n", constants.format().word, constants.format().frac,
                        *plan.value("bits"), *plan.value("f_s"));
    for (const auto& c : constants.all())  // a constant without a shift is a level, otherwise a factor
        text += c.shift < 0 ? fmt::format("# level {} {} {}\n", c.name, c.value, c.word)
                            : fmt::format("# factor {} {} {} {}\n", c.name, c.value, c.word, c.shift);
    std::string columns = "code,F", bits;
    for (const auto& [name, unit] : afferent.chain().recordables) {
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

std::string vectors_name(const AfferentPlan& plan, std::size_t file) { return numbered_name("vectors-" + plan.name + "#.csv", file); }

Result<void> check_vectors(const OutputRequest& request) {
    const auto has_converter = [](const AfferentPlan& plan) { return !plan.converter.empty(); };
    if (std::none_of(request.plans.begin(), request.plans.end(), has_converter)) {
        const auto& plan = request.plans[0];
        const auto with_converter = plan.receptor.empty() ? "sa1-kim" : "adc+" + base_name(plan);
        return bad_usage(fmt::format("--vectors: {} has no converter, and so no fixed-point values; try --afferent {}", base_name(plan),
                                     with_converter));
    }
    return check_recorded_copies(request, "--vectors");
}

std::vector<std::string> vectors_file_names(const OutputRequest& request) {
    std::vector<std::string> names;
    for (const auto& plan : request.plans) {
        if (plan.converter.empty()) continue;
        names.push_back(fmt::format("rom-{}.csv", plan.name));
        for (std::size_t c = 0; c < request.channels; ++c) names.push_back(vectors_name(plan, c));
    }
    return names;
}

class VectorsFile final : public FileSink {
    /// The vectors of one afferent on one channel of the current input.
    struct AfferentFile {
        std::size_t plan_index;
        std::size_t file;  // index in files_
        State state;       // of the afferent, which this sink simulates itself
    };
    std::vector<std::unique_ptr<DigitalAfferent>> digital_;  // for each plan, at the sample rate of the current input; null if not digital
    std::vector<std::optional<AfferentFile>> afferent_files_;  // for each afferent of the current input; no value if not digital
    std::vector<std::size_t> file_counts_;                     // for each plan: number of vectors files so far

    /// Makes the digital afferents at this input's sample rate; for the first input also writes their tables of force words.
    Result<void> make_afferents(const Input& input) {
        digital_.clear();
        for (const auto& plan : input.on_channels().plans()) {
            const bool is_digital = !plan.converter.empty();
            digital_.push_back(is_digital ? make_digital(plan, {input.clock.T()}) : nullptr);
            if (!is_digital || input.index > 0) continue;
            TRY(create(fmt::format("rom-{}.csv", plan.name)));
            TRY(files_.back().write(rom_text(*digital_.back())));
        }
        file_counts_.resize(digital_.size());
        return {};
    }

    Result<void> open_vectors_file(const Input& input, std::size_t afferent_index) {
        const auto& afferents = input.on_channels();
        const auto a = afferent_index % digital_.size(), c = afferents.channel_of(afferent_index);
        const auto& plan = afferents.plan_of(afferent_index);
        TRY(create(vectors_name(plan, file_counts_[a]++)));
        TRY(files_.back().write(header_text(plan, one_line(afferents.channel(c)), *digital_[a])));
        const ChannelSlot slot{static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(afferents.channels())};
        afferent_files_[afferent_index] = AfferentFile{a, files_.size() - 1, digital_[a]->start(slot)};
        return {};
    }

public:
    using FileSink::FileSink;

    Result<void> begin(const Input& input) override {
        TRY(make_afferents(input));
        afferent_files_.clear();
        afferent_files_.resize(input.population.size());
        for (std::size_t u = 0; u < afferent_files_.size(); ++u)
            if (digital_[u % digital_.size()]) TRY(open_vectors_file(input, u));
        return {};
    }

    Result<void> block(const Input& input, const RunBlock& block) override {
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
            auto& [plan, file, state] = *afferent_files_[u];
            const auto force = block.force[input.on_channels().channel_of(u)];
            TRY(digital_[plan]->respond_and_report(force, state, response, put_row));
            TRY(files_[file].write({text.data(), text.size()}));
        }
        return {};
    }
};

}  // namespace

extern const OutputFormat vectors_format = {
    .names = {"vectors-*.csv", "rom-*.csv"},
    .option = "--vectors",
    .help = "with --out, also write vectors-AFFERENT.csv and rom-AFFERENT.csv: every fixed-point value after the converter",
    .make = make_file_sink<VectorsFile>,
    .check = check_vectors,
    .names_of = vectors_file_names,
};

}  // namespace corpuscle
