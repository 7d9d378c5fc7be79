#include "io/nwb/nwb_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/version.hpp"

namespace corpuscle {
namespace {

constexpr const char* nwb_version = "2.7.0";
constexpr std::size_t append_size = std::size_t{1} << 16;  // numbers in a message

/// A name without '/', which separates groups in HDF5.
std::string object_name(std::string name) {
    std::replace(name.begin(), name.end(), '/', '-');
    return name.empty() || name == "." ? "force" : name;
}

std::vector<Hdf5Attribute> type_attributes(std::string_view type, std::vector<Hdf5Attribute> more) {
    const bool is_common = type == "VectorData" || type == "VectorIndex" || type == "ElementIdentifiers";
    more.push_back(text_value("namespace", is_common ? "hdmf-common" : "core"));
    more.push_back(text_value("neurodata_type", std::string(type)));
    return more;
}

/// The error for spike k of a train that NWB does not allow; no value if the train is valid.
std::optional<std::string> train_error(const std::vector<double>& train, double from, double to) {
    for (std::size_t k = 0; k < train.size(); ++k) {
        if (train[k] < 0)
            return fmt::format(
                "a spike at {} s. NWB counts times from the start of the session, so that they are not negative. Use times "
                "that begin at 0, such as those of --rate; if the spike is before the first sample, --sampled",
                train[k]);
        if (!(train[k] >= from && train[k] <= to))
            return fmt::format("a spike at {} s, outside the observed {} s to {} s", train[k], from, to);
        if (k > 0 && train[k] == train[k - 1])
            return fmt::format("two spikes at {} s. NWB needs different times for the spikes of a unit", train[k]);
        if (k > 0 && train[k] < train[k - 1]) return fmt::format("spikes that are not in order, at {} s", train[k]);
    }
    return {};
}

}  // namespace

Result<NwbFile> NwbFile::create(const std::string& path, NwbMetadata metadata) {
    auto file = TRY(OutputFile::create(path));
    auto writer = TRY(Hdf5Writer::start(file));
    NwbFile out(std::move(file), std::move(writer), std::move(metadata));
    for (const auto* group :
         {"/acquisition", "/analysis", "/general", "/processing", "/stimulus", "/stimulus/presentation", "/stimulus/templates"})
        out.writer_.add_group(group);
    out.typed_.push_back("/");
    return out;
}

void NwbFile::add_typed(const std::string& path, std::string_view type, std::vector<Hdf5Attribute> attributes) {
    writer_.add_group(path, type_attributes(type, std::move(attributes)));
    typed_.push_back(path);
}

void NwbFile::add_force(const NwbSeries& series) {
    const auto path = (series.is_measured ? "/acquisition/" : "/stimulus/presentation/") + object_name(series.name);
    const auto channels = fmt::format("{}", fmt::join(series.channels, ", "));
    add_typed(path, "TimeSeries",
              {text_value("comments", fmt::format("channels: {}", channels)), text_value("description", series.description)});
    columns_ = series.channels.size(), force_path_ = path + "/data";
    // A single channel has one dimension, as NWB readers expect.
    writer_.add_growing(force_path_, columns_ == 1 ? 0 : columns_,
                        {real_value("conversion", 1), real_value("offset", 0), real_value("resolution", -1), text_value("unit", "N"),
                         text_value("continuity", "continuous"), text_list("channels", series.channels)});
    writer_.add_numbers<double>(path + "/starting_time", Hdf5Type::real, std::span(&series.start, 1), {},
                                {real_value("rate", series.rate), text_value("unit", "seconds")});
    contents_.add(path), contents_.add(channels), contents_.add(series.start), contents_.add(series.rate);
}

void NwbFile::append_force(std::span<const double> samples) {
    const auto rows = std::max<std::size_t>(1, append_size / columns_) * columns_;
    contents_.add(samples.data(), samples.size_bytes());
    for (; !samples.empty(); samples = samples.subspan(std::min(rows, samples.size())))
        writer_.append(force_path_, samples.first(std::min(rows, samples.size())));
}

void NwbFile::add_ids(const std::string& path, std::size_t count) {
    std::vector<std::int64_t> ids(count);
    for (std::size_t k = 0; k < count; ++k) ids[k] = static_cast<std::int64_t>(k);
    writer_.add_numbers<std::int64_t>(path, Hdf5Type::int64, ids, {count}, type_attributes("ElementIdentifiers", {}));
    typed_.push_back(path);
}

void NwbFile::add_column(const std::string& path, const NwbColumn& column) {
    auto attributes = type_attributes("VectorData", {text_value("description", column.description)});
    typed_.push_back(path);
    contents_.add(column.name);
    for (const auto& text : column.texts) contents_.add(text);
    for (const double x : column.numbers) contents_.add(x);
    if (column.texts.empty())
        writer_.add_numbers<double>(path, Hdf5Type::real, column.numbers, {column.numbers.size()}, std::move(attributes));
    else
        writer_.add_texts(path, column.texts, false, std::move(attributes));
}

void NwbFile::add_index(const std::string& path, const std::string& target, std::span<const std::uint64_t> ends) {
    writer_.add_numbers(path, Hdf5Type::uint64, ends, {ends.size()},
                        type_attributes("VectorIndex", {text_value("description", "the end of each unit in the list of all units"),
                                                        reference_to("target", target)}));
    typed_.push_back(path);
}

void NwbFile::add_spike_times(const NwbUnits& units) {
    const std::string path = "/units/spike_times";
    writer_.add_growing(path, 0,
                        type_attributes("VectorData", {text_value("description", "times of the spikes in s, unit after unit"),
                                                       real_value("resolution", units.resolution)}));
    typed_.push_back(path);
    std::vector<std::uint64_t> ends;
    std::vector<double> some;  // spikes that are not yet sent
    std::uint64_t count = 0;
    for (const auto& train : units.trains) {
        some.insert(some.end(), train.begin(), train.end());
        ends.push_back(count += train.size());
        if (some.size() < append_size && ends.size() < units.trains.size()) continue;
        contents_.add(some.data(), some.size() * sizeof(double));
        writer_.append(path, some);
        some.clear();
    }
    add_index("/units/spike_times_index", path, ends);
}

/// The remedy for equal times of unit u, as further sentences.
std::string refractory_remedy(const NwbUnits& units, std::size_t u, const std::string& type) {
    constexpr double usual = 1e-3;  // s, of nerves
    const auto has_t_ref = [&](const NwbColumn& c) { return c.name == "t_ref" && u < c.numbers.size() && !std::isnan(c.numbers[u]); };
    if (std::none_of(units.columns.begin(), units.columns.end(), has_t_ref)) return ". Leave out --sampled if it is given";
    return fmt::format(". Leave out --sampled if it is given, or set a refractory time: --set {}.t_ref={:g}ms", type,
                       1e3 * std::max(usual, units.resolution));
}

Result<void> NwbFile::add_units(const NwbUnits& units) {
    const auto text = [&](std::string_view column, std::size_t u) {
        for (const auto& c : units.columns)
            if (c.name == column && u < c.texts.size()) return c.texts[u];
        return std::string();
    };
    for (std::size_t u = 0; u < units.trains.size(); ++u)
        if (const auto error = train_error(units.trains[u], units.from, units.to))
            return bad_input(fmt::format("{} on {} has {}{}", text("afferent", u), text("channel", u), *error,
                                         error->starts_with("two") ? refractory_remedy(units, u, text("afferent_type", u)) : ""),
                             {file_.path()});
    if (units.trains.empty()) return {};
    std::vector<std::string> names = {"spike_times", "obs_intervals"};
    for (const auto& c : units.columns) names.push_back(c.name);
    add_typed("/units", "Units", {text_list("colnames", names), text_value("description", units.description)});
    add_ids("/units/id", units.trains.size());
    add_spike_times(units);
    std::vector<double> intervals;
    std::vector<std::uint64_t> ends;
    for (std::size_t u = 0; u < units.trains.size(); ++u)
        intervals.push_back(units.from), intervals.push_back(units.to), ends.push_back(u + 1);
    writer_.add_numbers<double>("/units/obs_intervals", Hdf5Type::real, intervals, {units.trains.size(), 2},
                                type_attributes("VectorData", {text_value("description", "interval in which the unit was observed, s")}));
    typed_.push_back("/units/obs_intervals");
    add_index("/units/obs_intervals_index", "/units/obs_intervals", ends);
    for (const auto& c : units.columns) add_column("/units/" + c.name, c);
    return {};
}

Result<void> NwbFile::add_trials(std::span<const NwbTrial> trials) {
    if (trials.empty()) return {};
    NwbColumn start{"start_time", "start of the trial, s"}, stop{"stop_time", "end of the trial, s"}, label{"label", "label of the trial"};
    for (const auto& t : trials) {
        if (!(t.start < t.stop) || !(t.start >= 0) || !std::isfinite(t.stop))
            return bad_input(fmt::format("the trial '{}' from {} s to {} s: NWB needs trials that begin at 0 s or later and end after that",
                                         t.label, t.start, t.stop),
                             {file_.path()});
        start.numbers.push_back(t.start), stop.numbers.push_back(t.stop), label.texts.push_back(t.label);
    }
    writer_.add_group("/intervals");
    add_typed("/intervals/trials", "TimeIntervals",
              {text_list("colnames", {"start_time", "stop_time", "label"}), text_value("description", "trials")});
    add_ids("/intervals/trials/id", trials.size());
    for (const auto* column : {&start, &stop, &label}) add_column("/intervals/trials/" + column->name, *column);
    return {};
}

void NwbFile::add_provenance(const std::string& source, const std::string& notes) {
    contents_.add(source), contents_.add(notes);
    const auto program = fmt::format("corpuscle {}", version);
    if (!source.empty()) writer_.add_texts("/general/source_script", {source}, true, {text_value("file_name", program)});
    const auto is_notes = [](const auto& field) { return field.first == "notes"; };
    const auto own = std::find_if(metadata_.general.begin(), metadata_.general.end(), is_notes);
    if (own == metadata_.general.end())
        metadata_.general.emplace_back("notes", std::vector{notes});
    else
        own->second[0] += "\n" + notes;
}

void NwbFile::add_general() {
    for (const auto& [name, values] : metadata_.general)
        writer_.add_texts("/general/" + name, values, name != "experimenter" && name != "keywords");
    if (metadata_.subject.empty()) return;
    add_typed("/general/subject", "Subject");
    for (const auto& [name, value] : metadata_.subject) writer_.add_texts("/general/subject/" + name, {value}, true);
}

/// A UUID (version 8, which is for custom contents) of an object of this file.
std::string NwbFile::identifier_of(std::string_view object) const {
    std::uint64_t words[2];
    for (std::uint64_t k = 0; k < 2; ++k) {
        Checksum sum = contents_;
        sum.add(k), sum.add(object);
        words[k] = sum.value();
    }
    words[0] = (words[0] & ~std::uint64_t{0xf000}) | 0x8000;
    words[1] = (words[1] >> 2) | (std::uint64_t{1} << 63);
    return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", words[0] >> 32, (words[0] >> 16) & 0xffff, words[0] & 0xffff, words[1] >> 48,
                       words[1] & 0xffffffffffff);
}

Result<void> NwbFile::commit() {
    add_general();
    for (const auto& [name, values] : metadata_.general)
        for (const auto& value : values) contents_.add(name), contents_.add(value);
    for (const auto* text : {&metadata_.session_description, &metadata_.session_start_time, &metadata_.identifier}) contents_.add(*text);
    const auto add_text = [&](const std::string& path, const std::string& text) { writer_.add_texts(path, {text}, true); };
    add_text("/identifier", metadata_.identifier.empty() ? identifier_of("file") : metadata_.identifier);
    add_text("/session_description", metadata_.session_description);
    add_text("/session_start_time", metadata_.session_start_time);
    add_text("/timestamps_reference_time", metadata_.session_start_time);
    writer_.add_texts("/file_create_date", {metadata_.session_start_time}, false);
    for (const auto& path : typed_) writer_.add_attributes(path, {text_value("object_id", identifier_of(path))});
    writer_.add_attributes("/", type_attributes("NWBFile", {text_value("nwb_version", nwb_version)}));
    TRY(writer_.finish());
    return file_.commit();
}

}  // namespace corpuscle
