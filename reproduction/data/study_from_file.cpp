#include "reproduction/data/study_from_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "embedded_file_table.hpp"
#include "reproduction/data/study_names.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle {
namespace {

/// The text of an embedded file of reproduction/studies.
Result<std::string> study_text(const std::string& path) {
    for (const auto& f : embedded_file_table)
        if (f.path == path) return std::string(f.text());
    return bad_input(fmt::format("there is no file '{}'; add it, or correct its name here or in studies.def", path));
}

/// Computes the items of a data file one after another. After the first error the other items are skipped.
class StudyFileRun {
    const StudyFile& file_;
    StudyNames names_;
    StudyResult out_;
    std::optional<Error> error_;

public:
    StudyFileRun(const StudyFile& file, StudyValues values) : file_(file), names_(file, std::move(values)) {}

    Result<StudyResult> run(const StudyOptions& options) {
        const auto is_simulated = [](const StudyItem& item) { return item.kind == "run" || item.kind == "trial"; };
        const auto count = std::count_if(file_.items.begin(), file_.items.end(), is_simulated);
        double done = 0;
        for (const auto& item : file_.items) {
            if (!is_simulated(item)) continue;
            simulate(item);
            if (error_) return *error_;
            TRY(options.report_progress(++done / static_cast<double>(count + 1)));
        }
        for (const auto& item : file_.items) {
            if (item.kind == "claim") add_claim(item);
            if (item.kind == "plot") add_plot(item);
            if (item.kind == "note") out_.note(text(item, "text"));
            if (error_) return *error_;
        }
        return std::move(out_);
    }

private:
    void fail(Error error) {
        if (!error_) error_ = std::move(error);
    }
    template <class T>
    T value_or_fail(Result<T> result) {
        if (result) return std::move(*result);
        fail(result.error());
        return {};
    }

    /// The value of an item's key, which is an expression; NaN if the item does not have it.
    double number(const StudyItem& item, const std::string& key) {
        return item.has(key) && !error_ ? value_or_fail(names_.number(item.texts.at(key), item.scope)) : Claim::none;
    }
    /// The text of an item's key, with its {expressions} replaced.
    std::string text(const StudyItem& item, const std::string& key) {
        if (!item.has(key) || error_) return "";
        return value_or_fail(names_.text(item.texts.at(key), item.scope));
    }

    // ---- runs and trials ----

    void simulate(const StudyItem& item) {
        const auto name = item.has("name") ? item.text("name") : "run";
        if (names_.has_global(name))
            return fail(bad_input(fmt::format("there are two runs or values '{}'; give each a name", name), item.location));
        auto value = item.kind == "run" ? run_result(item) : trial_result(item);
        if (value)
            names_.add_global(name, std::move(*value));
        else if (value.error().location.file == item.location.file)
            fail(value.error());
        else
            fail({value.error().code, fmt::format("{} '{}': {}", item.kind, name, text_of(value.error())), item.location});
    }

    /// The text of an error in a netlist, which may be that of the data file.
    static std::string text_of(const Error& error) {
        return error.location.file == "circuits/study.cir" ? fmt::format("line {} of the netlist: {}", error.location.line, error.message)
                                                           : error.text();
    }

    /// The elements of a list of texts, with their {expressions} replaced.
    std::vector<std::string> filled_list(const StudyItem& item, const std::string& key) {
        std::vector<std::string> out;
        if (const auto found = item.lists.find(key); found != item.lists.end())
            for (const auto& element : found->second) out.push_back(value_or_fail(names_.text(element, item.scope)));
        return out;
    }

    Result<StudyValue> run_result(const StudyItem& item) {
        auto netlist = TRY(netlist_of(item));
        StudyNetlist deck{std::move(netlist), filled_list(item, "settings"), text(item, "directives")};
        if (error_) return *error_;
        if (item.is_true("ideal_mirrors")) deck.model_parameters = corpuscle::ideal_mirrors;
        auto results = TRY(run_study_variants(deck));
        return StudyValue(std::make_shared<const StudyRun>(std::move(results)));
    }

    /// The netlist of a run, or its name. With `replace`, a list of old and new texts, those in the netlist are replaced or, with
    /// replace_in = "parts/x.inc", those in this file, whose text then takes the place of the line that includes it.
    static Result<std::string> netlist_of(const StudyItem& item) {
        const auto texts = item.list("replace");
        if (item.has("circuit") == item.has("netlist")) return bad_input("a run has either 'circuit' or 'netlist'", item.location);
        if (texts.size() % 2 != 0) return bad_input("replace must be a list of old and new texts, in turn", item.location);
        if (!texts.empty() && item.has("netlist") && !item.has("replace_in"))
            return bad_input("replace needs 'circuit' or 'replace_in'; the texts of this netlist can be changed in place", item.location);
        std::vector<std::pair<std::string, std::string>> changes;
        for (std::size_t k = 0; k + 1 < texts.size(); k += 2) changes.emplace_back(texts[k], texts[k + 1]);
        const auto circuit_file = fmt::format("circuits/{}.cir", item.text("circuit"));
        auto netlist = item.text("netlist").ends_with(".cir") ? study_text("reproduction/studies/" + item.text("netlist"))
                       : item.has("netlist")                  ? Result<std::string>(item.text("netlist"))
                       : item.has("replace_in")               ? substitute_in_embedded_text(circuit_file, {})
                       : !changes.empty()                     ? substitute_in_embedded_text(circuit_file, changes)
                                                              : Result<std::string>(item.text("circuit"));
        if (!netlist || !item.has("replace_in")) return netlist;
        const auto part = substitute_in_embedded_text("circuits/" + item.text("replace_in"), changes);
        if (!part) return part;
        const auto line = fmt::format(".include '{}'", item.text("replace_in"));
        const auto at = netlist->find(line);
        if (at == std::string::npos) return item.texts.at("replace_in").error_here(fmt::format("the netlist has no line {}", line));
        return netlist->replace(at, line.size(), *part);
    }

