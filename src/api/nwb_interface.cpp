#include "corpuscle/nwb.hpp"

#include <algorithm>
#include <cmath>

#include "api/response_parts.hpp"
#include "core/version.hpp"
#include "io/output/output_check.hpp"
#include "run/afferent_details.hpp"

namespace corpuscle {
namespace api {

AfferentModels models_of(AfferentDetails details) {
    AfferentModels out{std::move(details.models), std::move(details.properties), {}};
    for (auto& p : details.parameters)
        out.parameters.push_back({std::move(p.name), std::move(p.unit), std::move(p.description), std::move(p.values)});
    return out;
}

}  // namespace api

namespace {

AfferentDetails details_of(AfferentModels models) {
    AfferentDetails out{std::move(models.models), std::move(models.properties), {}};
    for (auto& p : models.parameters)
        out.parameters.push_back({std::move(p.name), std::move(p.unit), std::move(p.description), std::move(p.values)});
    return out;
}

AfferentNames names_of(const Response& response) {
    AfferentNames out;
    for (const auto& a : response.afferents) {
        out.names.push_back(a.name), out.types.push_back(a.type), out.channels.push_back(a.channel);
        if (!std::isnan(a.x)) out.x.push_back(a.x), out.y.push_back(a.y);
    }
    return out;
}

NwbUnits units_of(const Response& response, double resolution) {
    NwbUnits out;
    out.description = "simulated afferents (Corpuscle " + std::string(version) + ")";
    out.trains.resize(response.afferents.size());
    for (std::size_t k = 0; k < response.times.size(); ++k) out.trains[response.indices[k]].push_back(response.times[k]);
    out.from = response.start, out.to = response.start + response.duration, out.resolution = resolution;
    if (!response.times.empty()) {
        const auto [first, last] = std::minmax_element(response.times.begin(), response.times.end());
        out.from = std::min(out.from, *first), out.to = std::max(out.to, *last);
    }
    out.columns = nwb_columns(names_of(response), response.models ? details_of(response.models()) : AfferentDetails{});
    return out;
}

void add_force(NwbFile& nwb, const ForceView& force, bool is_measured, const std::string& description) {
    auto channels = force.channels;
    for (std::size_t c = channels.size(); c < force.samples.size(); ++c) channels.push_back("ch" + std::to_string(c + 1));
    nwb.add_force({.name = force.name,
                   .description = description,
                   .is_measured = is_measured,
                   .channels = std::move(channels),
                   .start = force.start,
                   .rate = force.rate});
    constexpr std::size_t rows = 4096;
    const auto width = force.samples.size();
    std::vector<double> block;
    for (std::size_t first = 0; first < force.count; first += rows) {
        const auto count = std::min(rows, force.count - first);
        block.resize(count * width);
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t c = 0; c < width; ++c)
                block[k * width + c] = force.samples[c][static_cast<std::ptrdiff_t>(first + k) * force.stride];
        nwb.append_force(block);
    }
}

/// The names of the types, for the description of the session.
std::string types_of(const Response& response) {
    std::vector<std::string> types;
    for (const auto& a : response.afferents)
        if (std::find(types.begin(), types.end(), a.type) == types.end()) types.push_back(a.type);
    std::string out;
    for (const auto& type : types) out += (out.empty() ? "" : ", ") + type;
    return out;
}

}  // namespace

void write_nwb(const std::string& path, const Response& response, const ForceView* force, const NwbOptions& options) {
    const auto metadata = api::value_or_throw(read_nwb_metadata(options.fields, "NWB field"));
    const auto is_never_ours = [](std::string_view) { return false; };  // the first bytes of HDF5 files are all alike
    api::value_or_throw(OutputCheck(options.overwrite).check_file(path, is_never_ours));
    auto nwb = api::value_or_throw(NwbFile::create(path, metadata));
    nwb.set_default_description("Simulated response" + (force ? " to the force '" + force->name + "'" : "") + ": " +
                                std::to_string(response.afferents.size()) + " afferents: " + types_of(response));
    nwb.add_provenance(options.source,
                       "Simulated by Corpuscle " + std::string(version) + ", with the seed " + std::to_string(options.seed) + ".");
    if (force)
        add_force(nwb, *force, options.is_measured,
                  response.skin_force ? "total normal force on the skin" : "normal force on each channel");
    api::value_or_throw(nwb.add_units(units_of(response, options.resolution)));
    std::vector<NwbTrial> trials;
    for (const auto& t : options.trials) trials.push_back({t.start, t.stop, t.label});
    api::value_or_throw(nwb.add_trials(trials));
    api::value_or_throw(nwb.commit());
}

}  // namespace corpuscle
