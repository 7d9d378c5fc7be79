// Reads the TOML text of a sweep file.

#include "sweep/spec/sweep_text.hpp"

#include <sstream>

#include "core/text/toml_reader.hpp"

namespace corpuscle::sweeps {
namespace {

using Names = TomlReader::Names;

const Names known_keys = {"title",      "afferent", "netlist", "force", "channel", "rate",     "unit", "scale",  "seed",  "samples",
                          "iterations", "every",    "orders",  "set",   "vary",    "measures", "keep", "traces", "limits"};
const Names axis_keys = {"what", "how", "from", "to", "count", "log", "list", "mean", "sigma", "at_least", "at_most"};
const Names limit_keys = {"at_least", "at_most", "like", "within"};

/// Reads the tables of a sweep file. The first error is kept in first_error.
class SweepFileReader : public TomlReader {
public:
    using TomlReader::TomlReader;

    /// Reads [limits]. Without quotes, a measure with a dot in its name (spikes.plateau) is a nested table in TOML, so this calls itself.
    /// `prefix`: the part of the name up to the dot.
    void limits(const toml::table& from, const std::string& prefix, std::vector<LimitSpec>& out) {
        for (const auto& [key, value] : from) {
            LimitSpec limit{{prefix + std::string(key.str()), location_of(key.source())}, {}, {}, {}, {}};
            if (const auto* pair = value.as_array()) {
                if (pair->size() != 2)
                    return reject(value.source(), fmt::format("{}: a limit needs two numbers, [min, max]", limit.measure.text));
                limit.min = scalar((*pair)[0], limit.measure.text), limit.max = scalar((*pair)[1], limit.measure.text);
            } else if (const auto* inner = value.as_table()) {
                const bool is_limit =  // otherwise a table of further measures
                    inner->is_inline() || inner->empty() ||
                    std::any_of(inner->begin(), inner->end(), [](const auto& e) { return is_one_of(limit_keys, e.first.str()); });
                if (!is_limit) {
                    limits(*inner, limit.measure.text + ".", out);
                    continue;
                }
                reject_unknown_keys(*inner, limit_keys, limit.measure.text + ": ");
                limit.min = scalar(*inner, "at_least"), limit.max = scalar(*inner, "at_most");
                limit.like = scalar(*inner, "like"), limit.within = scalar(*inner, "within");
            } else {
                return reject(value.source(),
                              fmt::format("{0}: write {0} = [min, max], or {{at_least = ...}}, {{at_most = ...}}, {{like = \"sa1\", "
                                          "within = ...}}",
                                          limit.measure.text));
            }
            out.push_back(std::move(limit));
        }
    }

    /// Reads one [[vary]].
    void axis(const toml::table& from, std::vector<AxisSpec>& out) {
        reject_unknown_keys(from, axis_keys, "[[vary]]: ");
        AxisSpec a;
        if (auto what = scalar(from, "what"))
            a.name = std::move(*what);
        else
            reject(from.source(),
                   "[[vary]]: 'what' is missing; give the quantity that varies: what = \"process\", \"temp\" or a parameter's name");
        a.distribution = scalar(from, "how"), a.from = scalar(from, "from"), a.to = scalar(from, "to"), a.count = scalar(from, "count");
        a.log = scalar(from, "log", true), a.mean = scalar(from, "mean"), a.sigma = scalar(from, "sigma");
        a.min = scalar(from, "at_least"), a.max = scalar(from, "at_most"), a.list = list(from, "list");
        out.push_back(std::move(a));
    }
};

SweepText text_from(const toml::table& top, SweepFileReader& reader) {
    SweepText out;
    for (const auto& [key, value] : top)
        for (const auto& [old_key, new_key] : renamed_keys)
            if (key.str() == old_key) reader.reject(key.source(), fmt::format("{} is now {}", old_key, new_key));
    reader.reject_unknown_keys(top, known_keys, "");
    out.title = reader.scalar(top, "title"), out.afferent = reader.scalar(top, "afferent"), out.netlist = reader.scalar(top, "netlist");
    out.force = reader.scalar(top, "force"), out.channel = reader.scalar(top, "channel"), out.rate = reader.scalar(top, "rate");
    out.unit = reader.scalar(top, "unit"), out.scale = reader.scalar(top, "scale");
    out.seed = reader.scalar(top, "seed"), out.samples = reader.scalar(top, "samples"), out.every = reader.scalar(top, "every");
    out.iterations = reader.scalar(top, "iterations"), out.directives = reader.scalar(top, "orders");
    out.measures = reader.list(top, "measures"), out.keep = reader.list(top, "keep");
    if (auto traces = reader.list(top, "traces")) out.probes = std::move(*traces);
    if (const auto* set = reader.table(top, "set")) reader.settings(*set, "", out.settings);
    if (const auto* limits = reader.table(top, "limits")) reader.limits(*limits, "", out.limits);
    reader.tables(top, "vary", "each varied quantity", [&](const toml::table& one) { reader.axis(one, out.axes); });
    return out;
}

/// Converts inline tables to regular ones, so that files with the same content have the same canonical text.
void make_tables_regular(toml::node& node) {
    if (auto* table = node.as_table()) {
        table->is_inline(false);
        for (auto&& [key, value] : *table) make_tables_regular(value);
    }
    if (auto* array = node.as_array())
        for (auto& value : *array) make_tables_regular(value);
}

std::string canonical_text(toml::table top) {
    make_tables_regular(top);
    std::ostringstream out;
    out << toml::toml_formatter{top} << '\n';
    return out.str();
}

}  // namespace

Result<SweepText> read_sweep_text(std::string_view text, const std::string& file) {
    const auto top = TRY(parse_toml(text, file));
    SweepFileReader reader(file);
    auto out = text_from(top, reader);
    if (reader.first_error) return *reader.first_error;
    out.file = file, out.canonical = canonical_text(top);
    return out;
}

}  // namespace corpuscle::sweeps