    Result<StudyValue> trial_result(const StudyItem& item) {
        auto spec = item.is_true("thesis_algorithm") ? press::thesis_algorithm(item.text("afferent")) : TrialSpec{item.text("afferent")};
        if (item.has("stimulus")) spec.stimulus = item.text("stimulus");
        if (item.has("rate")) spec.rate = number(item, "rate");
        if (item.has("seed")) spec.seed = static_cast<std::uint64_t>(number(item, "seed"));
        spec.settings = filled_list(item, "settings");
        spec.probes = item.list("probes");
        if (error_) return *error_;
        auto force = TRY(trial_force(spec));
        StudyTrial out{std::move(force), {}};
        if (!spec.afferent.empty()) {
            auto result = TRY(run_trial(spec));
            out.result = std::move(result);
        }
        return StudyValue(std::make_shared<const StudyTrial>(std::move(out)));
    }

    // ---- claims and plots ----

    void add_claim(const StudyItem& item) {
        if (item.has("value") == item.has("true"))
            return fail(bad_input("a claim has either 'value', a number, or 'true', a statement", item.location));
        if (item.has("published") && item.has("derived"))
            return fail(bad_input("a claim has 'published' or 'derived', not both", item.location));
        const bool is_statement = item.has("true");
        Claim claim{.label = text(item, "label"), .computed = number(item, is_statement ? "true" : "value"), .unit = item.text("unit")};
        claim.is_boolean = is_statement;
        claim.is_derived = item.has("derived");
        claim.published = number(item, claim.is_derived ? "derived" : "published");
        if (item.has("tolerance") && !item.has("published") && !item.has("derived"))
            return fail(
                bad_input("tolerance is the allowed difference from 'published' or 'derived'; the claim has neither", item.location));
        claim.allowed_min = is_statement ? 1 : number(item, "min");
        claim.allowed_max = number(item, "max");
        claim.source = text(item, "source");
        claim.tolerance = number(item, "tolerance");
        claim.kind = item.has("kind") ? value_or_fail(read_claim_kind(item.texts.at("kind"))) : file_.kind;
        if (item.has("explain")) claim.explain(text(item, "explain"));
        if (item.has("explain_if_undefined") && std::isnan(claim.computed)) claim.explain(text(item, "explain_if_undefined"));
        if (item.has("explain_if_needed")) claim.explain_if_needed(text(item, "explain_if_needed"));
        out_.claims.push_back(std::move(claim));
    }

    void add_plot(const StudyItem& item) {
        StudyPlot plot{text(item, "title"), item.text("x"), item.text("y"), {}, item.is_true("log_x"), item.is_true("log_y")};
        plot.published_shape = text(item, "published");
        for (const auto& series : item.series) add_series(series, plot);
        out_.plots.push_back(std::move(plot));
    }

    void add_series(const StudyItem& item, StudyPlot& plot) {
        constexpr std::pair<const char*, StudyPlot::Style> styles[] = {{"line", StudyPlot::Style::line},
                                                                       {"points", StudyPlot::Style::points},
                                                                       {"path", StudyPlot::Style::path},
                                                                       {"raster", StudyPlot::Style::raster}};
        if (std::count_if(std::begin(styles), std::end(styles), [&](const auto& style) { return item.has(style.first); }) != 1)
            return fail(bad_input("a series has one of line, points, path and raster", item.location));
        for (const auto& [key, style] : styles)
            if (item.has(key)) add_series(text(item, "name"), style, item.texts.at(key), item.scope, plot);
    }

    void add_series(std::string name, StudyPlot::Style style, const LocatedText& expression, std::size_t scope, StudyPlot& plot) {
        auto value = value_or_fail(names_.value(expression, scope));
        if (error_) return;
        const bool is_raster = style == StudyPlot::Style::raster;
        if (is_raster && std::holds_alternative<StudyList>(value))
            plot.raster_row(std::move(name), std::move(std::get<StudyList>(value)));
        else if (!is_raster && std::holds_alternative<StudyCurve>(value))
            plot.add(std::move(name), std::move(std::get<StudyCurve>(value)), style);
        else
            fail(expression.error_here(fmt::format("'{}' is {}; expected {}", expression.text, kind_of(value).name,
                                                   is_raster ? "a list of spike times" : "a curve")));
    }
};

}  // namespace

Result<StudyResult> run_study_file(const StudyFile& file, const StudyOptions& options, StudyValues values) {
    return StudyFileRun(file, std::move(values)).run(options);
}

Study study_from_file(const std::string& name, ComputeStudyValues compute_values) {
    struct Loaded {  // kept alive by the study's `compute`
        std::string name;
        Result<StudyFile> file;
    };
    const auto path = fmt::format("reproduction/studies/{}.toml", name);
    const auto text = study_text(path);
    const auto loaded = std::make_shared<Loaded>(Loaded{name, text ? read_study_file(*text, path) : Result<StudyFile>(text.error())});
    std::replace(loaded->name.begin(), loaded->name.end(), '_', '-');
    const auto compute = [loaded, compute_values](const StudyOptions& options) -> Result<StudyResult> {
        if (!loaded->file) return loaded->file.error();
        auto values = TRY(compute_values ? compute_values(options) : Result<StudyValues>(StudyValues{}));
        return run_study_file(*loaded->file, options, std::move(values));
    };
    if (!loaded->file) return {loaded->name, "", "", {}, compute};
    return {loaded->name, loaded->file->title.text, loaded->file->question.text, loaded->file->kind, compute};
}

}  // namespace corpuscle
