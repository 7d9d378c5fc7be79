// probes.csv: one row for each sample of the first input, with time_s, then the force (on each channel, or in total on a skin), then the
// probes of each afferent. A second input is written to probes-2.csv.

#include <iterator>

#include "core/text/csv_field.hpp"
#include "run/sinks/file_sink.hpp"

namespace corpuscle {
namespace {

class ProbesFile final : public FileSink {
    fmt::memory_buffer text_;

public:
    using FileSink::FileSink;
    bool wants_probes() const override { return true; }

    Result<void> begin(const Input& input) override {
        const auto& population = input.population;
        TRY(create(numbered_name("probes#.csv", input.index)));
        std::string header = "time_s";
        for (const auto& name : population.force_names()) header += "," + quote_csv_field(name + "_N");
        for (std::size_t u = 0; u < population.size(); ++u)
            for (const auto& p : population.probes(u))
                header += "," + quote_csv_field(fmt::format("{}.{}.{}{}", population.afferent_name(u), population.channel_name(u), p.name,
                                                            p.unit.empty() ? "" : fmt::format(" [{}]", p.unit)));
        return files_.back().write(header + "\n");
    }

    Result<void> block(const Input& input, const RunBlock& block) override {
        const auto out = std::back_inserter(text_);
        for (std::size_t k = 0; k < block.steps; ++k) {
            fmt::format_to(out, "{:.9f}", input.clock.time(block.first_sample + static_cast<std::int64_t>(k)));
            for (const auto& row : block.force) fmt::format_to(out, ",{:.9g}", row[k]);
            for (const auto& afferent : block.probes)
                for (const auto& probe : afferent) fmt::format_to(out, ",{:.9g}", probe[k]);
            text_.push_back('\n');
        }
        return write_text(text_);
    }
};

}  // namespace

extern const OutputFormat probes_format = {
    .names = {"probes#.csv"},
    .option = "--probe-files",
    .help = "with --out, also write probes.csv: force, currents, membranes",
    .make = make_file_sink<ProbesFile>,
    .check = [](const OutputRequest& request) { return check_recorded_copies(request, "--probe-files"); },
};

}  // namespace corpuscle
